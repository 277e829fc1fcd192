//! Runs of a few steps, and what they do with a forged checkpoint.

use std::cell::Cell;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use particle_file::Provenance;
use run::{Mode, Request, RunFailure, Summary};

use crate::readers::{bond, file, scratch};
use crate::sign::signed;

/// The schemes of which checkpoints are attacked.
pub(crate) const SCHEMES: [&str; 2] = ["explicit", "implicit"];

const CHECKPOINT: &str = "checkpoint.mpts";

/// A case for the small bond of the seeds.
pub(crate) fn case_text(scheme: &str) -> String {
    include_str!("../../press.toml").replace("\"explicit\"", &format!("\"{scheme}\""))
}

/// The case of `scheme` as a file.
pub(crate) fn case_file(scheme: &str) -> PathBuf {
    file(&format!("{scheme}.toml"), case_text(scheme).as_bytes())
}

/// Takes `steps` steps of a run into `folder`, going on from its checkpoint if there is one.
pub(crate) fn steps(
    case: &Path,
    bond: &Path,
    folder: &Path,
    steps: usize,
) -> Result<Option<Summary>, RunFailure> {
    let mode = Mode {
        resume: true,
        ..Mode::default()
    };
    let by = Provenance {
        tool: "attack".into(),
        version: "0".into(),
        ..Provenance::default()
    };
    let taken = Cell::new(0);
    let interrupted = || {
        taken.set(taken.get() + 1);
        taken.get() >= steps
    };
    let request = Request::read(case, Some(bond), &[])?;
    request.execute(folder, mode, by, &interrupted, &mut |_, _| {}, &|_| {})
}

/// An empty folder.
pub(crate) fn empty(name: &str) -> PathBuf {
    let folder = scratch().join(name);
    let _ = fs::remove_dir_all(&folder);
    folder
}

/// A run that was stopped after two steps: its files by name.
type Stopped = Vec<(String, Vec<u8>)>;

fn stopped(scheme: &str) -> Stopped {
    let folder = empty("stopped");
    let made = steps(&case_file(scheme), &bond(), &folder, 2);
    assert!(
        made.is_ok(),
        "the run whose checkpoint is attacked: {made:?}"
    );
    let files = fs::read_dir(&folder).into_iter().flatten().flatten();
    let read = |path: PathBuf| Some((path.file_name()?.to_str()?.to_owned(), fs::read(path).ok()?));
    files.filter_map(|entry| read(entry.path())).collect()
}

/// The run of each scheme.
fn runs() -> &'static [Stopped; 2] {
    static RUNS: OnceLock<[Stopped; 2]> = OnceLock::new();
    RUNS.get_or_init(|| SCHEMES.map(stopped))
}

/// The checkpoints of a small run by each scheme.
pub(crate) fn checkpoints() -> Vec<Vec<u8>> {
    let files = runs().iter().flatten();
    let checkpoints = files.filter(|(name, _)| name == CHECKPOINT);
    checkpoints.map(|(_, bytes)| bytes.clone()).collect()
}

/// Resumes the run of each scheme from the checkpoint, signed anew, and takes a step.
pub(crate) fn feed(bytes: &[u8]) -> bool {
    let checkpoint = signed(bytes);
    let resumed = |(scheme, run): (&str, &Stopped)| {
        let folder = empty("resumed");
        fs::create_dir_all(&folder).ok()?;
        for (name, bytes) in run {
            fs::write(folder.join(name), bytes).ok()?;
        }
        fs::write(folder.join(CHECKPOINT), &checkpoint).ok()?;
        steps(&case_file(scheme), &bond(), &folder, 1).ok()
    };
    let runs = SCHEMES.into_iter().zip(runs());
    runs.filter_map(resumed).count() > 0
}

//! Runs of a few steps, and what they do with a forged checkpoint.

use std::cell::Cell;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use particle_file::Provenance;
use run::{Mode, Request, RunFailure, Summary};

use crate::readers::{bond, scratch};
use crate::sign::signed;

/// The schemes of which checkpoints are attacked.
pub(crate) const SCHEMES: [&str; 2] = ["explicit", "implicit"];

/// A case for the small bond of the seeds.
pub(crate) fn case_text(scheme: &str) -> String {
    include_str!("../../press.toml").replace("\"explicit\"", &format!("\"{scheme}\""))
}

/// The case of `scheme` as a file.
pub(crate) fn case_file(scheme: &str) -> Option<PathBuf> {
    let path = scratch().join(format!("{scheme}.toml"));
    fs::write(&path, case_text(scheme)).ok()?;
    Some(path)
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

/// A run that was stopped after two steps: its files by name.
struct Stopped(Vec<(String, Vec<u8>)>);

const CHECKPOINT: &str = "checkpoint.mpts";

impl Stopped {
    fn new(scheme: &str) -> Self {
        let folder = scratch().join("stopped");
        let _ = fs::remove_dir_all(&folder);
        let bond_file = scratch().join("bond.mpts");
        let made = fs::write(&bond_file, bond()).is_ok()
            && case_file(scheme).is_some_and(|case| steps(&case, &bond_file, &folder, 2).is_ok());
        assert!(
            made,
            "the run whose checkpoint is attacked: {}",
            folder.display()
        );
        let files = fs::read_dir(&folder).into_iter().flatten().flatten();
        let read =
            |path: PathBuf| Some((path.file_name()?.to_str()?.to_owned(), fs::read(path).ok()?));
        Self(files.filter_map(|entry| read(entry.path())).collect())
    }

    fn checkpoint(&self) -> Vec<u8> {
        let found = self.0.iter().find(|(name, _)| name == CHECKPOINT);
        found.map(|(_, bytes)| bytes.clone()).unwrap_or_default()
    }

    /// The run folder again, with another checkpoint.
    fn restored_with(&self, checkpoint: &[u8]) -> Option<PathBuf> {
        let folder = scratch().join("resumed");
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder).ok()?;
        for (name, bytes) in &self.0 {
            let bytes = if name == CHECKPOINT {
                checkpoint
            } else {
                bytes
            };
            fs::write(folder.join(name), bytes).ok()?;
        }
        Some(folder)
    }
}

fn stopped() -> &'static [Stopped; 2] {
    static RUNS: OnceLock<[Stopped; 2]> = OnceLock::new();
    RUNS.get_or_init(|| SCHEMES.map(Stopped::new))
}

/// The checkpoints of a small run by each scheme.
pub(crate) fn checkpoints() -> Vec<Vec<u8>> {
    stopped().iter().map(Stopped::checkpoint).collect()
}

/// Resumes the run of each scheme from the checkpoint, signed anew, and takes a step.
pub(crate) fn feed(bytes: &[u8]) -> bool {
    let checkpoint = signed(bytes);
    let resumed = |(scheme, run): (&str, &Stopped)| {
        let bond_file = scratch().join("bond.mpts");
        fs::write(&bond_file, bond()).ok()?;
        let folder = run.restored_with(&checkpoint)?;
        steps(&case_file(scheme)?, &bond_file, &folder, 1).ok()
    };
    let runs = SCHEMES.into_iter().zip(stopped());
    runs.filter_map(resumed).count() > 0
}

//! A small scene and its runs.

use std::cell::Cell;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use particle_file::Provenance;
use run::{Ahead, Mode, Request, RunFailure, Summary};
use tempfile::TempDir;

/// A case of a drop `drop` um wide and 10 um high on the lower of two plates in a box `wide` um wide,
/// the upper one `gap` um above it and driven by the clamp; `tables` are those of clamp, integrator and output.
pub fn plates(wide: u32, gap: u32, drop: u32, tables: &str) -> String {
    let top = 6 + gap;
    format!(
        r#"[grid]
cell = "2 um"
dimensions = 2
domain = {{ min = ["0 um", "0 um", "0 um"], max = ["{wide} um", "30 um", "2 um"] }}
[adhesive]
density = "1200 kg/m3"
bulk_modulus = "1 GPa"
viscosity = "1.3 Pa s"
[contact]
law = "stick"
{tables}
[[body]]
material = "rigid"
name = "bottom"
box = {{ min = ["0 um", "0 um", "0 um"], max = ["{wide} um", "6 um", "2 um"] }}
[[body]]
material = "rigid"
name = "top"
velocity = "clamp"
box = {{ min = ["0 um", "{top} um", "0 um"], max = ["{wide} um", "{} um", "2 um"] }}
[[body]]
material = "adhesive"
box = {{ min = ["0 um", "6 um", "0 um"], max = ["{drop} um", "16 um", "2 um"] }}
"#,
        top + 22
    )
}

pub const PLAIN: Mode = Mode {
    resume: false,
    overwrite: false,
    however_long: false,
};
pub const RESUME: Mode = Mode {
    resume: true,
    ..PLAIN
};
pub const OVERWRITE: Mode = Mode {
    overwrite: true,
    ..PLAIN
};

/// A folder with a case.
pub struct Bench(TempDir);

impl Bench {
    pub fn with(case: &str) -> Self {
        let bench = Self(tempfile::tempdir().unwrap());
        fs::write(bench.path("case.toml"), case).unwrap();
        bench
    }

    /// Liquid between two plates; a row of the history and a snapshot now and then.
    pub fn new(integrator: &str, stop: &str, every: &str) -> Self {
        let tables = format!(
            r#"[clamp]
closing_speed = "1 m/s"
max_pressure = "2.5 MPa"
travel = "4 um"
stop = "{stop}"
[integrator]
{integrator}
[output]
history_every = "{every}"
snapshots = 3"#
        );
        Self::with(&plates(24, 10, 4, &tables))
    }

    /// About thirty explicit steps.
    pub fn explicit() -> Self {
        Self::new("scheme = \"explicit\"", "0.007 us", "0.001 us")
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub fn read(&self, changes: &[&str]) -> Result<Request, RunFailure> {
        let changes: Vec<String> = changes.iter().map(|change| (*change).to_owned()).collect();
        Request::read(&self.path("case.toml"), None, &changes)
    }

    /// Runs the case into `folder`, stopped after `steps` steps of this process.
    pub fn run(
        &self,
        folder: &str,
        mode: Mode,
        steps: usize,
    ) -> Result<Option<Summary>, RunFailure> {
        self.run_changed(folder, mode, steps, &[])
    }

    pub fn run_changed(
        &self,
        folder: &str,
        mode: Mode,
        steps: usize,
        changes: &[&str],
    ) -> Result<Option<Summary>, RunFailure> {
        let left = Cell::new(steps);
        let stop = || {
            left.set(left.get() - 1);
            left.get() == 0
        };
        self.run_until(folder, mode, &stop, changes)
    }

    pub fn run_until(
        &self,
        folder: &str,
        mode: Mode,
        stop: &dyn Fn() -> bool,
        changes: &[&str],
    ) -> Result<Option<Summary>, RunFailure> {
        self.run_told(folder, mode, stop, &mut |_, _| {}, changes)
    }

    pub fn run_told(
        &self,
        folder: &str,
        mode: Mode,
        stop: &dyn Fn() -> bool,
        progress: &mut dyn FnMut(&[Ahead], String),
        changes: &[&str],
    ) -> Result<Option<Summary>, RunFailure> {
        let by = Provenance {
            tool: "mpm-run".into(),
            version: "test".into(),
            ..Provenance::default()
        };
        let warn = |said: String| panic!("{said}");
        let request = self.read(changes)?;
        request.execute(&self.path(folder), mode, by, stop, progress, &warn)
    }

    /// A run to its end, or stopped on the way, which must not fail.
    pub fn ran(&self, folder: &str, mode: Mode, steps: usize) -> Summary {
        let ended = self.run(folder, mode, steps).unwrap();
        ended.expect("a run that has not ended")
    }
}

/// The files of a run folder by name. The summary has the costs of the run and is left out.
pub fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = everything(folder);
    files.remove("summary.json");
    files
}

/// All files below a folder by name.
pub fn everything(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        if path.is_dir() {
            let below = everything(&path).into_iter();
            files.extend(below.map(|(file, bytes)| (format!("{name}/{file}"), bytes)));
        } else {
            files.insert(name, fs::read(&path).unwrap());
        }
    }
    files
}

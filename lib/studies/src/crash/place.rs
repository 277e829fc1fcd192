//! The run of about thirty steps and the folder it runs in, and when two run folders are the same.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;

use tempfile::TempDir;

use crate::Result;
use crate::method::Scheme;
use crate::outputs::bin_folder;
use crate::study::{done, filled};

/// Keys of `summary.json` that say what a run cost, which no two runs share.
const COSTS: [&str; 5] = [
    "stepping_wall_s",
    "cpu_s",
    "particle_steps_per_s",
    "peak_memory_bytes",
    "wall_s",
];

/// A case of about thirty steps, each with a row, and four or five snapshots, in some milliseconds: liquid between two
/// plates, pressed out at the sides.
fn case(scheme: Scheme) -> String {
    let (more, stop) = match scheme {
        Scheme::Explicit => ("", "0.007 us"),
        Scheme::Implicit => ("\ncfl = 0.05", "2.95 us"),
    };
    let integrator = format!("{}{more}", scheme.integrator());
    let values = [("integrator", &*integrator), ("stop", stop)];
    filled(include_str!("case.toml"), &values)
}

/// A folder with `case.toml`, in which runs go to `run`.
pub(super) struct Place(TempDir);

impl Place {
    /// A new one for a scheme.
    pub(super) fn new(scheme: Scheme) -> Result<Self> {
        let place = Self(TempDir::new()?);
        fs::write(place.path().join("case.toml"), case(scheme))?;
        Ok(place)
    }

    /// A new one with a copy of this one's run folder.
    pub(super) fn copied(&self, scheme: Scheme) -> Result<Self> {
        let place = Self::new(scheme)?;
        let run = place.run_folder();
        fs::create_dir_all(run.join("snapshots"))?;
        for (name, bytes) in self.content() {
            fs::write(run.join(name), bytes)?;
        }
        Ok(place)
    }

    pub(super) fn path(&self) -> &Path {
        self.0.path()
    }

    pub(super) fn run_folder(&self) -> std::path::PathBuf {
        self.path().join("run")
    }

    /// `mpm-run` in it by way of `before`, words that another program's command line begins with.
    pub(super) fn command(&self, before: &[String], more: &[&str]) -> Command {
        let tool = bin_folder().join("mpm-run").display().to_string();
        let words = [before, &[tool]].concat();
        let mut command = Command::new(&words[0]);
        command
            .args(&words[1..])
            .args(["case.toml", "-o", "run", "--quiet", "--threads", "1"])
            .args(["--set", "output.snapshots=4"])
            .args(more)
            .current_dir(self.path());
        command
    }

    /// Runs it as a user would.
    pub(super) fn done(&self, more: &[&str]) -> Result<()> {
        done(&mut self.command(&[], more)).map(drop)
    }

    /// The files below the run folder, by name.
    fn content(&self) -> BTreeMap<String, Vec<u8>> {
        let (run, mut files) = (self.run_folder(), BTreeMap::new());
        for (folder, prefix) in [(run.clone(), ""), (run.join("snapshots"), "snapshots/")] {
            for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
                // Folders are no files.
                if let Ok(bytes) = fs::read(entry.path()) {
                    let name = entry.file_name();
                    files.insert(format!("{prefix}{}", name.to_string_lossy()), bytes);
                }
            }
        }
        files
    }

    /// Lets a run end, which must hold the same as `whole`.
    pub(super) fn ends_like(&self, whole: &Place, more: &[&str]) -> Result<()> {
        self.done(more).map_err(|said| format!("then {said}"))?;
        whole.same(self)
    }

    /// Whether another's run folder holds the same: all files byte for byte, the costs in `summary.json`
    /// aside.
    pub(super) fn same(&self, other: &Place) -> Result<()> {
        let (one, other) = (self.content(), other.content());
        if !one.keys().eq(other.keys()) {
            return Err(format!("files {:?}, not {:?}", other.keys(), one.keys()).into());
        }
        for (name, bytes) in &one {
            let equal = match name.as_str() {
                "summary.json" => costless(bytes) == costless(&other[name]),
                _ => *bytes == other[name],
            };
            if !equal {
                return Err(format!("{name} differs").into());
            }
        }
        Ok(())
    }
}

fn costless(summary: &[u8]) -> String {
    let text = String::from_utf8_lossy(summary);
    let costs = |line: &str| {
        COSTS
            .iter()
            .any(|key| line.contains(&format!("\"{key}\":")))
    };
    let kept = text.lines().filter(|line| !costs(line));
    kept.collect::<Vec<_>>().join("\n")
}

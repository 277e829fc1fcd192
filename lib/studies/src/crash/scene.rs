//! The run of about thirty steps, the folder it runs in, and when two run folders are the same.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;

use tempfile::TempDir;

use crate::Result;
use crate::case_text::{Body, CaseText};
use crate::method::Scheme;
use crate::outputs::bin_folder;
use crate::study::{ended, said};

/// Keys of `summary.json` that say what a run cost, which no two runs share.
const COSTS: [&str; 5] = [
    "stepping_wall_s",
    "cpu_s",
    "particle_steps_per_s",
    "peak_memory_bytes",
    "wall_s",
];

/// A run of about thirty steps, each with a row, and four or five snapshots, in some milliseconds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scene(pub(super) Scheme);

impl Scene {
    /// Both schemes.
    pub(super) const ALL: [Scene; 2] = [Scene(Scheme::Explicit), Scene(Scheme::Implicit)];

    /// Name of the scheme.
    pub(super) fn name(self) -> &'static str {
        self.0.name()
    }

    /// Liquid between two plates, pressed out at the sides.
    pub(super) fn case(self) -> String {
        let (um, cell) = (1e-6, 2e-6);
        let (integrator, stop) = match self.0 {
            Scheme::Explicit => ("", "0.007 us"),
            Scheme::Implicit => ("\ncfl = 0.05", "2.95 us"),
        };
        let mut case = CaseText::plane(cell, [24.0 * um, 30.0 * um]);
        case.title = "thirty steps".into();
        let plate = |y: [f64; 2]| Body::wall([0.0, y[0], 0.0], [24.0 * um, y[1], cell]);
        case.bodies = vec![
            plate([0.0, 6.0 * um]).named("bottom"),
            plate([16.0 * um, 30.0 * um]).clamped().named("top"),
            Body::liquid([0.0, 6.0 * um, 0.0], [4.0 * um, 16.0 * um, cell]),
        ];
        case.clamp = Some(format!(
            "closing_speed = \"1 m/s\"\nmax_pressure = \"2.5 MPa\"\ntravel = \"4 um\"\nstop = \"{stop}\""
        ));
        case.history_every = 1e-15;
        case.text(&format!("{}{integrator}", self.0.integrator()))
    }
}

/// A folder with `case.toml`, in which runs go to `run`.
pub(super) struct Place(TempDir);

impl Place {
    /// A new one for `scene`.
    pub(super) fn new(scene: Scene) -> Result<Self> {
        let place = Self(TempDir::new()?);
        fs::write(place.path().join("case.toml"), scene.case())?;
        Ok(place)
    }

    /// The same with a copy of another's run folder.
    pub(super) fn with_run_of(scene: Scene, other: &Place) -> Result<Self> {
        let place = Self::new(scene)?;
        let run = place.run_folder();
        fs::create_dir_all(run.join("snapshots"))?;
        for (name, bytes) in content(&other.run_folder())? {
            fs::write(run.join(name), bytes)?;
        }
        Ok(place)
    }

    /// Where it is.
    pub(super) fn path(&self) -> &Path {
        self.0.path()
    }

    /// Its run folder.
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
    ///
    /// # Errors
    /// What it said where it did not end well.
    pub(super) fn done(&self, more: &[&str]) -> Result<()> {
        let output = ended(&mut self.command(&[], more))?;
        match output.status.success() {
            true => Ok(()),
            false => Err(format!("{:?}: {}", output.status, said(&output)).into()),
        }
    }
}

/// The files below a run folder, by name.
pub(super) fn content(run: &Path) -> Result<BTreeMap<String, Vec<u8>>> {
    let mut files = BTreeMap::new();
    for (folder, prefix) in [(run.to_owned(), ""), (run.join("snapshots"), "snapshots/")] {
        for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
            let name = format!("{prefix}{}", entry.file_name().to_string_lossy());
            if entry.path().is_file() {
                files.insert(name, fs::read(entry.path())?);
            }
        }
    }
    Ok(files)
}

/// Whether two run folders hold the same: all files byte for byte, the costs in `summary.json`
/// aside.
///
/// # Errors
/// The first file that differs.
pub(super) fn same(one: &Path, other: &Path) -> Result<()> {
    let [one, other] = [content(one)?, content(other)?];
    let names = |files: &BTreeMap<String, Vec<u8>>| files.keys().cloned().collect::<Vec<_>>();
    if names(&one) != names(&other) {
        return Err(format!("files {:?}, not {:?}", names(&other), names(&one)).into());
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

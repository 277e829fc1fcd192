//! Runs scenes by methods through the real `mpm-run` and measures each.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::method::{Method, Scheme};
use crate::scene::{Measured, Scene};
use crate::study::side_by_side;

/// One scene by one method.
pub struct Job<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The method.
    pub method: Method,
}

/// What a job gave.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// Name of the scene.
    pub scene: String,
    /// The method.
    pub method: Method,
    /// Measured errors, or why there are none.
    pub measured: Result<Vec<Measured>, String>,
    /// Folder of the run.
    pub folder: PathBuf,
    /// Steps; NaN if it did not end.
    pub steps: f64,
    /// User and system time of the run, s; NaN if it did not end.
    pub cpu_s: f64,
}

impl Outcome {
    /// The measured quantity of this name.
    pub fn measured(&self, what: &str) -> Option<&Measured> {
        self.measured.as_ref().ok()?.iter().find(|m| m.what == what)
    }
}

/// The case file of `scene` for the scheme of `method`, written into `folder`; nothing presses in that
/// of the implicit scheme.
///
/// # Errors
/// The system's reason.
pub fn write_case(folder: &Path, scene: &Scene, method: &Method) -> Result<PathBuf, String> {
    let scheme = method.scheme;
    let path = folder.join(format!("{}-{}.toml", scene.name, scheme.name()));
    let case = match scheme {
        Scheme::Explicit => scene.case.clone(),
        Scheme::Implicit => scene.case.clone().released(),
    };
    write_text(&path, &case.text(scheme.integrator()))?;
    Ok(path)
}

/// Writes a case file; whole at any time, because runs of other methods may be reading it.
///
/// # Errors
/// The system's reason.
pub fn write_text(path: &Path, text: &str) -> Result<(), String> {
    static COUNT: AtomicUsize = AtomicUsize::new(0);
    let aside = path.with_extension(format!("{}.tmp", COUNT.fetch_add(1, Ordering::Relaxed)));
    let folder = path.parent().unwrap_or(Path::new("."));
    std::fs::create_dir_all(folder)
        .and_then(|()| std::fs::write(&aside, text))
        .and_then(|()| std::fs::rename(&aside, path))
        .map_err(|e| format!("{}: {e}", path.display()))
}

/// Runs one job in `folder`, which keeps its case in `cases`.
pub fn run_one(job: &Job, folder: &Path) -> Outcome {
    let (scene, method) = (job.scene, &job.method);
    let cases = folder.join("cases");
    let folder = folder.join(format!("{}-{}", scene.name, method.file_label()));
    let run = write_case(&cases, scene, method).and_then(|case| {
        let Some(voxels) = &scene.case.voxels else {
            return method.run(&case, &folder, &[]);
        };
        let bond = case.with_extension("mpts");
        voxels.write(&bond)?;
        let bond = bond.display().to_string();
        method.run(&case, &folder, &["--particles", &bond])
    });
    let number = |key: &str| {
        let run = run.as_ref().ok()?;
        run.summary(key)
    };
    Outcome {
        scene: scene.name.clone(),
        method: job.method.clone(),
        steps: number("steps").unwrap_or(f64::NAN),
        cpu_s: number("cpu_s").unwrap_or(f64::NAN),
        measured: run.and_then(|run| (scene.measure)(&run)),
        folder,
    }
}

/// Runs all jobs and gives their outcomes in the order of the jobs; says each on standard output
/// as it ends.
pub fn run_all(jobs: &[Job], folder: &Path) -> Vec<Outcome> {
    side_by_side(jobs, |job| {
        let outcome = run_one(job, folder);
        say(&outcome);
        outcome
    })
}

fn say(outcome: &Outcome) {
    let head = format!("{:<28} {:<12}", outcome.scene, outcome.method.label);
    match &outcome.measured {
        Ok(list) => {
            for m in list {
                println!(
                    "{head} {:<36} {:+10.3e}  {:7.1} s",
                    m.what, m.error, outcome.cpu_s
                );
            }
        }
        Err(said) => println!("{head} FAILED: {said}"),
    }
}

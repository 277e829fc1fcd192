//! Runs scenes by methods through the real `mpm-run`, as many at a time as the machine has
//! processors, and measures each.

use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::method::Method;
use crate::outputs;
use crate::verification::{Measured, Scene};

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

/// Where a study keeps its files.
pub struct Folders {
    /// Case files.
    pub cases: PathBuf,
    /// Run folders.
    pub runs: PathBuf,
}

/// The case file of `scene` for the scheme of `method`, written into `folder`; whole at any time,
/// because runs of other methods may be reading it.
///
/// # Errors
/// The system's reason.
pub fn write_case(folder: &Path, scene: &Scene, method: &Method) -> Result<PathBuf, String> {
    let scheme = method.scheme;
    let path = folder.join(format!("{}-{}.toml", scene.name, scheme.name()));
    let aside = folder.join(format!("{}-{}.tmp", scene.name, method.file_label()));
    std::fs::create_dir_all(folder)
        .and_then(|()| std::fs::write(&aside, scene.case.text(scheme.integrator())))
        .and_then(|()| std::fs::rename(&aside, &path))
        .map_err(|e| format!("{}: {e}", path.display()))?;
    Ok(path)
}

/// Runs one job with one thread.
pub fn run_one(job: &Job, folders: &Folders) -> Outcome {
    let scene = job.scene;
    let folder = folders
        .runs
        .join(format!("{}-{}", scene.name, job.method.file_label()));
    let mut arguments = vec!["--threads", "1"];
    for change in &job.method.set {
        arguments.extend(["--set", change]);
    }
    let run = write_case(&folders.cases, scene, &job.method)
        .and_then(|case| outputs::run(&job.method.program(), &case, &folder, &arguments));
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
pub fn run_all(jobs: &[Job], folders: &Folders) -> Vec<Outcome> {
    side_by_side(jobs.len(), |i| {
        let outcome = run_one(&jobs[i], folders);
        say(&outcome);
        outcome
    })
}

/// Does `count` pieces of work, as many at a time as there are processors; results in order.
pub fn side_by_side<T: Send>(count: usize, work: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let next = AtomicUsize::new(0);
    let done: Mutex<Vec<(usize, T)>> = Mutex::new(Vec::new());
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..workers.min(count) {
            scope.spawn(|| {
                loop {
                    let i = next.fetch_add(1, Ordering::Relaxed);
                    if i >= count {
                        return;
                    }
                    let result = work(i);
                    if let Ok(mut done) = done.lock() {
                        done.push((i, result));
                    }
                }
            });
        }
    });
    let mut done = done.into_inner().unwrap_or_default();
    done.sort_by_key(|(i, _)| *i);
    done.into_iter().map(|(_, result)| result).collect()
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

/// First words of a results page: what made it, when, and on what machine.
pub fn origin(command: &str) -> String {
    let said = |program: &str, arguments: &[&str]| {
        let output = std::process::Command::new(program)
            .args(arguments)
            .output()
            .ok()?;
        let text = String::from_utf8(output.stdout).ok()?;
        Some(text.trim().to_owned()).filter(|t| !t.is_empty())
    };
    let unknown = || "unknown".to_owned();
    let date = said("date", &["-u", "+%Y-%m-%d %H:%M UTC"]).unwrap_or_else(unknown);
    let commit = said("git", &["rev-parse", "--short", "HEAD"]).unwrap_or_else(unknown);
    let changed = said("git", &["status", "--porcelain", "lib", "tools", "tests"]);
    let processor = std::fs::read_to_string("/proc/cpuinfo")
        .ok()
        .and_then(|text| {
            let line = text.lines().find(|l| l.starts_with("model name"))?;
            Some(line.split(':').nth(1)?.trim().to_owned())
        })
        .unwrap_or_else(unknown);
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    format!(
        "Written by `{command}` on {date}: commit {commit}{}, {processor} ({cores} processors)",
        if changed.is_some() {
            " with changes not yet committed"
        } else {
            ""
        },
    )
}

/// First lines of a results page: its origin and the cost of its runs.
pub fn provenance(command: &str, outcomes: &[Outcome]) -> String {
    let cpu: f64 = outcomes
        .iter()
        .map(|o| o.cpu_s)
        .filter(|s| s.is_finite())
        .sum();
    format!(
        "{}, {} runs of one thread each, {cpu:.0} CPU seconds in all.\n",
        origin(command),
        outcomes.len()
    )
}

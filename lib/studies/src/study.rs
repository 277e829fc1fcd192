//! Parts that all studies share: provenance, pieces of work side by side, the time limit, result files.

use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, mpsc};
use std::time::Duration;

/// What a run may take by the clock. The longest, of `make tradeoff` with twelve cells, takes 95 CPU
/// seconds, and the machine may be shared.
const LIMIT: Duration = Duration::from_secs(3600);

/// What pictures of results are made for: sharp on a screen, small in the repository.
pub const PAGE: figures::Page = figures::Page {
    width_mm: None,
    dpi: 180.0,
};

/// What numbers depend on: the commit named by a page is the last that changed any of these.
const SOURCES: [&str; 6] = [
    "lib",
    "tools",
    "pipelines",
    "Cargo.toml",
    "Cargo.lock",
    "rust-toolchain.toml",
];

/// A study, called as its make target.
pub struct Study {
    name: String,
    origin: String,
    results: PathBuf,
    only: Vec<String>,
    /// Something was named so.
    found: AtomicBool,
}

impl Study {
    /// The study `name`, which writes its pages to `results`, on what is named by a word that holds
    /// one of `only`, or on all.
    ///
    /// # Errors
    /// The system's reason why there is no folder of results.
    pub fn begin(name: &str, results: &Path, only: &[String]) -> Result<Self, String> {
        std::fs::create_dir_all(results).map_err(|e| format!("{}: {e}", results.display()))?;
        Ok(Self {
            name: name.to_owned(),
            // At the beginning: what is edited while the study is on has not been measured.
            origin: origin(&format!("make {name}")),
            results: results.to_owned(),
            only: only.to_owned(),
            found: AtomicBool::new(only.is_empty()),
        })
    }

    /// The folder of its cases and runs.
    pub fn folder(&self) -> PathBuf {
        Path::new("out").join(&self.name)
    }

    /// Whether a part of this name is to be done.
    pub fn wants(&self, name: &str) -> bool {
        let wanted = self.whole() || self.only.iter().any(|part| name.contains(part));
        self.found.fetch_or(wanted, Ordering::Relaxed);
        wanted
    }

    /// Refuses parts of names of which none was asked for.
    ///
    /// # Errors
    /// The parts.
    pub fn check_only(&self) -> Result<(), String> {
        if self.found.load(Ordering::Relaxed) {
            return Ok(());
        }
        Err(format!(
            "nothing has one of '{}' in its name",
            self.only.join(" ")
        ))
    }

    /// Whether all of it is to be done.
    pub fn whole(&self) -> bool {
        self.only.is_empty()
    }

    /// First words of a page: what made it, when, of which commit, on what machine.
    pub fn origin(&self) -> &str {
        &self.origin
    }

    /// First lines of a page on runs of one thread each that took these CPU times (s; NaN for one
    /// that did not end).
    pub fn head(&self, cpu_s: impl Iterator<Item = f64>) -> String {
        let all: Vec<f64> = cpu_s.collect();
        let sum: f64 = all.iter().filter(|s| s.is_finite()).sum();
        format!(
            "{}, {} runs of one thread each, {sum:.0} CPU seconds in all.\n",
            self.origin,
            all.len()
        )
    }

    /// Writes a file of results.
    ///
    /// # Errors
    /// The system's reason.
    pub fn write(&self, name: &str, content: impl AsRef<[u8]>) -> Result<(), String> {
        let path = self.results.join(name);
        std::fs::write(&path, content).map_err(|e| format!("{}: {e}", path.display()))
    }

    /// Writes a table with the columns named in `header`, by commas.
    ///
    /// # Errors
    /// The system's reason.
    pub fn write_csv(
        &self,
        name: &str,
        header: &str,
        rows: impl IntoIterator<Item = Vec<String>>,
    ) -> Result<(), String> {
        let path = self.results.join(name);
        let failed = |e: &dyn std::fmt::Display| format!("{}: {e}", path.display());
        let mut table = csv::Writer::from_path(&path).map_err(|e| failed(&e))?;
        table
            .write_record(header.split(','))
            .map_err(|e| failed(&e))?;
        for row in rows {
            table.write_record(row).map_err(|e| failed(&e))?;
        }
        table.flush().map_err(|e| failed(&e))
    }
}

/// What made a page, when, of which commit, on what machine.
pub fn origin(command: &str) -> String {
    let said = |program: &str, arguments: &[&str]| {
        let output = Command::new(program).args(arguments).output().ok()?;
        let text = String::from_utf8(output.stdout).ok()?;
        Some(text.trim().to_owned()).filter(|t| !t.is_empty())
    };
    let unknown = || "unknown".to_owned();
    let git = |first: &[&str]| said("git", &[first, &["--"], &SOURCES].concat());
    let date = said("date", &["-u", "+%Y-%m-%d %H:%M UTC"]).unwrap_or_else(unknown);
    let commit = git(&["log", "-1", "--format=%h"]).unwrap_or_else(unknown);
    let changed = match git(&["status", "--porcelain"]) {
        Some(_) => " with changes not yet committed",
        None => "",
    };
    let processor = std::fs::read_to_string("/proc/cpuinfo")
        .ok()
        .and_then(|text| {
            let line = text.lines().find(|l| l.starts_with("model name"))?;
            Some(line.split(':').nth(1)?.trim().to_owned())
        })
        .unwrap_or_else(unknown);
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    format!(
        "Written by `{command}` on {date}: commit {commit}{changed}, {processor} ({cores} processors)"
    )
}

/// Does `work` on each of `list`, as many at a time as there are processors; results in order.
pub fn side_by_side<P: Sync, T: Send>(list: &[P], work: impl Fn(&P) -> T + Sync) -> Vec<T> {
    let next = AtomicUsize::new(0);
    let done: Mutex<Vec<(usize, T)>> = Mutex::new(Vec::new());
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..workers.min(list.len()) {
            scope.spawn(|| {
                loop {
                    let i = next.fetch_add(1, Ordering::Relaxed);
                    let Some(piece) = list.get(i) else { return };
                    let result = work(piece);
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

/// What `command` ended with, whatever its exit status.
///
/// # Errors
/// It could not be started, or was killed because it took longer than the studies' time limit.
pub fn ended(command: &mut Command) -> Result<Output, String> {
    let name = command.get_program().display().to_string();
    let child = command
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(|e| format!("{name} cannot be started: {e}; build the workspace first"))?;
    let id = child.id().to_string();
    let (end, ends) = mpsc::channel();
    std::thread::spawn(move || end.send(child.wait_with_output()));
    match ends.recv_timeout(LIMIT) {
        Ok(output) => output.map_err(|e| format!("{name}: {e}")),
        Err(_) => {
            // Nobody is left to hear what became of the signal.
            let _ = Command::new("kill").args(["-KILL", &id]).status();
            Err(format!("not ended after {} s", LIMIT.as_secs()))
        }
    }
}

/// What a tool said on standard error.
pub fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).trim().to_owned()
}

/// Each of `list` once, in the order of their first places.
pub fn distinct<T: PartialEq>(list: impl Iterator<Item = T>) -> Vec<T> {
    let mut found = Vec::new();
    for one in list {
        if !found.contains(&one) {
            found.push(one);
        }
    }
    found
}

//! Parts that all studies share: provenance, the time limit, result files.

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc;
use std::time::Duration;

use figures::Drawing;
use rayon::prelude::*;

use crate::Result;

/// What a run may take by the clock. The longest, of `make tradeoff` with twelve cells, takes 95 CPU
/// seconds, and the machine may be shared.
const LIMIT: Duration = Duration::from_secs(3600);

/// What pictures of results are made for: sharp on a screen, small in the repository.
pub(crate) const PAGE: figures::Page = figures::Page {
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
    pub fn begin(name: &str, results: &Path, only: &[String]) -> Result<Self> {
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
    pub(crate) fn folder(&self) -> PathBuf {
        Path::new("out").join(&self.name)
    }

    /// Whether a part of this name is to be done.
    pub(crate) fn wants(&self, name: &str) -> bool {
        let wanted = self.whole() || self.only.iter().any(|part| name.contains(part));
        self.found.fetch_or(wanted, Ordering::Relaxed);
        wanted
    }

    /// Refuses parts of names of which none was asked for.
    pub fn check_only(&self) -> Result<()> {
        match self.found.load(Ordering::Relaxed) {
            true => Ok(()),
            false => {
                Err(format!("nothing has one of '{}' in its name", self.only.join(" ")).into())
            }
        }
    }

    /// Whether all of it is to be done.
    pub(crate) fn whole(&self) -> bool {
        self.only.is_empty()
    }

    /// First words of a page: what made it, when, of which commit, on what machine.
    pub(crate) fn origin(&self) -> &str {
        &self.origin
    }

    /// First lines of a page on runs of one thread each that took these CPU times (s; NaN for one
    /// that did not end).
    pub(crate) fn head(&self, cpu_s: impl Iterator<Item = f64>) -> String {
        let all: Vec<f64> = cpu_s.collect();
        let sum: f64 = all.iter().filter(|s| s.is_finite()).sum();
        let (origin, runs) = (&self.origin, all.len());
        format!("{origin}, {runs} runs of one thread each, {sum:.0} CPU seconds in all.\n")
    }

    /// Writes a file of results.
    pub(crate) fn write(&self, name: &str, content: impl AsRef<[u8]>) -> Result<()> {
        write(&self.results.join(name), content)
    }

    /// Writes a picture.
    pub(crate) fn draw(&self, name: &str, drawing: Result<Drawing, figures::Error>) -> Result<()> {
        let bytes = drawing.and_then(|d| d.to_png());
        self.write(name, bytes.map_err(|e| format!("{name}: {e}"))?)
    }

    /// Writes a table with the columns named in `header`, by commas.
    pub(crate) fn write_csv(
        &self,
        name: &str,
        header: &str,
        rows: impl IntoIterator<Item = Vec<String>>,
    ) -> Result<()> {
        let mut table = csv::Writer::from_writer(Vec::new());
        table.write_record(header.split(','))?;
        for row in rows {
            table.write_record(row)?;
        }
        self.write(name, table.into_inner().map_err(|e| e.to_string())?)
    }
}

/// A page's text with values, without the ends of their last lines, in the places of their `{names}`.
pub(crate) fn filled(page: &str, values: &[(&str, &str)]) -> String {
    values.iter().fold(page.to_owned(), |text, (name, value)| {
        text.replace(&format!("{{{name}}}"), value.trim_end_matches('\n'))
    })
}

/// A table of a page: the line of its heads and its rows, cells between bars.
pub(crate) fn table(heads: &str, rows: impl IntoIterator<Item = String>) -> String {
    let rule = "---|".repeat(heads.matches('|').count() - 1);
    let rows = rows.into_iter().map(|row| row + "\n");
    format!("{heads}\n|{rule}\n{}", rows.collect::<String>())
}

/// What made a page, when, of which commit, on what machine.
fn origin(command: &str) -> String {
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
    let processors = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = processors.lines().find(|l| l.starts_with("model name"));
    let model = model.and_then(|line| Some(line.split(':').nth(1)?.trim().to_owned()));
    let processor = model.unwrap_or_else(unknown);
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    format!(
        "Written by `{command}` on {date}: commit {commit}{changed}, {processor} ({cores} processors)"
    )
}

/// Writes a file and its folder; whole at any time, because other runs may be reading it.
pub(crate) fn write(path: &Path, content: impl AsRef<[u8]>) -> Result<()> {
    static COUNT: AtomicUsize = AtomicUsize::new(0);
    let aside = path.with_extension(format!("{}.tmp", COUNT.fetch_add(1, Ordering::Relaxed)));
    std::fs::create_dir_all(path.parent().unwrap_or(Path::new(".")))
        .and_then(|()| std::fs::write(&aside, content))
        .and_then(|()| std::fs::rename(&aside, path))
        .map_err(|e| format!("{}: {e}", path.display()).into())
}

/// Does `work` on each of `list`, as many at a time as there are processors; results in order, or
/// the first error where they are collected so.
pub(crate) fn side_by_side<P: Sync, T: Send, C: FromParallelIterator<T>>(
    list: &[P],
    work: impl Fn(&P) -> T + Sync + Send,
) -> C {
    list.par_iter().with_max_len(1).map(work).collect()
}

/// What `command` ended with, whatever its exit status; killed, and an error, where it takes longer than [`LIMIT`].
pub(crate) fn ended(command: &mut Command) -> Result<Output> {
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
        Ok(output) => output.map_err(|e| format!("{name}: {e}").into()),
        Err(_) => {
            // Nobody is left to hear what became of the signal.
            let _ = Command::new("kill").args(["-KILL", &id]).status();
            Err(format!("not ended after {} s", LIMIT.as_secs()).into())
        }
    }
}

/// The same of a command that ended well.
pub(crate) fn done(command: &mut Command) -> Result<Output> {
    let output = ended(command)?;
    match output.status.success() {
        true => Ok(output),
        false => Err(format!("{}: {}", output.status, said(&output)).into()),
    }
}

/// What such a command printed.
pub(crate) fn printed(command: &mut Command) -> Result<String> {
    let output = done(command)?;
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

/// Whether a program is there and does what `arguments` ask.
pub(crate) fn works(program: &str, arguments: &[&str]) -> bool {
    let output = Command::new(program).args(arguments).output();
    output.is_ok_and(|output| output.status.success())
}

/// Tells a process to stop.
pub(crate) fn terminate(child: &Child) -> Result<()> {
    let id = child.id().to_string();
    let mut kill = Command::new("kill");
    kill.args(["-TERM", &id]).stderr(Stdio::null()).status()?;
    Ok(())
}

/// What a tool said on standard error.
pub(crate) fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).trim().to_owned()
}

/// Each of `list` once, in the order of their first places.
pub(crate) fn distinct<T: PartialEq>(list: impl Iterator<Item = T>) -> Vec<T> {
    let mut found = Vec::new();
    for one in list {
        if !found.contains(&one) {
            found.push(one);
        }
    }
    found
}

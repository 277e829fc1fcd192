//! Ways to run a scene: scheme, velocity update and what else a user can set.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use crate::Result;
use crate::outputs::{Run, bin_folder};
use crate::study::{ended, said};

/// A scheme with its options, as `--set` arguments on the scheme's plain case file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Method {
    /// Name in tables, e.g. "XPIC(5)".
    pub label: String,
    pub(crate) scheme: Scheme,
    /// Keys changed, e.g. "integrator.order=5".
    pub(crate) set: Vec<String>,
    /// Another build of `mpm-run` than the one beside the study.
    program: Option<PathBuf>,
}

/// The two schemes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Scheme {
    /// The paper's material point method.
    Explicit,
    /// Liquid as volume fractions on a staggered grid.
    Implicit,
}

impl Scheme {
    pub(crate) const ALL: [Scheme; 2] = [Scheme::Explicit, Scheme::Implicit];

    /// Its name in case files.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Scheme::Explicit => "explicit",
            Scheme::Implicit => "implicit",
        }
    }

    /// Lines of `[integrator]` in a plain case file: FLIP, or the tolerance at which the linear
    /// solver adds nothing to the errors measured.
    pub(crate) fn integrator(self) -> &'static str {
        match self {
            Scheme::Explicit => "scheme = \"explicit\"\nvelocity_update = \"flip\"",
            Scheme::Implicit => "scheme = \"implicit\"\ntolerance = 1e-4",
        }
    }
}

impl Method {
    /// The method that tables call so: the implicit scheme, or the explicit one with an update, FLIP, PIC, APIC, or XPIC or FMPM
    /// with its order in brackets.
    pub fn named(label: &str) -> Self {
        let scheme = match label {
            "implicit" => Scheme::Implicit,
            _ => Scheme::Explicit,
        };
        let mut set = Vec::new();
        let (update, order) = label.split_once('(').unwrap_or((label, ""));
        if !["FLIP", "implicit"].contains(&update) {
            let update = update.to_lowercase();
            set.push(format!("integrator.velocity_update=\"{update}\""));
        }
        if let Some(order) = order.strip_suffix(')') {
            set.push(format!("integrator.order={order}"));
        }
        Self {
            label: label.into(),
            scheme,
            set,
            program: None,
        }
    }

    /// The implicit scheme.
    pub fn implicit() -> Self {
        Self::named("implicit")
    }

    /// Every update of the explicit scheme, in the order of tables.
    pub(crate) const UPDATES: [&str; 9] = [
        "FLIP", "PIC", "APIC", "XPIC(2)", "XPIC(3)", "XPIC(5)", "FMPM(2)", "FMPM(3)", "FMPM(5)",
    ];

    /// This method with another key set.
    pub fn setting(mut self, change: impl Into<String>) -> Self {
        self.set.push(change.into());
        self
    }

    /// This method with keys set, which its label calls `name`.
    pub(crate) fn with(&self, name: &str, keys: &[&str]) -> Self {
        let label = format!("{}, {name}", self.label);
        let set = keys.iter().fold(self.clone(), |m, key| m.setting(*key));
        set.called(label)
    }

    /// This method by another build of `mpm-run`.
    pub(crate) fn by(mut self, program: &Path) -> Self {
        self.program = Some(program.to_owned());
        self
    }

    /// This method by another name.
    pub(crate) fn called(mut self, label: impl Into<String>) -> Self {
        self.label = label.into();
        self
    }

    /// The label as part of a file name.
    pub(crate) fn file_label(&self) -> String {
        let plain = |c: char| match c {
            ' ' => Some('-'),
            c => (c.is_ascii_alphanumeric() || c == '.').then_some(c.to_ascii_lowercase()),
        };
        self.label.chars().filter_map(plain).collect()
    }

    /// The command of a run of `case` into `folder` with one thread.
    pub(crate) fn command(&self, case: &Path, folder: &Path) -> Command {
        let own = || bin_folder().join("mpm-run");
        let mut command = Command::new(self.program.clone().unwrap_or_else(own));
        command.arg(case).arg("-o").arg(folder);
        command.args(["--overwrite", "--quiet", "--threads", "1"]);
        for change in &self.set {
            command.args(["--set", change]);
        }
        command
    }

    /// Runs `case` into `folder` with one thread; `more` are further arguments.
    pub(crate) fn attempt(&self, case: &Path, folder: &Path, more: &[&str]) -> Result<Output> {
        ended(self.command(case, folder).args(more))
    }

    /// The same, which must end well.
    pub(crate) fn run(&self, case: &Path, folder: &Path, more: &[&str]) -> Result<Run> {
        let output = self.attempt(case, folder, more)?;
        if !output.status.success() {
            let (case, code) = (case.display(), output.status.code());
            return Err(format!("{case}: exit {code:?}: {}", said(&output)).into());
        }
        let folder = folder.to_owned();
        Ok(Run { folder })
    }
}

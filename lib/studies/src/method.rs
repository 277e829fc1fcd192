//! Ways to run a scene: scheme, velocity update and what else a user can set.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use crate::outputs::{self, Run};
use crate::study::{ended, said};

/// A scheme with its options, as `--set` arguments on the scheme's plain case file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Method {
    /// Name in tables, e.g. "XPIC(5)".
    pub label: String,
    /// The scheme.
    pub scheme: Scheme,
    /// Keys changed, e.g. "integrator.order=5".
    pub set: Vec<String>,
    /// Another build of `mpm-run` than the one beside the study.
    program: Option<PathBuf>,
}

/// The two schemes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scheme {
    /// The paper's material point method.
    Explicit,
    /// Liquid as volume fractions on a staggered grid.
    Implicit,
}

impl Scheme {
    /// Its name in case files.
    pub fn name(self) -> &'static str {
        match self {
            Scheme::Explicit => "explicit",
            Scheme::Implicit => "implicit",
        }
    }

    /// Lines of `[integrator]` in a plain case file: FLIP, or the tolerance at which the linear
    /// solver adds nothing to the errors measured.
    pub fn integrator(self) -> &'static str {
        match self {
            Scheme::Explicit => "scheme = \"explicit\"\nvelocity_update = \"flip\"",
            Scheme::Implicit => "scheme = \"implicit\"\ntolerance = 1e-4",
        }
    }
}

impl Method {
    /// The explicit scheme with FLIP.
    pub fn flip() -> Self {
        Self {
            label: "FLIP".into(),
            scheme: Scheme::Explicit,
            set: Vec::new(),
            program: None,
        }
    }

    /// The explicit scheme with PIC.
    pub fn pic() -> Self {
        Self::flip().updating("PIC", "pic")
    }

    /// The explicit scheme with APIC.
    pub fn apic() -> Self {
        Self::flip().updating("APIC", "apic")
    }

    /// The explicit scheme with XPIC of order `m`.
    pub fn xpic(m: u8) -> Self {
        Self::flip()
            .updating(&format!("XPIC({m})"), "xpic")
            .setting(format!("integrator.order={m}"))
    }

    /// The explicit scheme with FMPM of order `m`.
    pub fn fmpm(m: u8) -> Self {
        Self::flip()
            .updating(&format!("FMPM({m})"), "fmpm")
            .setting(format!("integrator.order={m}"))
    }

    /// The implicit scheme.
    pub fn implicit() -> Self {
        Self {
            label: "implicit".into(),
            scheme: Scheme::Implicit,
            set: Vec::new(),
            program: None,
        }
    }

    /// Every update of the explicit scheme.
    pub fn updates() -> Vec<Self> {
        vec![
            Self::flip(),
            Self::pic(),
            Self::apic(),
            Self::xpic(2),
            Self::xpic(5),
            Self::fmpm(2),
            Self::fmpm(5),
        ]
    }

    fn updating(mut self, label: &str, update: &str) -> Self {
        self.label = label.into();
        self.set
            .push(format!("integrator.velocity_update=\"{update}\""));
        self
    }

    /// This method with another key set.
    pub fn setting(mut self, change: impl Into<String>) -> Self {
        self.set.push(change.into());
        self
    }

    /// This method by another build of `mpm-run`.
    pub fn by(mut self, program: &Path) -> Self {
        self.program = Some(program.to_owned());
        self
    }

    /// Runs `case` into `folder` with one thread; `more` are further arguments.
    ///
    /// # Errors
    /// `mpm-run` could not be started, or took too long.
    pub fn attempt(&self, case: &Path, folder: &Path, more: &[&str]) -> Result<Output, String> {
        ended(self.command(case, folder).args(more))
    }

    /// The command of a run of `case` into `folder` with one thread.
    pub(crate) fn command(&self, case: &Path, folder: &Path) -> Command {
        let own = || outputs::bin_folder().join("mpm-run");
        let mut command = Command::new(self.program.clone().unwrap_or_else(own));
        command.arg(case).arg("-o").arg(folder);
        command.args(["--overwrite", "--quiet", "--threads", "1"]);
        for change in &self.set {
            command.args(["--set", change]);
        }
        command
    }

    /// The same, which must end well.
    ///
    /// # Errors
    /// What `mpm-run` said on standard error, with its exit status.
    pub fn run(&self, case: &Path, folder: &Path, more: &[&str]) -> Result<Run, String> {
        let output = self.attempt(case, folder, more)?;
        if !output.status.success() {
            let (case, code) = (case.display(), output.status.code());
            return Err(format!("{case}: exit {code:?}: {}", said(&output)));
        }
        Ok(Run {
            folder: folder.to_owned(),
        })
    }

    /// This method by another name.
    pub fn called(mut self, label: impl Into<String>) -> Self {
        self.label = label.into();
        self
    }

    /// The label as part of a file name.
    pub fn file_label(&self) -> String {
        let plain = |c: char| {
            if c.is_ascii_alphanumeric() || c == '.' {
                Some(c.to_ascii_lowercase())
            } else {
                (c == ' ').then_some('-')
            }
        };
        self.label.chars().filter_map(plain).collect()
    }
}

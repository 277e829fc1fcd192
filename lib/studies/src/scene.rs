//! Scenes whose right results are known.

use crate::case_text::CaseText;
use crate::outputs::Run;

/// Measures a run; an error is a sentence.
pub type Measure = Box<dyn Fn(&Run) -> Result<Vec<Measured>, String> + Send + Sync>;

/// A scene with the error of a run of it.
pub struct Scene {
    /// Name of the case file, e.g. "channel-n6-off0.25": its family, the cells across the lumen
    /// where other scenes differ in them alone, and the rest.
    pub name: String,
    /// The case.
    pub case: CaseText,
    /// What is compared, with its equation.
    pub against: &'static str,
    /// Named errors of a run.
    pub measure: Measure,
}

impl Scene {
    /// First word of the name.
    pub fn family(&self) -> &str {
        self.name.split('-').next().unwrap_or_default()
    }

    /// Cells across the lumen, if the name says so, and the name without them: scenes that agree
    /// in the latter are one refinement series.
    pub fn resolution(name: &str) -> (String, Option<u32>) {
        let cells = |part: &str| part.strip_prefix('n')?.parse::<u32>().ok();
        let found = name.split('-').find_map(cells);
        let series: Vec<&str> = name.split('-').filter(|p| cells(p).is_none()).collect();
        (series.join("-"), found)
    }
}

/// One number measured against its reference.
#[derive(Clone, Debug)]
pub struct Measured {
    /// What, e.g. "mean velocity".
    pub what: String,
    /// Value of the run.
    pub value: f64,
    /// Value of the closed form or reference.
    pub reference: f64,
    /// Error as stated: relative unless `what` says otherwise.
    pub error: f64,
    /// Whether the error is a number of things, not a share.
    pub counted: bool,
}

impl Measured {
    /// A value with its relative error.
    pub fn relative(what: impl Into<String>, value: f64, reference: f64) -> Self {
        Self {
            what: what.into(),
            value,
            reference,
            error: value / reference - 1.0,
            counted: false,
        }
    }

    /// An error that is itself the value, e.g. a noise relative to a maximum.
    pub fn absolute(what: impl Into<String>, error: f64) -> Self {
        Self {
            what: what.into(),
            value: error,
            reference: 0.0,
            error,
            counted: false,
        }
    }

    /// A number of things that should be none.
    pub fn count(what: impl Into<String>, number: usize) -> Self {
        Self {
            counted: true,
            ..Self::absolute(what, number as f64)
        }
    }
}

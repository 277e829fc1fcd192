//! The verification scenes: for each a case text and a measure of its error.

pub mod channel;
pub mod couette;
pub mod incline;
pub mod slit;
pub mod squeeze;
pub mod tait;
pub mod washburn;

use crate::case_text::CaseText;
use crate::outputs::Run;

/// Width of the lumen of all scenes, m (paper section 2.3).
pub const LUMEN: f64 = 17.4e-6;

/// Measures a run; an error is a sentence.
pub type Measure = Box<dyn Fn(&Run) -> Result<Vec<Measured>, String>>;

/// A scene with the error of a run of it.
pub struct Scene {
    /// Name of the case file, e.g. "channel-n6-off0.25".
    pub name: String,
    /// The case.
    pub case: CaseText,
    /// What is compared, with its equation.
    pub against: &'static str,
    /// Named errors of a run.
    pub measure: Measure,
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
}

impl Measured {
    /// A value with its relative error.
    pub fn relative(what: impl Into<String>, value: f64, reference: f64) -> Self {
        Self {
            what: what.into(),
            value,
            reference,
            error: value / reference - 1.0,
        }
    }

    /// An error that is itself the value, e.g. a noise relative to a maximum.
    pub fn absolute(what: impl Into<String>, error: f64) -> Self {
        Self {
            what: what.into(),
            value: error,
            reference: 0.0,
            error,
        }
    }
}

/// Speed of the upper wall towards the lower one, m/s, that raises the pressure to 1 MPa by the
/// time `until` (s). The wall law is unilateral: without pressure, as in the adhesive that a
/// clamp presses, liquid would slip off the walls.
pub(crate) fn pressing(until: f64) -> f64 {
    1e6 / crate::case_text::PF[1] * LUMEN / until
}

/// Rows of a column in a window of another, averaged.
pub(crate) fn window_mean(x: &[f64], y: &[f64], from: f64, to: f64) -> Option<f64> {
    let inside: Vec<f64> = x
        .iter()
        .zip(y)
        .filter(|(x, _)| (from..to).contains(*x))
        .map(|(_, y)| *y)
        .collect();
    (!inside.is_empty()).then(|| inside.iter().sum::<f64>() / inside.len() as f64)
}

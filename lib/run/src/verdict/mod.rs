//! Whether a run's results can be relied on: what is looked at while it runs, and the judgement of
//! its last state. Exit status 0 is a claim that all of it holds.
//!
//! The bounds, and why they lie there, are in docs/verdicts.md.

mod course;
mod end;

use std::fs;
use std::path::Path;

use physics::Scene;
use serde::{Deserialize, Serialize};

use crate::failure::RunFailure;
use crate::folder;

pub(crate) use course::{MOST_PRESSURE, state, step};
pub(crate) use end::judge;

/// Whether the last state of a run is sound.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    /// Whether nothing speaks against it.
    pub sound: bool,
    /// What does, a clause each.
    pub reasons: Vec<String>,
}

impl Verdict {
    pub(crate) fn because(reasons: Vec<String>) -> Self {
        Self {
            sound: reasons.is_empty(),
            reasons,
        }
    }

    /// This one, and what the scheme says against its results.
    pub(crate) fn and(mut self, objection: Option<String>) -> Self {
        self.reasons.extend(objection);
        Self::because(self.reasons)
    }

    /// That of the run that ended in `folder`.
    ///
    /// # Errors
    /// [`RunFailure::Data`] where its summary does not say.
    pub fn of_ended(folder: &Path) -> Result<Self, RunFailure> {
        let read = || {
            let text = fs::read_to_string(folder.join(folder::SUMMARY)).ok()?;
            let summary: serde_json::Value = serde_json::from_str(&text).ok()?;
            serde_json::from_value(summary.get("verdict")?.clone()).ok()
        };
        read().ok_or_else(|| {
            RunFailure::Data(format!(
                "the run in '{}' has ended, but its summary.json does not say whether the results are sound: remove the folder to run it again",
                folder.display()
            ))
        })
    }

    /// What is wrong, as a sentence; nothing of a sound state.
    pub fn objection(&self) -> Option<String> {
        (!self.sound).then(|| {
            format!(
                "the results are not sound (kept, and marked so in summary.json): {}",
                self.reasons.join("; ")
            )
        })
    }
}

/// What is wrong with liquid of this largest speed (m/s), if it is too fast for any scheme here.
fn faster_than_sound(scene: &Scene, speed: f64) -> Option<String> {
    let sound = scene.liquid.sound_speed();
    (speed > sound).then(|| {
        format!(
            "liquid moves at {speed:.3e} m/s, above its speed of sound sqrt(K/rho) = {sound:.3e} m/s, which no pressing gives it"
        )
    })
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::case::Case;
    use crate::resolve::{Setup, resolve};

    /// A box of 4 x 2 cells of 1 um full of liquid on a floor of one cell.
    pub(crate) fn setup() -> Setup {
        let text = r#"
[grid]
cell = "1 um"
dimensions = 2
[adhesive]
density = "1000 kg/m3"
bulk_modulus = "1 GPa"
viscosity = "1 Pa s"
[contact]
law = "stick"
[stop]
time = "1 us"
[integrator]
scheme = "implicit"
[[body]]
material = "rigid"
box = { min = ["0 um", "0 um", "0 um"], max = ["4 um", "2 um", "1 um"] }
[[body]]
material = "adhesive"
box = { min = ["0 um", "2 um", "0 um"], max = ["4 um", "4 um", "1 um"] }
"#;
        let case = Case::parse(text, Path::new("case.toml")).unwrap();
        resolve(&case, None).unwrap()
    }
}

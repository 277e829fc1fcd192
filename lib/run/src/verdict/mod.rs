//! Whether a run's results are sound: checks during the run, and the verdict on its last state. Exit status 0 claims that
//! all of them hold.
//!
//! docs/verdicts.md lists the bounds and their reasons.

mod checks;
mod judge;

use std::fs;
use std::path::Path;

use physics::Scene;
use serde::{Deserialize, Serialize};

use crate::failure::RunFailure;
use crate::folder;

pub(crate) use checks::{MOST_PRESSURE, check_state, check_step};
pub(crate) use judge::judge;

/// Whether the last state of a run is sound.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Verdict {
    /// Whether there is no objection.
    pub sound: bool,
    /// The objections, a clause each.
    pub reasons: Vec<String>,
}

impl Verdict {
    pub(crate) fn because(reasons: Vec<String>) -> Self {
        Self {
            sound: reasons.is_empty(),
            reasons,
        }
    }

    /// This verdict with the scheme's own objection, if any.
    pub(crate) fn and(mut self, objection: Option<String>) -> Self {
        self.reasons.extend(objection);
        Self::because(self.reasons)
    }

    /// The verdict on the run that ended in `folder`.
    ///
    /// # Errors
    /// [`RunFailure::Data`] if its summary has no verdict.
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

    /// The objections as a sentence; `None` for a sound state.
    pub fn objection(&self) -> Option<String> {
        (!self.sound).then(|| {
            format!(
                "the results are not sound (kept, but marked in summary.json): {}",
                self.reasons.join("; ")
            )
        })
    }
}

/// The objection to liquid with this largest speed (m/s), if it exceeds the speed of sound.
fn faster_than_sound(scene: &Scene, speed: f64) -> Option<String> {
    let sound = scene.liquid.sound_speed();
    (speed > sound).then(|| {
        format!(
            "liquid moves at {speed:.3e} m/s, above its speed of sound sqrt(K/rho) = {sound:.3e} m/s, which pressing cannot cause"
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

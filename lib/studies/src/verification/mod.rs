//! The verification scenes: for each a case text and a measure of its error.

pub(crate) mod acoustic;
pub(crate) mod air;
mod catalogue;
pub(crate) mod channel;
pub(crate) mod clamp;
pub(crate) mod cure;
pub(crate) mod duct;
pub(crate) mod galilean;
mod goals;
mod grain;
pub(crate) mod incline;
pub(crate) mod laws;
pub mod lumen;
pub mod piston;
mod plots;
pub(crate) mod report;
pub(crate) mod sealed;
pub mod slit;
mod spheres;
pub(crate) mod squeeze;
pub(crate) mod stefan;
pub(crate) mod tait;
pub(crate) mod taylor_green;
pub(crate) mod water;
mod water_front;
pub(crate) mod wicking;

use crate::Result;
use crate::job::{Job, run_all};
pub use crate::job::{Measured, Scene};
use crate::numbers::mean;
use crate::outputs::Run;
use crate::study::Study;
pub use catalogue::{methods, scenes};

/// The study, on the scenes so named; whether all runs ended.
pub fn run(study: &Study) -> Result<bool> {
    let mut entries = catalogue::all();
    entries.retain(|(scene, _)| study.wants(&scene.name));
    let mut jobs: Vec<Job> = Vec::new();
    for (scene, methods) in &entries {
        jobs.extend(methods.iter().map(|method| (scene, method.clone())));
    }
    let outcomes = run_all(&jobs, &study.folder());
    report::write(study, &outcomes)?;
    plots::write(study, &outcomes)?;
    Ok(outcomes.iter().all(|o| o.measured.is_ok()))
}

/// Width of the lumen of all scenes, m (paper section 2.3).
const LUMEN: f64 = 17.4e-6;

/// Speed of the upper wall towards the lower one, m/s, that raises the pressure to 1 MPa by the
/// time `until` (s), see [`crate::case_text::CaseText::released`].
fn pressing(until: f64) -> f64 {
    1e6 / crate::case_text::PF[1] * LUMEN / until
}

/// Mean velocity along x of the final state (m/s), against the mean of `exact` (m/s) at the height over
/// `low` (m) of each point: the mean over places alone is off by 1/(8 n^2).
fn mean_against(run: &Run, low: f64, exact: impl Fn(f64) -> f64) -> Result<Measured> {
    let points = run.points()?;
    let found = mean(points.iter().map(|p| p.velocity[0]));
    let right = mean((points.iter()).map(|p| exact((p.at[1] - low).clamp(0.0, LUMEN))));
    Ok(Measured::relative("mean velocity", found, right))
}

/// Mean velocity along x of the final state, m/s, of a flow that a body `force` (N/m3) drives: by the power that it gives
/// off where the scheme is implicit, for points sample a profile of n cells too coarsely by 1 to 8 % at six of them. An
/// explicit step gives off more than its stress does; there it is the mean over the points.
fn mean_velocity(run: &Run, force: f64) -> Result<f64> {
    if run.history("solver_iterations")?.iter().any(|&n| n > 0.0) {
        let [power, volume] = run.ends(["viscous_power_W", "adhesive_volume_m3"])?;
        return Ok(power / (force * volume));
    }
    Ok(mean(run.points()?.iter().map(|p| p.velocity[0])))
}

//! What an implicit run of a scene will take.

use physics::{Amount, Cure, Dimensions, Scene, Stages, Stop};

use crate::settings::Settings;
use crate::stages::stages;
use crate::step::length::CURED;
use crate::step::water::DRIED;

/// Speed of the liquid that sets the time step over that of the body that drives it, averaged
/// over a run: wood closing on a slab gives 1.5 at first and 6 towards the end.
const SPEED_RATIO: f64 = 4.0;
/// Krylov iterations of a step, solves for load control included.
const ITERATIONS: f64 = 13.0;
/// Seconds on one core per unknown and iteration, per unknown and step, and per material point
/// and step; measured at 0.2 million unknowns and 0.38 million points.
const SECONDS: [f64; 3] = [0.13e-6, 1.7e-6, 0.7e-6];
/// Bytes per unknown (matrices, Krylov basis, multigrid), per cell of the window (fractions,
/// faces, fields), and per material point.
const BYTES: [f64; 3] = [400.0, 200.0, 110.0];

/// Size and cost of a run; cheap, nothing is allocated.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Cells of the domain.
    pub cells: f64,
    /// Cells that the liquid fills.
    pub liquid_cells: f64,
    /// Velocity and pressure unknowns of a step.
    pub unknowns: f64,
    /// First time step, s.
    pub dt_s: f64,
    /// Steps to the end if the clamp keeps its full speed.
    pub steps: f64,
    /// Memory, bytes.
    pub memory_bytes: f64,
    /// Processor seconds: wall time is that over the number of cores.
    pub cpu_s: f64,
    /// What a step consists of.
    pub stages: Stages,
}

impl Plan {
    /// The plan for `scene` with `amount` of liquid.
    pub fn new(scene: &Scene, amount: &Amount, settings: &Settings) -> Self {
        let h = scene.grid.cell_m;
        let axes = match scene.dimensions {
            Dimensions::Two => 2.0,
            Dimensions::Three => 3.0,
        };
        let cells: f64 = scene.grid.cells.iter().map(|&n| n as f64).product();
        let liquid_cells = amount.volume_m3 / h.powi(3);
        // Surfaces add faces to the d per cell inside.
        let unknowns = liquid_cells * (1.0 + 1.1 * axes);
        let speed = scene.speed_with(amount);
        let dt_s = if speed > 0.0 {
            settings.cfl * h / speed
        } else {
            let pull = scene.gravity.iter().fold(0.0, |m: f64, g| m.max(g.abs()));
            (2.0 * settings.cfl * h / pull).sqrt()
        };
        let duration = match scene.stop {
            // A clamp cannot go further than through the whole domain, however long it is held.
            Stop::Time(time) if scene.clamp.is_some() => {
                time.min(scene.grid.cells[1] as f64 * h / speed)
            }
            Stop::Time(time) => time,
            Stop::Closed { travel_m } => travel_m / speed,
        };
        let cure = scene.liquid.cure.as_ref();
        let duration = cure
            .and_then(Cure::set_at)
            .map_or(duration, |set| set.min(duration));
        // A programme waits in its stages long after the clamp has gone its way, while the liquid sets.
        let waits: f64 = scene.programme.iter().map(|stage| stage.time_s).sum();
        let cured = cure.map_or(0.0, |cure| cure.change(duration.max(waits)) / CURED);
        let dried = (scene.liquid.water.as_ref())
            .map_or(0.0, |water| water.factor(water.least()).ln() / DRIED);
        let (dt_s, driven) = match drawn_in(scene, duration) {
            Some(cells) if !dt_s.is_finite() => (duration / cells, cells),
            _ => (dt_s, SPEED_RATIO * duration / dt_s),
        };
        let steps = (driven + cured + dried).ceil().max(1.0);
        let points = amount.points as f64;
        Self {
            cells,
            liquid_cells,
            unknowns,
            dt_s,
            steps,
            memory_bytes: BYTES[0] * unknowns
                + BYTES[1]
                    * settings
                        .air_pressure
                        .map_or(window(scene, amount), |_| cells)
                + BYTES[2] * points,
            cpu_s: steps
                * ((SECONDS[0] * ITERATIONS + SECONDS[1]) * unknowns + SECONDS[2] * points),
            stages: stages(scene),
        }
    }
}

/// Cells, one and more, that a slit of six of them draws in within `duration` (s), each of which takes a step.
fn drawn_in(scene: &Scene, duration: f64) -> Option<f64> {
    let [adhesion, _] = scene.liquid.wetting?.adhesion();
    let eta = scene.liquid.viscosity.at(0.0);
    let cells = (2.0 * adhesion * duration / (eta * scene.grid.cell_m)).sqrt();
    Some(cells.max(1.0))
}

/// Cells of the box around the liquid when it has spread as far as it is thick, at most all.
fn window(scene: &Scene, amount: &Amount) -> f64 {
    let cells = scene.grid.cells;
    let thick = (3.0 * (amount.high_m[1] - amount.low_m[1]) / scene.grid.cell_m)
        .min(cells[1] as f64)
        .max(1.0);
    cells[0] as f64 * cells[2] as f64 * thick
}

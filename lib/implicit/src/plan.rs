//! Steps, time and memory that a run of a scene will take.

use physics::{Amount, Cure, Dimensions, Scene, Stages, Stop};

use crate::settings::Settings;
use crate::step::LN_VISCOSITY_STEP;

/// Ratio of the liquid speed that sets the time step to the closing speed, averaged over a run: 1.6 to 1.8 where wood closes
/// on a slab.
const SPEED_RATIO: f64 = 1.8;
/// Processor seconds per unknown and step, as measured with 70 to 700 thousand unknowns.
const CPU_S_PER_UNKNOWN: f64 = 4e-6;
/// Bytes per unknown (matrices, Krylov basis, multigrid), per cell of the domain (pores, faces, friction of walls), per voxel
/// (codes, what measures the bond), and of the process. Within a fifth with 9 to 290 thousand unknowns; with 3 million, the
/// first steps take a quarter less.
const BYTES: [f64; 4] = [440.0, 20.0, 6.0, 10e6];

/// Size and cost of a run; cheap, nothing is allocated.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Cells that the liquid fills.
    pub liquid_cells: f64,
    /// Velocity and pressure unknowns of a step.
    pub unknowns: f64,
    /// First time step, s.
    pub dt_s: f64,
    /// Steps to the end at the clamp's full speed; a press programme takes far more.
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
        // A cell inside has one face an axis; surfaces add a tenth.
        let unknowns = liquid_cells * (1.0 + 1.1 * axes);
        let speed = scene.speed_with(amount);
        let dt_s = if speed > 0.0 {
            settings.cfl * h / speed
        } else {
            let gravity = scene.gravity.iter().fold(0.0, |m: f64, g| m.max(g.abs()));
            (2.0 * settings.cfl * h / gravity).sqrt()
        };
        let duration = match scene.stop {
            // A clamp travels no further than the height of the domain, however long it is held.
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
        let cured = cure.map_or(0.0, |cure| cure.change(duration) / LN_VISCOSITY_STEP);
        let dried = (scene.liquid.water.as_ref()).map_or(0.0, |water| {
            water.factor(water.least()).ln() / LN_VISCOSITY_STEP
        });
        let blocks = scene.bodies.iter().flat_map(|body| &body.blocks);
        let voxels: f64 = blocks
            .map(|block| block.dims().iter().map(|&n| n as f64).product::<f64>())
            .sum();
        let driven = SPEED_RATIO * duration / dt_s;
        let steps = (driven + cured + dried).ceil().max(1.0);
        Self {
            liquid_cells,
            unknowns,
            dt_s,
            steps,
            memory_bytes: BYTES[0] * unknowns + BYTES[1] * cells + BYTES[2] * voxels + BYTES[3],
            cpu_s: steps * CPU_S_PER_UNKNOWN * unknowns,
            stages: stages(scene),
        }
    }
}

/// The stages of a run of `scene`.
fn stages(scene: &Scene) -> Stages {
    let list = Stages::of(scene);
    let gains = scene.clamp.and_then(|clamp| clamp.pid);
    let no_pid = match (list.has(Stages::LOAD), gains) {
        (true, Some(_)) => None,
        (true, None) => Some("no pid: each step finds the speed that keeps the limit"),
        (false, _) => Some("no pressure limit"),
    };
    let shear = "computed only for written states, unless the viscosity depends on it";
    (list.and("PID", no_pid.map(str::to_owned))).and("shear rate", Some(shear.into()))
}

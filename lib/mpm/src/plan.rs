//! Cost of an explicit run of a scene: time step, its limits, steps, memory.

use std::fmt;

use physics::{Amount, Motion, Rheology, RigidBody, Scene, Stages, Stop, Viscosity};

use crate::real::BYTES;
use crate::settings::{Settings, VelocityUpdate};
use crate::stages::stages;

/// What sets the time step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Limit {
    /// cell / (c + |v|): a sound wave may not cross a cell in a step.
    Acoustic,
    /// rho cell^2 / (8 eta): momentum may not diffuse across a cell in a step.
    Viscous,
}

impl fmt::Display for Limit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Limit::Acoustic => "acoustic, cell/(c + |v|)",
            Limit::Viscous => "viscous (rho cell^2/(8 eta))",
        })
    }
}

/// What an explicit run of a scene will take; cheap, nothing is allocated.
#[derive(Clone, Debug, PartialEq)]
pub struct Plan {
    /// Time step at the start, s: cfl times the smaller limit.
    pub dt_s: f64,
    /// Which limit that is.
    pub limit: Limit,
    /// Acoustic limit, s.
    pub acoustic_s: f64,
    /// Viscous limit, s. For a viscosity table it is that of its smallest viscosity, for a law by formula
    /// that of its largest.
    pub viscous_s: f64,
    /// Largest viscosity the step carries, Pa s; larger ones of a table are capped and counted.
    pub viscosity_cap: f64,
    /// Steps to the end if the clamp keeps its full speed.
    pub steps: f64,
    /// Memory of points and nodes, and of the points while they are written, bytes.
    pub memory_bytes: f64,
    /// What a step consists of.
    pub stages: Stages,
}

impl Plan {
    /// The plan for `scene` with `amount` of liquid.
    pub fn new(scene: &Scene, amount: &Amount, settings: &Settings) -> Self {
        let (cell, density) = (scene.grid.cell_m, scene.liquid.density);
        let acoustic_s = acoustic_limit(scene, scene.speed_with(amount), 0.0);
        let carried = match &scene.liquid.viscosity {
            Viscosity::Newtonian(law) => law.0,
            Viscosity::Table(law) => law
                .breakpoints()
                .iter()
                .map(|&rate| law.viscosity(rate))
                .fold(f64::INFINITY, f64::min),
            // Nothing of a law by formula is capped.
            Viscosity::Law(law) => law.largest(),
        };
        let viscous_s = density * cell * cell / (8.0 * carried);
        let limit = if acoustic_s < viscous_s {
            Limit::Acoustic
        } else {
            Limit::Viscous
        };
        let dt_s = settings.cfl * acoustic_s.min(viscous_s);
        let duration = match scene.stop {
            Stop::Time(end) => end,
            Stop::Closed { travel_m } => scene
                .clamp
                .map_or(f64::INFINITY, |clamp| travel_m / clamp.closing_speed),
        };
        Self {
            dt_s,
            limit,
            acoustic_s,
            viscous_s,
            viscosity_cap: density * cell * cell / (8.0 * dt_s),
            steps: (duration / dt_s).ceil(),
            memory_bytes: memory(scene, amount, settings),
            stages: stages(scene, settings),
        }
    }
}

/// cell / (c + v) at the largest speed and the smallest j = J - 1 of the points; the sound
/// speed of a Tait liquid rises as it is compressed.
pub(crate) fn acoustic_limit(scene: &Scene, speed: f64, j: f64) -> f64 {
    let stiffness = scene.liquid.tait.stiffness(j.min(0.0));
    let sound = (stiffness / scene.liquid.density).sqrt();
    scene.grid.cell_m / (sound + speed)
}

/// Bytes of points, of their state while it is written, and of nodes: tiles and blocks as full as lumens leave
/// them late in a run, about half.
fn memory(scene: &Scene, amount: &Amount, settings: &Settings) -> f64 {
    let affine = settings.velocity_update == VelocityUpdate::Apic;
    let bodies = scene.bodies.len() as u64;
    let moves = |body: &&RigidBody| body.motion != Motion::Fixed;
    let moving = scene.bodies.iter().filter(moves).count() as u64;
    let filtered = u64::from(settings.velocity_update.order() > 1);
    // With the room that tiles leave for more, an eighth at most.
    let kept = 17.0 / 16.0 * (6 + BYTES * if affine { 28 } else { 16 }) as f64;
    let written = 36.0;
    let spans = 108 * 8;
    let lanes = 8 * (1 + u64::from(bodies > 0)) + 4 * filtered;
    let per_tile = 216 * (BYTES * lanes + 2) + spans;
    let of_bodies = 8 * BYTES * bodies + 24 * moving;
    let per_node = 1 + 8 * BYTES + of_bodies + (16 + 4 * BYTES) * filtered;
    let per_block = 64 * per_node + spans;
    let volume = amount.volume_m3 / scene.grid.cell_m.powi(3);
    let tiles = (volume / 64.0 * 2.0).ceil() + 1.0;
    amount.points as f64 * (kept + written) + tiles * (per_tile + 2 * per_block) as f64
}

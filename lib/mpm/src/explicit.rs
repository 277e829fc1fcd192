//! The explicit scheme on a scene: what it holds.

use physics::{Motion, PidControl, RigidBody, Scene};

use crate::collide::Obstacle;
use crate::density::Projection;
use crate::plan::Plan;
use crate::real::Real;
use crate::settings::{Mode, Settings};
use crate::stages::{Clock, Present};
use crate::stress::Stress;
use crate::topology::Grid;
use crate::transfer::{AnyFlow, Kernels};
use crate::walls::{BlockShape, Integrator};

/// The explicit scheme on a scene.
pub struct Explicit {
    /// The scene without its points, which live in `grid`.
    pub(crate) scene: Scene,
    pub(crate) settings: Settings,
    pub(crate) plan: Plan,
    /// The plan's stages, for the step to ask.
    pub(crate) present: Present,
    /// The velocity update as the nodes see it.
    pub(crate) mode: Mode,
    pub(crate) kernels: Kernels,
    pub(crate) flow: AnyFlow,
    pub(crate) stress: Stress,
    pub(crate) grid: Grid,
    pub(crate) integrator: Integrator,
    pub(crate) separation: Real,
    /// Voxel blocks of each body, in cells.
    pub(crate) parts: Vec<Vec<BlockShape>>,
    pub(crate) control: Option<PidControl>,
    pub(crate) projection: Option<Projection>,
    pub(crate) state: State,
    pub(crate) clock: Clock,
}

/// What changes from step to step besides points.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct State {
    pub(crate) step: u64,
    pub(crate) time_s: f64,
    pub(crate) travel_m: f64,
    /// Displacement of each body, m.
    pub(crate) displacement: Vec<[f64; 3]>,
    /// Largest stable step now, s, without the Courant number, because a run may continue from a saved
    /// state at another one.
    pub(crate) limit_s: f64,
    pub(crate) lost: u64,
    pub(crate) corrections: Corrections,
}

/// How often points had to be kept out of the bodies since the start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Corrections {
    /// Times a point was stopped at the face of a solid voxel.
    pub(crate) stopped: u64,
    /// Times it was left inside one, caught between two bodies.
    pub(crate) trapped: u64,
}

impl Explicit {
    /// Bodies that move from displacement `from` to `to`, m.
    pub(crate) fn obstacles<'a>(
        &'a self,
        from: &[[f64; 3]],
        to: &[[f64; 3]],
        velocities: &[[Real; 3]],
    ) -> Vec<Obstacle<'a>> {
        let cell = self.scene.grid.cell_m;
        let obstacle = |(b, parts): (usize, &'a Vec<BlockShape>)| Obstacle {
            parts,
            from: from[b].map(|x| x / cell),
            to: to[b].map(|x| x / cell),
            velocity: velocities[b],
        };
        self.parts.iter().enumerate().map(obstacle).collect()
    }

    /// Velocity of each body at closing speed `speed`, m/s.
    pub(crate) fn body_velocities(&self, speed: f64) -> Vec<[f64; 3]> {
        let velocity = |body: &RigidBody| match body.motion {
            Motion::Fixed => [0.0; 3],
            Motion::Constant(v) => v,
            Motion::Clamped => [0.0, -speed, 0.0],
        };
        self.scene.bodies.iter().map(velocity).collect()
    }
}

//! Drive of the body that closes the gap: at a speed, or held at a pressure limit.

use physics::{Motion, Scene};

use super::setup::Units;
use crate::system::Drive;

/// Relative excess over the pressure limit that is tolerated.
const TOLERANCE: f64 = 5e-3;

/// Speed of the clamp.
#[derive(Clone, Debug)]
pub(super) struct Control {
    /// Closing speed unless held, cells/s.
    full: f64,
    /// Force that is not to be exceeded, over the unit of viscosity.
    limit: Option<f64>,
    held: bool,
    /// Speed of the last step, cells/s.
    last: f64,
}

impl Control {
    pub(super) fn new(scene: &Scene, units: Units) -> Self {
        let speed = (scene.bodies.iter())
            .map(|body| match body.motion {
                Motion::Constant(v) => v[1].abs(),
                Motion::Clamped => scene.clamp.map_or(0.0, |clamp| clamp.closing_speed),
                Motion::Fixed => 0.0,
            })
            .fold(0.0, f64::max);
        let full = speed / units.cell_m;
        let pressure = scene.clamp.and_then(|clamp| clamp.max_pressure);
        Self {
            full,
            limit: pressure.map(|p| p * scene.grid.area_m2() / units.force()),
            held: false,
            last: full,
        }
    }

    /// Closing speed, cells/s.
    pub(super) fn speed(&self) -> f64 {
        self.last
    }

    /// The drive to try first.
    pub(super) fn drive(&self) -> Drive {
        match self.limit {
            Some(limit) if self.held => Drive::Force(limit, self.last),
            _ => Drive::Speed(self.full),
        }
    }

    /// The drive by the limit where a step at full speed takes more force.
    pub(super) fn exceeded(&mut self, force: f64, speed: f64) -> Option<Drive> {
        let limit = self.limit?;
        if self.held {
            return self.too_fast(speed);
        }
        (force > limit * (1.0 + TOLERANCE)).then(|| {
            self.held = true;
            Drive::Force(limit, speed * limit / force)
        })
    }

    /// The drive at full speed where the limit would take more than that, or at rest where it would open the gap.
    pub(super) fn too_fast(&mut self, speed: f64) -> Option<Drive> {
        if speed > self.full {
            self.held = false;
            return Some(Drive::Speed(self.full));
        }
        (speed < 0.0).then_some(Drive::Speed(0.0))
    }

    /// Takes in a step that is over.
    pub(super) fn observe(&mut self, _force: f64, _dt: f64) {}
}

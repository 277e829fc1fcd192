//! The flux out of a cell: which velocities carry it, and how much.

use super::Operator;
use super::terms::Velocity;

impl Operator<'_> {
    /// Calls `each(velocity, area)` for every velocity in the liquid flux out of pressure
    /// unknown `cell`, Phi = sum area x velocity, weighted by its liquid fraction.
    pub(super) fn flux(&self, cell: usize, mut each: impl FnMut(Velocity, f64)) {
        let index = self.dofs.cells[cell] as usize;
        let window = &self.lattice.window;
        let fraction = f64::from(self.volumes.fraction[index]);
        for axis in 0..window.domain.axes {
            for (sign, face) in [(-1.0, index), (1.0, index + window.stride(axis))] {
                let Some(velocity) = self.velocity(axis, face) else {
                    continue;
                };
                let aperture = self.lattice.aperture(axis, window.coordinates(face));
                let weight = sign * fraction;
                if let Velocity::Face(_) = velocity {
                    each(velocity, weight * aperture.open);
                }
                for (body, area) in aperture.bodies.into_iter().filter(|b| b.1 != 0.0) {
                    each(Velocity::of_body(body, axis), weight * area);
                }
            }
        }
    }
}

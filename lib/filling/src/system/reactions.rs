//! What follows from the solution of a system: forces on the bodies, power, and what the solver left.

use super::assembly::System;

/// What follows from the solution of a system.
pub(crate) struct Reactions {
    /// Forces of the liquid on the bodies, in units of eta_0 h.
    pub(crate) forces: Vec<[f64; 3]>,
    /// Power dissipated by viscosity and wall friction, in units of eta_0 h (m/s)^2.
    pub(crate) power: f64,
    /// Force on the liquid that neither bodies nor its inertia bear: residuals of the momentum rows, summed up; over the
    /// largest force on a body; or over what would stop the liquid within the step, its weight and what menisci pull with, or what
    /// moves liquid too slowly to count, where that is more.
    pub(crate) unbalanced: f64,
}

impl System {
    /// What follows from velocities `u` of the unknowns `faces`, as (axis, cell), and pressures `p`.
    pub(crate) fn reactions(&self, faces: &[(u8, u32)], u: &[f64], p: &[f64]) -> Reactions {
        let (mut forces, of_bodies) = self.couplings.forces(&self.bodies, u, p);
        let mut product = vec![0.0; u.len()];
        self.a.multiply(u, &mut product);
        let (mut of_liquid, mut stops) = (0.0, 0.0);
        let mut left = self.pushed(faces, p);
        for (face, (product, u)) in product.iter().zip(u).enumerate() {
            let inertia = self.mass[face] * u;
            of_liquid += u * (product - inertia);
            stops += inertia.abs();
            left[usize::from(faces[face].0)] += self.b[face] - product;
        }
        // Walls that menisci pull liquid along bear next to nothing of both, sides of the domain are no bodies, and walls of liquid
        // at rest bear nothing.
        let saddle = self.saddle();
        let crept: f64 = (0..u.len()).map(|face| saddle.slow_force(face)).sum();
        let least = self.driven.max(stops).max(crept);
        let borne = forces.iter().copied().map(length).fold(least, f64::max);
        for (force, pulled) in forces.iter_mut().zip(&self.pulled) {
            *force = std::array::from_fn(|a| force[a] + pulled[a]);
        }
        Reactions {
            power: of_liquid + of_bodies,
            unbalanced: match length(left) {
                0.0 => 0.0,
                left => left / borne,
            },
            forces,
        }
    }

    /// Force of the pressures `p` on the liquid of all faces.
    fn pushed(&self, faces: &[(u8, u32)], p: &[f64]) -> [f64; 3] {
        let mut p = p.to_vec();
        self.take_shift(&mut p);
        let mut sum = [0.0; 3];
        for (cell, p) in p.iter().enumerate() {
            let (columns, areas) = self.g.row(cell);
            for (&face, area) in columns.iter().zip(areas) {
                sum[usize::from(faces[face as usize].0)] += area * p;
            }
        }
        sum
    }
}

fn length(force: [f64; 3]) -> f64 {
    force.iter().map(|f| f * f).sum::<f64>().sqrt()
}

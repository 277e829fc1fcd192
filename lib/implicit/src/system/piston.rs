//! Friction of a piston's liquid (docs/methods.md section 3.5).

use super::assembly::Problem;
use crate::geometry::{MIRROR, OPEN};

/// Friction of the liquid at a piston on the walls beside it.
pub(super) struct PistonFriction {
    /// Codes of the bodies of the piston and of the walls.
    pub(super) piston: u8,
    pub(super) walls: u8,
    /// Force on the walls along y per closing speed, and the power per its square.
    pub(super) force: f64,
    pub(super) power: f64,
}

impl Problem<'_> {
    /// Visits the friction of the half pores at a piston, a wall normal to y that moves along the walls beside it. Liquid
    /// there moves with the piston.
    pub(super) fn piston_friction(&self, mut add: impl FnMut(PistonFriction)) {
        let (mesh, lattice) = (self.mesh, self.lattice);
        // Without walls in the gap none moves along another.
        if lattice.moving.is_none() || !lattice.gap_has_walls() {
            return;
        }
        for &face in &self.unknowns.faces {
            let face = face as usize;
            if mesh.faces[face].axis != 1 {
                continue;
            }
            let (pores, coupling) = (self.face_pores(face), self.couplings.of(face));
            let etas = self.viscosities.at_walls(face, pores);
            for half in 0..2 {
                let (pore, up) = (pores[half], half == 1);
                let piston = mesh.wall_code(pore, up);
                if mesh.faces_at(pore, 1, up).len() > 0 || piston == OPEN || piston == MIRROR {
                    continue;
                }
                let speed =
                    lattice.body_speed(usize::from(piston - 1)) - mesh.grid_velocity(lattice, face);
                let (friction, walls) = (coupling.friction[half], coupling.sliding[half][1]);
                let weight = self.fractions[pore] * etas[half];
                add(PistonFriction {
                    piston,
                    walls: coupling.body,
                    force: weight * (friction * speed - walls),
                    power: weight
                        * (speed * (friction * speed - 2.0 * walls) + coupling.resistance[half]),
                });
            }
        }
    }
}

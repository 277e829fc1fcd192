//! The equations of a step: momentum of faces, volume of pores, force on the body that closes the gap.

use rayon::prelude::*;
use saddle_point::{Csr, RowEntries, SolveError, VelocityBlock};

use super::couplings::WallCouplings;
use super::edges::Edges;
use super::fronts::Fronts;
use super::stretching::stretching;
use super::unknowns::Unknowns;
use super::viscosity::Viscosities;
use crate::air::Pocket;
use crate::geometry::{Lattice, Mesh, RowKind};

/// Friction over viscosity of liquid that touches nothing, so that it has a velocity: with a thousand times as much forces
/// differ by less than 0.1 %.
const FREE_FRICTION: f64 = 1e-7;

/// What multiplies the terms of a step.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Scales {
    /// Length of the step, s.
    pub(crate) dt: f64,
    /// Speed of flow that counts as none, cells/s.
    pub(crate) slow: f64,
    /// rho h^2/(eta dt).
    pub(crate) inertia: f64,
    /// rho h g/eta along each axis.
    pub(crate) gravity: [f64; 3],
    /// eta/K, the compression of a unit of pressure.
    pub(crate) compressibility: f64,
    /// Influence length of the walls, cells; infinite without friction.
    pub(crate) influence_length: f64,
}

/// What the equations are made of.
pub(crate) struct Problem<'a> {
    pub(crate) lattice: &'a Lattice,
    pub(crate) mesh: &'a Mesh,
    pub(crate) couplings: &'a WallCouplings,
    pub(crate) edges: &'a Edges,
    pub(crate) unknowns: &'a Unknowns,
    /// Volume fraction of each pore, at most 1.
    pub(crate) fractions: &'a [f64],
    /// Liquid in the low and the high half of each face, over the volume of that half.
    pub(crate) halves: &'a [[f64; 2]],
    /// Liquid that moves with each face.
    pub(crate) masses: &'a [f64],
    /// Liquid of the halves of each face, times their viscosity where edges have none of their own.
    pub(crate) stiffnesses: &'a [f64],
    pub(crate) viscosities: &'a Viscosities,
    /// Velocity of each face before the step, against the grid, cells/s, and the closing speed then.
    pub(crate) before: &'a [f64],
    pub(crate) speed_before: f64,
    /// Height of the gap at the end of the step, cells.
    pub(crate) end_height: f64,
    pub(crate) fronts: &'a Fronts,
    /// Pockets of air with a pressure.
    pub(crate) pockets: &'a [Pocket],
    pub(crate) scales: Scales,
}

impl Problem<'_> {
    /// Viscosity times fraction of a pore.
    pub(super) fn stiffness(&self, pore: usize) -> f64 {
        self.fractions[pore] * self.viscosities.pores[pore]
    }

    /// Liquid of the halves of two faces that meet at an edge, times its viscosity as the faces know it.
    fn edge_stiffness(&self, faces: [usize; 2]) -> f64 {
        0.25 * (self.stiffnesses[faces[0]] + self.stiffnesses[faces[1]])
    }

    /// The two pores of a face.
    pub(super) fn ends(&self, face: usize) -> [usize; 2] {
        self.mesh.faces[face].ends()
    }

    /// Whether a face has a velocity.
    fn moves(&self, face: usize) -> bool {
        self.unknowns.face(face).is_some()
    }

    /// Friction of the walls at a face, in its low and its high half.
    pub(crate) fn wall_weights(&self, face: usize) -> [f64; 2] {
        let parts = self.halves[face];
        let eta = self.viscosities.at_walls(face, self.ends(face));
        [parts[0] * eta[0], parts[1] * eta[1]]
    }

    /// The velocity block.
    pub(crate) fn velocity_block(&self) -> Result<VelocityBlock, SolveError> {
        let faces = &self.unknowns.faces;
        VelocityBlock::assemble(faces.len(), |row, entries| {
            self.momentum(faces[row] as usize, row, entries);
        })
    }

    fn momentum(&self, face: usize, row: usize, entries: &mut RowEntries) {
        let coupling = self.couplings.of(face);
        let weights = self.wall_weights(face);
        let friction = weights[0] * coupling.friction[0] + weights[1] * coupling.friction[1];
        let drag = self
            .fronts
            .contact_friction
            .get(face)
            .copied()
            .unwrap_or_default();
        let mut own = friction + drag + self.scales.inertia * self.masses[face] + FREE_FRICTION;
        let number = |face: usize| self.unknowns.face(face);
        for (pore, up) in self.ends(face).into_iter().zip([false, true]) {
            let stiffness = self.stiffness(pore);
            if stiffness == 0.0 {
                continue;
            }
            stretching(self.mesh, face, up, |term| {
                let weight = stiffness * term.weight;
                match term.other.map(number) {
                    None => own += weight,
                    Some(None) => {}
                    Some(Some(other)) => {
                        own += weight;
                        entries.add(other, -weight);
                    }
                }
            });
        }
        for (index, edge) in self.edges.of(face).iter().enumerate() {
            let Some(next) = number(edge.next as usize) else {
                continue;
            };
            let thick = (self.viscosities.edges)
                .get(self.edges.first(face) + index)
                .copied()
                .unwrap_or(1.0);
            let eta = thick * self.edge_stiffness([face, edge.next as usize]);
            let [shear, length] = edge.geometry(self.mesh, face);
            own += eta * shear;
            entries.add(next, -eta * shear);
            let across = edge.across.map(|face| face as usize);
            if let [Some(low), Some(high)] = across.map(number) {
                // Where a surface crosses the edge, the faces across share less or more liquid.
                let weight = eta.min(thick * self.edge_stiffness(across)) * length;
                entries.add(high, -weight);
                entries.add(low, weight);
            }
        }
        entries.add(row, own);
        self.add_dynamic_angle(face, entries);
    }

    /// Right-hand sides of the momenta, each of all faces with a velocity: known, per closing speed, and the part of what is known
    /// that stands (weight, menisci, gas); known force on the body that closes the gap, by the inertia and the weight of the
    /// liquid that it carries along; and what of those known and of those per closing speed only makes thick liquid go along
    /// with what moves.
    pub(crate) fn right_hand_sides(&self) -> [Vec<f64>; 6] {
        let sides: Vec<[f64; 6]> = (self.unknowns.faces.par_iter())
            .map(|&face| self.right_hand_side(face as usize))
            .collect();
        std::array::from_fn(|i| sides.iter().map(|side| side[i]).collect())
    }

    /// What pushes a face, as in [`Self::right_hand_sides`].
    fn right_hand_side(&self, face: usize) -> [f64; 6] {
        let f = self.mesh.faces[face];
        let axis = usize::from(f.axis);
        let mass = self.masses[face];
        let inertia = self.scales.inertia * mass;
        let standing = self.scales.gravity[axis] * mass + self.front_force(face);
        let known = inertia * self.before[face] + standing;
        let mut force = [known, 0.0, standing, 0.0, 0.0, 0.0];
        let coupling = self.couplings.of(face);
        let weights = self.wall_weights(face);
        let etas = self.viscosities.at_walls(face, f.ends());
        for ((weight, eta), [own, closing]) in weights.into_iter().zip(etas).zip(coupling.sliding) {
            force[0] += weight * own;
            force[1] += weight * closing;
            force[4] += clinging_share(eta) * weight * own;
            force[5] += clinging_share(eta) * weight * closing;
        }
        if axis == 1 && self.lattice.moving.is_some() {
            let grid = self.mesh.grid_velocity(self.lattice, face);
            force[0] += inertia * grid * self.speed_before;
            force[1] -= inertia * grid;
            force[3] = -grid * (force[0] - self.front_force(face));
            for (pore, up) in self.ends(face).into_iter().zip([false, true]) {
                let stiffness = self.stiffness(pore);
                stretching(self.mesh, face, up, |term| {
                    if term.other.is_none_or(|other| self.moves(other)) {
                        let squeezed = stiffness * term.weight * term.closing;
                        force[1] += squeezed;
                        force[5] += clinging_share(self.viscosities.pores[pore]) * squeezed;
                    }
                });
            }
        }
        force
    }

    /// Force per closing speed on the body that closes, by liquid that stays where it is in the grid.
    pub(crate) fn resistance(&self) -> f64 {
        let faces = self.unknowns.faces.iter();
        let pores = 0..self.mesh.pores.len();
        faces
            .map(|&face| self.face_resistance(face as usize))
            .sum::<f64>()
            + pores.map(|pore| self.squeeze_resistance(pore)).sum::<f64>()
    }

    fn face_resistance(&self, face: usize) -> f64 {
        let coupling = self.couplings.of(face);
        let weights = self.wall_weights(face);
        let walls = weights[0] * coupling.resistance[0] + weights[1] * coupling.resistance[1];
        if self.mesh.faces[face].axis != 1 {
            return walls;
        }
        let grid = self.mesh.grid_velocity(self.lattice, face);
        walls + self.scales.inertia * self.masses[face] * grid * grid
    }

    /// Resistance of a pore of the gap to being squeezed with its faces at rest.
    fn squeeze_resistance(&self, pore: usize) -> f64 {
        let stiffness = self.stiffness(pore);
        if stiffness == 0.0 || self.mesh.rows().kind(self.mesh.row_of(pore)) != RowKind::Gap {
            return 0.0;
        }
        let mut sum = 0.0;
        // From its high faces where it has no low ones.
        let up = self.mesh.faces_at(pore, 1, false).len() == 0;
        let faces = self.mesh.faces_at(pore, 1, up);
        for face in faces.filter(|&face| self.moves(face)) {
            stretching(self.mesh, face, !up, |term| {
                if term.other.is_none_or(|other| self.moves(other)) {
                    sum += term.weight * term.closing * term.closing;
                }
            });
        }
        stiffness * sum
    }

    /// What the power of the velocities `u` of the faces misses of viscous dissipation: less inertia, more walls that move
    /// along themselves.
    pub(crate) fn viscous_parts(&self, u: &[f64], speed: f64) -> f64 {
        let part = |(&face, u): (&u32, &f64)| {
            let face = face as usize;
            let coupling = self.couplings.of(face);
            let weights = self.wall_weights(face);
            let grid = match self.mesh.faces[face].axis {
                1 => self.mesh.grid_velocity(self.lattice, face) * speed,
                _ => 0.0,
            };
            let walls: f64 = (0..2)
                .filter(|&half| coupling.sliding[half][0] != 0.0)
                .map(|half| {
                    let own = coupling.sliding[half][0];
                    weights[half] * (own * own / coupling.friction[half] - 2.0 * own * u)
                })
                .sum();
            walls - self.scales.inertia * self.masses[face] * (u + grid).powi(2)
        };
        self.unknowns.faces.iter().zip(u).map(part).sum()
    }

    /// Outflow of each pore with a pressure by the velocities of its faces, and behind these of each pocket by its front.
    pub(crate) fn outflow(&self) -> Result<Csr<f64>, SolveError> {
        let (pores, faces) = (&self.unknowns.pores, &self.unknowns.faces);
        let rows = pores.len() + self.pockets.len();
        Csr::assemble(rows, faces.len(), |row, entries| match pores.get(row) {
            Some(&pore) => self.add_outflow(pore as usize, entries, |_| true),
            None => {
                for &pore in &self.pockets[row - pores.len()].pores {
                    self.add_outflow(pore as usize, entries, |beside| {
                        self.unknowns.has_pressure(beside)
                    });
                }
            }
        })
    }

    /// Volume that a pore loses per closing speed.
    pub(crate) fn closing_loss(&self, pore: usize) -> f64 {
        let mesh = self.mesh;
        match mesh.rows().kind(mesh.row_of(pore)) {
            RowKind::Gap => mesh.volume(pore) / mesh.rows().height,
            _ => 0.0,
        }
    }
}

/// Part of a force on liquid of this viscosity over its unit that only makes it go along: what is left is that of the unit.
fn clinging_share(viscosity: f64) -> f64 {
    1.0 - 1.0 / viscosity.max(1.0)
}

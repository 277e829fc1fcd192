//! Assembly of the equations of a step: momentum of faces, volume balance of pores, force on the moving body (docs/methods.md
//! section 3.4).

use rayon::prelude::*;
use saddle_point::{Csr, RowEntries, SolveError, VelocityBlock};

use super::coupling::WallCoupling;
use super::couplings::WallCouplings;
use super::edges::Edges;
use super::fronts::Fronts;
use super::halves::{halves, stiffnesses};
use super::stretching::stretching;
use super::unknowns::Unknowns;
use super::viscosity::Viscosities;
use crate::air::Pocket;
use crate::geometry::{Lattice, Mesh, RowKind};

/// Friction of every face, over viscosity, which keeps the velocity of detached liquid determined. A thousand times as much
/// changes forces by less than 0.1 %.
const FREE_FRICTION: f64 = 1e-7;

/// Coefficients of the equations of a step.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Coefficients {
    /// Length of the step, s.
    pub(crate) dt: f64,
    /// Flow speed that counts as rest, cells/s.
    pub(crate) slow: f64,
    /// rho h^2/(eta dt).
    pub(crate) inertia: f64,
    /// rho h g/eta along each axis.
    pub(crate) gravity: [f64; 3],
    /// eta/K, the relative change of volume by a unit of pressure.
    pub(crate) compressibility: f64,
    /// Influence length of the walls, cells; infinite without friction.
    pub(crate) influence_length: f64,
}

/// The inputs of the equations.
pub(crate) struct Problem<'a> {
    pub(crate) lattice: &'a Lattice,
    pub(crate) mesh: &'a Mesh,
    pub(crate) couplings: &'a WallCouplings,
    pub(crate) edges: &'a Edges,
    pub(crate) unknowns: &'a Unknowns,
    /// Volume fraction of each pore, at most 1.
    pub(crate) fractions: &'a [f64],
    /// Liquid volume that moves with each face.
    pub(crate) masses: &'a [f64],
    pub(crate) viscosities: &'a Viscosities,
    /// Velocity of each face before the step, relative to the grid, cells/s, and the closing speed then.
    pub(crate) before: &'a [f64],
    pub(crate) speed_before: f64,
    /// Height of the gap at the end of the step, cells.
    pub(crate) end_height: f64,
    pub(crate) fronts: &'a Fronts,
    /// Pockets of air with an unknown pressure.
    pub(crate) pockets: &'a [Pocket],
    pub(crate) coefficients: Coefficients,
}

impl Problem<'_> {
    /// Viscosity times liquid fraction of a pore.
    pub(super) fn stiffness(&self, pore: usize) -> f64 {
        self.fractions[pore] * self.viscosities.pores[pore]
    }

    /// The two pores of a face.
    pub(super) fn face_pores(&self, face: usize) -> [usize; 2] {
        self.mesh.faces[face].pores()
    }

    /// Whether the velocity of a face is an unknown.
    fn moves(&self, face: usize) -> bool {
        self.unknowns.face(face).is_some()
    }

    /// The wall coupling of a face and the weights of its low and its high half: liquid fraction times viscosity at the walls.
    pub(super) fn walls(&self, face: usize) -> (WallCoupling, [f64; 2]) {
        let coupling = self.couplings.of(face);
        if !coupling.walled {
            return (coupling, [0.0; 2]);
        }
        let parts = halves(self.mesh, self.fractions, &self.mesh.faces[face]);
        let eta = self.viscosities.at_walls(face, self.face_pores(face));
        (coupling, [parts[0] * eta[0], parts[1] * eta[1]])
    }

    /// The velocity block A.
    pub(crate) fn velocity_block(&self) -> Result<VelocityBlock, SolveError> {
        let faces = &self.unknowns.faces;
        let stiffnesses = stiffnesses(self.mesh, self.fractions, self.viscosities);
        VelocityBlock::assemble(faces.len(), |row, entries| {
            self.momentum(faces[row] as usize, row, &stiffnesses, entries);
        })
    }

    /// Row of the velocity block for a face: wall friction, contact lines, inertia, stretching and shear, by the
    /// [`stiffnesses`] of all faces.
    fn momentum(&self, face: usize, row: usize, stiffnesses: &[f64], entries: &mut RowEntries) {
        let (coupling, weights) = self.walls(face);
        let friction = weights[0] * coupling.friction[0] + weights[1] * coupling.friction[1];
        let drag = self
            .fronts
            .contact_friction
            .get(face)
            .copied()
            .unwrap_or_default();
        let mut own =
            friction + drag + self.coefficients.inertia * self.masses[face] + FREE_FRICTION;
        let number = |face: usize| self.unknowns.face(face);
        for (pore, up) in self.face_pores(face).into_iter().zip([false, true]) {
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
        // Mean over the four halves of two faces.
        let mean = |[one, other]: [usize; 2]| 0.25 * (stiffnesses[one] + stiffnesses[other]);
        for (index, edge) in self.edges.of(face).iter().enumerate() {
            let Some(next) = number(edge.next as usize) else {
                continue;
            };
            let thick = (self.viscosities.edges)
                .get(self.edges.first(face) + index)
                .copied()
                .unwrap_or(1.0);
            let eta = thick * mean([face, edge.next as usize]);
            let [shear, length] = edge.geometry(self.mesh, face);
            own += eta * shear;
            entries.add(next, -eta * shear);
            let across = edge.across(self.mesh, face);
            if let [Some(low), Some(high)] = across.map(number) {
                // Where a surface crosses the edge, the lesser liquid of the two pairs of faces counts.
                let weight = eta.min(thick * mean(across)) * length;
                entries.add(high, -weight);
                entries.add(low, weight);
            }
        }
        entries.add(row, own);
        self.add_dynamic_angle(face, entries);
    }

    /// Right-hand sides of the momentum equations, five for each face with a velocity:
    /// 0. known forces;
    /// 1. forces per closing speed;
    /// 2. static part of 0: weight, menisci, gas, and 4;
    /// 3. known force on the moving body, by inertia and weight of the liquid in the moving rows;
    /// 4. the part of 0, and of 1 at the closing `speed`, that only makes viscous liquid follow its walls ([`clinging_share`]).
    pub(crate) fn right_hand_sides(&self, speed: f64) -> [Vec<f64>; 5] {
        let sides: Vec<[f64; 5]> = (self.unknowns.faces.par_iter())
            .map(|&face| self.right_hand_side(face as usize, speed))
            .collect();
        std::array::from_fn(|i| sides.iter().map(|side| side[i]).collect())
    }

    /// Right-hand sides of one face, in the order of [`Self::right_hand_sides`].
    fn right_hand_side(&self, face: usize, speed: f64) -> [f64; 5] {
        let f = self.mesh.faces[face];
        let axis = usize::from(f.axis);
        let mass = self.masses[face];
        let inertia = self.coefficients.inertia * mass;
        let standing = self.coefficients.gravity[axis] * mass + self.front_force(face);
        let known = inertia * self.before[face] + standing;
        let mut force = [known, 0.0, standing, 0.0, 0.0];
        let (coupling, weights) = self.walls(face);
        let etas = self.viscosities.at_walls(face, f.pores());
        for ((weight, eta), [own, closing]) in weights.into_iter().zip(etas).zip(coupling.sliding) {
            force[0] += weight * own;
            force[1] += weight * closing;
            force[4] += clinging_share(eta) * weight * (own + speed * closing);
        }
        if axis == 1 && self.lattice.moving.is_some() {
            let grid = self.mesh.grid_velocity(self.lattice, face);
            force[0] += inertia * grid * self.speed_before;
            force[1] -= inertia * grid;
            force[3] = -grid * (force[0] - self.front_force(face));
            for (pore, up) in self.face_pores(face).into_iter().zip([false, true]) {
                let stiffness = self.stiffness(pore);
                stretching(self.mesh, face, up, |term| {
                    if term.other.is_none_or(|other| self.moves(other)) {
                        let squeezed = stiffness * term.weight * term.closing;
                        force[1] += squeezed;
                        force[4] += clinging_share(self.viscosities.pores[pore]) * speed * squeezed;
                    }
                });
            }
        }
        force[2] += force[4];
        force
    }

    /// Force per closing speed on the moving body, by liquid at rest relative to the grid.
    pub(crate) fn resistance(&self) -> f64 {
        let faces = self.unknowns.faces.iter();
        let pores = 0..self.mesh.pores.len();
        let mut pistons = 0.0;
        self.piston_friction(|friction| pistons += friction.power);
        faces
            .map(|&face| self.face_resistance(face as usize))
            .sum::<f64>()
            + pores.map(|pore| self.squeeze_resistance(pore)).sum::<f64>()
            + pistons
    }

    /// Force per closing speed by the walls and the inertia of one face at rest relative to the grid.
    fn face_resistance(&self, face: usize) -> f64 {
        let (coupling, weights) = self.walls(face);
        let walls = weights[0] * coupling.resistance[0] + weights[1] * coupling.resistance[1];
        if self.mesh.faces[face].axis != 1 {
            return walls;
        }
        let grid = self.mesh.grid_velocity(self.lattice, face);
        walls + self.coefficients.inertia * self.masses[face] * grid * grid
    }

    /// Force per closing speed by the stretching of a gap pore whose faces are at rest relative to the grid.
    fn squeeze_resistance(&self, pore: usize) -> f64 {
        let stiffness = self.stiffness(pore);
        if stiffness == 0.0 || self.mesh.rows().kind(self.mesh.row_of(pore)) != RowKind::Gap {
            return 0.0;
        }
        let mut sum = 0.0;
        // Terms of its low faces, or of its high ones if it has no low ones.
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

    /// Correction from the power u A u to viscous dissipation, for face velocities `u`: adds the power of sliding walls,
    /// subtracts that of inertia.
    pub(crate) fn viscous_parts(&self, u: &[f64], speed: f64) -> f64 {
        let part = |(&face, u): (&u32, &f64)| {
            let face = face as usize;
            let (coupling, weights) = self.walls(face);
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
            walls - self.coefficients.inertia * self.masses[face] * (u + grid).powi(2)
        };
        self.unknowns.faces.iter().zip(u).map(part).sum()
    }

    /// The divergence block G: outflow of each pore with a pressure per face velocity, then that of each pocket through its
    /// front.
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

    /// Volume that a pore loses per closing speed, V_c/g in the gap.
    pub(crate) fn closing_loss(&self, pore: usize) -> f64 {
        let mesh = self.mesh;
        match mesh.rows().kind(mesh.row_of(pore)) {
            RowKind::Gap => mesh.volume(pore) / mesh.rows().height,
            _ => 0.0,
        }
    }
}

/// Share of a viscous force that only makes liquid follow the walls: all but the force on liquid of unit viscosity. `viscosity`
/// is over the unit.
fn clinging_share(viscosity: f64) -> f64 {
    1.0 - 1.0 / viscosity.max(1.0)
}

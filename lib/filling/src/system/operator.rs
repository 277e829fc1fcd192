//! From geometry and liquid to the system of a step.

use rayon::prelude::*;
use saddle_point::{Csr, SolveError};

use super::couplings::{self, Couplings};
use super::dofs::Dofs;
use super::terms::Velocity;
use super::walls::Walls;
use super::{CHUNK, Scales, System};
use crate::geometry::Lattice;
use crate::liquid::Volumes;

/// Smallest liquid volume, in cells, that a face's mass counts with.
const LEAST_MASS: f64 = 0.02;

/// Geometry, liquid and unknowns of a step, from which its system is assembled.
pub(crate) struct Operator<'a> {
    /// Geometry.
    pub(crate) lattice: &'a Lattice,
    /// Liquid volumes.
    pub(crate) volumes: &'a Volumes<'a>,
    /// Viscosity of each cell over eta_0; empty when it is eta_0 everywhere.
    pub(super) viscosity: Vec<f32>,
    /// Unknowns.
    pub(crate) dofs: Dofs,
    /// Walls at the face unknowns.
    pub(crate) walls: Walls,
    /// Liquid volume of the control volume of each face unknown, in cells.
    pub(crate) face_volume: Vec<f64>,
    pub(super) scales: Scales,
}

/// What is known of the liquid before the step.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Before<'a> {
    /// Velocity of each face unknown carried by the particles, m/s.
    pub(crate) velocity: &'a [f64],
    /// Pressure of each pressure unknown carried by the particles, scaled.
    pub(crate) pressure: &'a [f64],
    /// Resistance of the liquid at that pressure to a change of its present volume, over K.
    pub(crate) stiffness: &'a [f64],
}

impl<'a> Operator<'a> {
    /// The operator for the liquid of `volumes` in `lattice`.
    pub(crate) fn new(lattice: &'a Lattice, volumes: &'a Volumes<'a>, scales: Scales) -> Self {
        let dofs = Dofs::new(lattice, volumes);
        let friction = scales.influence_length.is_finite();
        let walls = Walls::new(lattice, volumes.phi, &dofs, scales.width, friction);
        let face_volume = dofs
            .faces
            .par_iter()
            .with_min_len(CHUNK)
            .map(|&(axis, index)| face_volume(lattice, volumes, axis.into(), index as usize))
            .collect();
        Self {
            lattice,
            volumes,
            viscosity: Vec::new(),
            dofs,
            walls,
            face_volume,
            scales,
        }
    }

    #[inline]
    pub(super) fn eta(&self, cell: usize) -> f64 {
        self.viscosity.get(cell).map_or(1.0, |&eta| f64::from(eta))
    }

    fn face_viscosity(&self, axis: usize, index: usize) -> f64 {
        let below = index - self.lattice.window.stride(axis);
        self.mean_viscosity([index, below])
    }

    pub(super) fn edge_viscosity(&self, cells: [usize; 4]) -> f64 {
        self.mean_viscosity(cells)
    }

    /// Viscosity around a place, by the liquid in the cells that meet there.
    fn mean_viscosity<const N: usize>(&self, cells: [usize; N]) -> f64 {
        if self.viscosity.is_empty() {
            return 1.0;
        }
        let (mut sum, mut volume) = (0.0, 0.0);
        for cell in cells {
            let v = f64::from(self.volumes.cell[cell]);
            sum += v * self.eta(cell);
            volume += v;
        }
        if volume > 0.0 { sum / volume } else { 1.0 }
    }

    /// Assembles the system for bodies that move at `bodies` (m/s).
    ///
    /// # Errors
    /// When an entry is not finite.
    pub(crate) fn assemble(
        &self,
        bodies: &[[f64; 3]],
        before: Before,
    ) -> Result<System, SolveError> {
        let n = self.dofs.faces.len();
        let a = Csr::assemble(n, n, |face, entries| {
            entries.add(face, self.mass(face));
            self.terms(face, |term| {
                let own = term.coefficient(face);
                for &(velocity, c) in term.parts() {
                    if let Velocity::Face(other) = velocity {
                        entries.add(other as usize, term.weight * own * c);
                    }
                }
            });
        })?;
        let flux = couplings::fluxes(self);
        let g = Csr::assemble(self.dofs.cells.len(), n, |cell, entries| {
            for &(column, area) in flux.of(cell).iter().filter(|e| (e.0 as usize) < n) {
                entries.add(column as usize, area);
            }
        })?;
        let c = self.compressibility(before.stiffness);
        let mut system = System {
            friction: (0..n).map(|face| self.darcy(face)).collect(),
            two_eta: (self.dofs.cells.iter())
                .map(|&cell| 2.0 * self.eta(cell as usize))
                .collect(),
            mass: (0..n).map(|face| self.mass(face)).collect(),
            couplings: Couplings::new(self, bodies.len(), &flux),
            resting: [
                self.momentum(before.velocity),
                (c.iter().zip(before.pressure))
                    .map(|(c, p)| c * p)
                    .collect(),
            ],
            a,
            g,
            c,
            bodies: Vec::new(),
            b: Vec::new(),
            source: Vec::new(),
        };
        system.steer(bodies);
        Ok(system)
    }

    fn mass(&self, face: usize) -> f64 {
        self.scales.inertia * self.face_volume[face].max(LEAST_MASS)
    }

    /// D_B of the pressure preconditioner: V_f [rho h^2/(eta_0 dt) + 12 eta sum H^-2], with less
    /// friction where walls slip: slip by a length l multiplies the flux of a slit by 1 + 6 l/H.
    fn darcy(&self, face: usize) -> f64 {
        let (axis, index) = self.dofs.faces[face];
        let eta = self.face_viscosity(axis.into(), index as usize);
        let widths = match f64::from(self.walls.inverse_widths[face]) {
            0.0 => 0.0,
            widths => widths / (1.0 + 6.0 * self.scales.influence_length * widths.sqrt()),
        };
        self.face_volume[face].max(LEAST_MASS) * (self.scales.inertia + 12.0 * eta * widths)
    }

    fn compressibility(&self, stiffness: &[f64]) -> Vec<f64> {
        (self.dofs.cells.iter().zip(stiffness))
            .map(|(&cell, stiffness)| {
                self.scales.compressibility * f64::from(self.volumes.cell[cell as usize])
                    / stiffness
            })
            .collect()
    }

    /// b with all bodies at rest: inertia and body force.
    fn momentum(&self, velocity: &[f64]) -> Vec<f64> {
        (self.dofs.faces.iter().enumerate())
            .map(|(face, &(axis, _))| {
                self.mass(face) * velocity[face]
                    + self.face_volume[face] * self.scales.gravity[usize::from(axis)]
            })
            .collect()
    }
}

/// Liquid volume that moves with a face: of its control volume, and of the slivers merged
/// into its area.
fn face_volume(lattice: &Lattice, volumes: &Volumes, axis: usize, index: usize) -> f64 {
    let cell = lattice.window.coordinates(index);
    let (wet, open) = volumes.of_face(lattice, axis, cell);
    let merged = lattice.aperture(axis, cell).merged;
    wet + if open > 0.0 { merged * wet / open } else { 0.0 }
}

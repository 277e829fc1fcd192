//! The assembled system of a step.

use rayon::prelude::*;
use saddle_point::{Csr, Load, SaddleSystem, SolveError, VelocityBlock};

use super::Operator;
use super::air::Tangent;
use super::couplings::{self, Couplings};
use super::edges::Edges;
use super::fluxes::Areas;
use super::lines::Friction;
use super::terms::Velocity;

/// Smallest liquid volume, in cells, that a face's mass counts with.
const LEAST_MASS: f64 = 0.02;

/// The assembled system of a step, for bodies at given speeds.
pub(crate) struct System {
    pub(super) a: VelocityBlock,
    /// Liquid fluxes, cells x faces.
    pub(crate) g: Csr<f64>,
    c: Vec<f64>,
    friction: Vec<f64>,
    two_eta: Vec<f64>,
    pub(super) mass: Vec<f64>,
    /// Liquid volume that moves with each face unknown, cells.
    pub(crate) face_volume: Vec<f64>,
    pub(super) couplings: Couplings,
    /// Forces of menisci on the bodies.
    pub(super) pulled: Vec<[f64; 3]>,
    /// Pressures of the pockets of air, which their unknowns count from: what softens them much would outweigh
    /// all else.
    shift: Vec<f64>,
    /// Momentum by these, by weight, by menisci, and by walls that move with lines that they hold or with thick liquid that clings to
    /// them; empty without any.
    standing: Vec<f64>,
    /// All that menisci pull with and weight.
    pub(super) driven: f64,
    /// Part of what walls drag each face by that only makes thick liquid go along; empty where none is thick.
    clinging: Vec<f64>,
    /// Friction of those lines.
    held: Vec<Friction>,
    /// Friction of both on each face; empty without any.
    holding: Vec<f64>,
    /// Slowest velocity that counts at the front, m/s.
    slow: f64,
    /// Momentum with all bodies at rest.
    momentum: Vec<f64>,
    /// Volume that compression carries over from the step before.
    carried: Vec<f64>,
    /// Volume source with all bodies at rest: what pockets of air grow by, less what is lost into walls; empty
    /// without either.
    resting: Vec<f64>,
    pub(super) bodies: Vec<[f64; 3]>,
    pub(super) b: Vec<f64>,
    source: Vec<f64>,
}

impl System {
    /// What the solver takes.
    pub(crate) fn saddle(&self) -> SaddleSystem<'_> {
        SaddleSystem {
            a: &self.a,
            g: &self.g,
            pockets: self.shift.len(),
            c: &self.c,
            friction: &self.friction,
            two_eta: &self.two_eta,
            b: &self.b,
            standing: &self.standing,
            holding: &self.holding,
            slow: self.slow,
            volume_source: &self.source,
            carried: &self.carried,
        }
    }

    /// Makes pressures of pockets those that the solver finds, over what they count from.
    pub(crate) fn take_shift(&self, p: &mut [f64]) {
        let pockets = self.c.len() - self.shift.len();
        for (p, shift) in p[pockets..].iter_mut().zip(&self.shift) {
            *p -= shift;
        }
    }

    /// And back.
    pub(crate) fn add_shift(&self, p: &mut [f64]) {
        let pockets = self.c.len() - self.shift.len();
        for (p, shift) in p[pockets..].iter_mut().zip(&self.shift) {
            *p += shift;
        }
    }

    /// Area of the front at pockets of air, cells: of the rows behind those of `liquid` cells.
    pub(crate) fn front(&self, liquid: usize) -> f64 {
        let area = |row: usize| self.g.row(row).1.iter().map(|area| area.abs()).sum::<f64>();
        (liquid..self.g.n_rows()).map(area).sum()
    }

    /// What these pockets grow by, cells^2 m/s, at velocities of the face unknowns and the bodies, m/s.
    pub(crate) fn growth(&self, liquid: usize, u: &[f64], bodies: &[[f64; 3]]) -> Vec<f64> {
        (liquid..self.g.n_rows())
            .map(|row| self.g.row_times_wide(row, u) - self.couplings.displaced(row, bodies))
            .collect()
    }

    /// Sets the velocities of the bodies, m/s.
    pub(crate) fn steer(&mut self, bodies: &[[f64; 3]]) {
        for line in &self.held {
            let velocity = |bodies: &[[f64; 3]]| bodies[line.wall / 3][line.wall % 3];
            self.standing[line.face] += line.friction * (velocity(bodies) - velocity(&self.bodies));
        }
        let couplings = &self.couplings;
        for (face, part) in self.clinging.iter().enumerate() {
            let more = couplings.dragged(face, bodies) - couplings.dragged(face, &self.bodies);
            self.standing[face] += part * more;
        }
        self.bodies = bodies.to_vec();
        self.b = (self.momentum.par_iter().enumerate())
            .map(|(face, b)| b + couplings.dragged(face, bodies))
            .collect();
        self.source = (0..self.carried.len())
            .into_par_iter()
            .map(|cell| {
                let resting = self.resting.get(cell).copied().unwrap_or_default();
                couplings.displaced(cell, bodies) + resting
            })
            .collect();
    }

    /// How the speed of body `clamped` against y enters the system, for a force of `force` on it
    /// along y (units of eta_0 h); to be solved with that body at rest.
    pub(crate) fn load(&self, clamped: usize, force: f64, least: f64) -> Load {
        let mut unit = vec![[0.0; 3]; self.bodies.len()];
        unit[clamped][1] = -1.0;
        let mut resting = self.bodies.clone();
        resting[clamped] = [0.0; 3];
        let couplings = &self.couplings;
        let rigid = |bodies: &[[f64; 3]], p: &[f64]| couplings.forces(bodies, &[], p).0[clamped][1];
        let force = force - rigid(&resting, &[]);
        let pulled = self.pulled.get(clamped).map_or(0.0, |pull| pull[1]);
        let borne = match self.shift.is_empty() {
            true => pulled,
            false => {
                let still = vec![[0.0; 3]; self.bodies.len()];
                let mut pockets = vec![0.0; self.c.len()];
                self.add_shift(&mut pockets);
                rigid(&still, &pockets) + pulled
            }
        };
        Load {
            momentum: (0..self.b.len())
                .into_par_iter()
                .map(|face| couplings.dragged(face, &unit))
                .collect(),
            source: (0..self.source.len())
                .into_par_iter()
                .map(|cell| couplings.displaced(cell, &unit))
                .collect(),
            resistance: rigid(&unit, &[]),
            force: force - borne,
            scale: force.max(least),
        }
    }
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
    /// Volume that each pressure unknown, pockets of air behind the cells, loses in a time, cells^2 m/s; empty where none is lost.
    pub(crate) lost: &'a [f64],
    /// Of each pocket of air; none where they have no pressures.
    pub(crate) air: &'a [Tangent],
}

impl Operator<'_> {
    /// Assembles the system for bodies that move at `bodies` (m/s).
    ///
    /// # Errors
    /// When an entry is not finite.
    // Not inlined: make leave-out counts what it takes by its name.
    #[inline(never)]
    pub(crate) fn assemble(
        &self,
        bodies: &[[f64; 3]],
        before: Before,
    ) -> Result<System, SolveError> {
        let n = self.dofs.faces.len();
        let areas = Areas::new(self);
        let face_volume = self.face_volumes(&areas);
        let mass: Vec<f64> = face_volume.iter().map(|&v| self.mass(v)).collect();
        let edges = Edges::new(self);
        // Takes the most memory while its rows are joined, so nothing else is made before.
        let a = self.velocity_block(&edges, &mass)?;
        let flux = couplings::fluxes(self, &areas);
        drop(areas);
        let g = Csr::assemble(flux.len(), n, |cell, entries| {
            for &(column, area) in flux.of(cell).iter().filter(|e| (e.0 as usize) < n) {
                entries.add(column as usize, area);
            }
        })?;
        let cells = self.dofs.cells.len();
        let mut c = self.compressibility(before.stiffness);
        let mut carried: Vec<f64> = (c.iter().zip(before.pressure))
            .map(|(c, p)| c * p)
            .collect();
        let mut two_eta: Vec<f64> = (self.dofs.cells.iter())
            .map(|&cell| 2.0 * self.eta(cell as usize))
            .collect();
        let couplings = Couplings::new(self, &edges, bodies.len(), &flux);
        let mut resting: Vec<f64> = before.lost.iter().map(|lost| -lost).collect();
        let thickest = two_eta.iter().copied().fold(0.0, f64::max);
        if !before.air.is_empty() {
            resting.resize(cells + before.air.len(), 0.0);
        }
        for (resting, tangent) in resting.iter_mut().skip(cells).zip(before.air) {
            *resting += tangent.growth;
            c.push(tangent.softness);
            two_eta.push(thickest);
        }
        carried.resize(c.len(), 0.0);
        let (clinging, held) = (self.clinging(), self.held_lines());
        let holding = self.holding(&clinging, &held, &couplings, bodies.len());
        let (mut standing, pulled) = self.pull.forces();
        let inertia = mass.iter().zip(before.velocity);
        let mut momentum: Vec<f64> = inertia.map(|(mass, velocity)| mass * velocity).collect();
        let pulls: f64 = standing.iter().map(|force| force.abs()).sum();
        let driven = pulls + self.add_weight(&face_volume, &mut standing);
        let shift: Vec<f64> = before.air.iter().map(|t| t.pressure).collect();
        if !(shift.is_empty() && clinging.is_empty()) {
            standing.resize(n, 0.0);
        }
        for (row, shift) in (cells..).zip(&shift) {
            let (faces, areas) = g.row(row);
            for (&face, area) in faces.iter().zip(areas) {
                standing[face as usize] += area * shift;
            }
        }
        for (momentum, standing) in momentum.iter_mut().zip(&standing) {
            *momentum += standing;
        }
        let mut system = System {
            friction: (face_volume.iter().enumerate())
                .map(|(face, &volume)| self.darcy(face, volume) + self.line_friction(face))
                .collect(),
            two_eta,
            couplings,
            pulled,
            shift,
            driven,
            standing,
            clinging,
            held,
            holding,
            slow: self.scales.slow,
            momentum,
            carried,
            resting,
            a,
            mass,
            face_volume,
            g,
            c,
            bodies: vec![[0.0; 3]; bodies.len()],
            b: Vec::new(),
            source: Vec::new(),
        };
        system.steer(bodies);
        Ok(system)
    }

    /// A: mass, viscosity and wall friction.
    fn velocity_block(&self, edges: &Edges, mass: &[f64]) -> Result<VelocityBlock, SolveError> {
        VelocityBlock::assemble(mass.len(), |face, entries| {
            entries.add(face, mass[face]);
            self.terms::<false>(edges, face, |term| {
                let own = term.coefficient(face);
                for &(velocity, c) in term.parts() {
                    if let Velocity::Face(other) = velocity {
                        entries.add(other as usize, term.weight * own * c);
                    }
                }
            });
        })
    }

    fn mass(&self, volume: f64) -> f64 {
        self.scales.inertia * volume.max(LEAST_MASS)
    }

    /// D_B of the pressure preconditioner: V_f [rho h^2/(eta_0 dt) + 12 eta sum H^-2], with less
    /// friction where walls slip: slip by a length l multiplies the flux of a slit by 1 + 6 l/H.
    fn darcy(&self, face: usize, volume: f64) -> f64 {
        let (axis, index) = self.dofs.faces[face];
        let (axis, index) = (usize::from(axis), index as usize);
        let cells = [index, index - self.lattice.window.stride(axis)];
        let eta = self.mean_law(cells) * self.mean_factor(cells);
        let widths = match f64::from(self.walls.inverse_widths[face]) {
            0.0 => 0.0,
            widths => widths / (1.0 + 6.0 * self.scales.influence_length * widths.sqrt()),
        };
        volume.max(LEAST_MASS) * (self.scales.inertia + 12.0 * eta * widths)
    }

    fn compressibility(&self, stiffness: &[f64]) -> Vec<f64> {
        (self.dofs.cells.iter().zip(stiffness))
            .map(|(&cell, stiffness)| {
                self.scales.compressibility * f64::from(self.volumes.cell[cell as usize])
                    / stiffness
            })
            .collect()
    }
}

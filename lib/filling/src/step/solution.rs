//! Stages 4 to 6: what the particles carry to the unknowns, and passes over the viscosity.

use physics::Failure;

use super::{Implicit, Stage, Trial};
use crate::liquid::{self, Volumes};
use crate::system::{self, Before, Dofs, NONE, Operator, Sheared};
use crate::transport::density::Cells;
use crate::transport::{self, Flow};
use saddle_point::Csr;

/// Largest number of passes over a viscosity that depends on the shear rate: usually, and in the first
/// step, which has no rates to start from.
const PASSES: [usize; 2] = [3, 8];
/// Mean relative change of the viscosity below which no further pass is made.
const SETTLED: f64 = 0.02;

/// The flow of a step.
pub(super) struct Solution {
    pub(super) dofs: Dofs,
    /// Velocity of each face unknown, m/s.
    pub(super) u: Vec<f64>,
    /// Pressure of each cell of the window, Pa.
    pub(super) pressure: Vec<f32>,
    /// Velocities of the bodies, m/s.
    pub(super) bodies: Vec<[f64; 3]>,
    /// Speed of the clamp, m/s.
    pub(super) speed: f64,
    /// Forces on the bodies, in the solver's unit.
    pub(super) forces: Vec<[f64; 3]>,
    /// Dissipated power, W.
    pub(super) power: f64,
    pub(super) iterations: u32,
    /// For the density projection: fluxes, liquid volumes of the faces, and the liquid in the
    /// pressure unknowns.
    pub(super) g: Csr<f64>,
    pub(super) face_volume: Vec<f64>,
    pub(super) cells: Cells,
}

/// Unknowns of a solve, scaled: start values and result.
pub(super) struct Unknowns {
    pub(super) u: Vec<f64>,
    pub(super) p: Vec<f64>,
    pub(super) iterations: u32,
}

impl Implicit {
    /// Stages 4 to 6: assembles, solves and finds the forces, with viscosity passes and load control.
    pub(super) fn solve(&mut self, trial: &Trial) -> Result<Solution, Failure> {
        let phi = std::mem::take(&mut self.workspace.fractions.liquid);
        let result = self.solve_with(trial, &phi);
        self.workspace.fractions.liquid = phi;
        result
    }

    fn solve_with(&mut self, trial: &Trial, phi: &[f32]) -> Result<Solution, Failure> {
        let lattice = &trial.lattice;
        let scales = self.setup.scales(trial.dt);
        let volumes = Volumes::new(lattice, phi);
        let mut operator = self
            .workspace
            .stages
            .time(Stage::Assembly, || Operator::new(lattice, &volumes, scales));
        let start = self.carried(&operator);
        let mut now = Unknowns {
            u: start.u.clone(),
            p: start.p.clone(),
            iterations: 0,
        };
        let stiffness = self.stiffness(&start.p);
        let before = Before {
            velocity: &start.u,
            pressure: &start.p,
            stiffness: &stiffness,
        };
        let varies = system::varies(&self.setup.liquid.viscosity);
        if varies {
            self.update_viscosity(&mut operator, &now.u);
        }
        let mut pass = 0;
        let (system, forces, power) = loop {
            let solved = self.controlled(&operator, before, &mut now)?;
            pass += 1;
            let most = PASSES[usize::from(self.state.steps == 0)];
            if !varies || pass == most || self.update_viscosity(&mut operator, &now.u) < SETTLED {
                break solved;
            }
        };
        let pick = |field: &[f32]| {
            (operator.dofs.cells.iter())
                .map(|&c| field[c as usize])
                .collect()
        };
        let cells = Cells {
            density: pick(&self.workspace.fractions.density),
            fraction: pick(&volumes.fraction),
            volume: pick(&volumes.cell),
        };
        Ok(Solution {
            pressure: self.spread(&operator, &now.p),
            bodies: self.state.drive.velocities(),
            speed: self.state.drive.speed,
            forces,
            power: power * self.setup.units.force(),
            iterations: now.iterations,
            u: now.u,
            g: system.g,
            cells,
            face_volume: operator.face_volume,
            dofs: operator.dofs,
        })
    }

    /// Velocities and scaled pressures that the particles carry to the unknowns.
    fn carried(&mut self, operator: &Operator) -> Unknowns {
        let window = &operator.lattice.window;
        let (dofs, units) = (&operator.dofs, self.setup.units);
        let (particles, bins) = (&self.state.particles, &self.workspace.bins);
        self.workspace.stages.time(Stage::Fractions, || {
            let mut u = vec![0.0; dofs.faces.len()];
            let mut field = Vec::new();
            for axis in 0..window.domain.axes {
                liquid::velocities(particles, bins, window, axis, &mut field);
                for (u, face) in u.iter_mut().zip(&dofs.faces) {
                    if usize::from(face.0) == axis {
                        *u = f64::from(field[face.1 as usize]);
                    }
                }
            }
            liquid::pressures(particles, bins, window, self.setup.liquid.tait, &mut field);
            let p = (dofs.cells.iter())
                .map(|&cell| f64::from(field[cell as usize]) / units.pressure())
                .collect();
            Unknowns {
                u,
                p,
                iterations: 0,
            }
        })
    }

    /// -dp/d(ln J)/K at scaled pressures: the slope of Tait's law against the present volume.
    fn stiffness(&self, pressure: &[f64]) -> Vec<f64> {
        let (tait, unit) = (self.setup.liquid.tait, self.setup.units.pressure());
        (pressure.iter())
            .map(|p| {
                let j = tait.volume_change(p * unit);
                (1.0 + j) * tait.stiffness(j) / tait.bulk_modulus
            })
            .collect()
    }

    /// Viscosities at the rates of the velocities `u`; how much they changed.
    fn update_viscosity(&mut self, operator: &mut Operator, u: &[f64]) -> f64 {
        let bodies = self.state.drive.velocities();
        let influence = self.setup.influence_length();
        let (lattice, liquid, units) = (operator.lattice, &self.setup.liquid, self.setup.units);
        self.workspace.stages.time(Stage::Assembly, || {
            let value = transport::extend(lattice, &operator.dofs.face, u);
            let flow = Flow::new(lattice, &value, &operator.dofs.face, &bodies, influence);
            let field = Sheared {
                deviator: |x| flow.deviator_norm(x),
                u,
                bodies: &bodies,
            };
            operator.set_viscosity(liquid, units.eta, units.h, &field)
        })
    }

    /// Pressures (Pa) on the window; 0 in air, images beyond periodic sides included.
    fn spread(&self, operator: &Operator, p: &[f64]) -> Vec<f32> {
        let window = &operator.lattice.window;
        (0..window.len())
            .map(|index| {
                let home = window.index(window.home(window.coordinates(index)));
                match operator.dofs.cell[home] {
                    NONE => 0.0,
                    cell => (p[cell as usize] * self.setup.units.pressure()) as f32,
                }
            })
            .collect()
    }
}

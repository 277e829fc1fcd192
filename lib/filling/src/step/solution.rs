//! The coupled solve of a step under the clamp's control.

use physics::Failure;

use super::{Implicit, Stage, Trial};
use crate::liquid::{self, Volumes};
use crate::system::{self, Before, Dofs, NONE, Operator, Sheared, System};
use crate::transport::{self, Flow};
use saddle_point::{Csr, NEARLY, SaddleReport, SolveError};

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
    /// For the density projection: fluxes, volumes of the faces, and of the pressure unknowns
    /// density, liquid fraction and liquid volume.
    pub(super) g: Csr<f64>,
    pub(super) face_volume: Vec<f64>,
    pub(super) density: Vec<f32>,
    pub(super) fraction: Vec<f32>,
    pub(super) volume: Vec<f32>,
}

/// Unknowns of a solve: start values and result.
struct Unknowns {
    u: Vec<f64>,
    p: Vec<f64>,
    iterations: u32,
}

impl Implicit {
    /// Steps 4 to 6: assembles and solves, with viscosity passes and load control.
    pub(super) fn solution(&mut self, trial: &Trial) -> Result<Solution, Failure> {
        let phi = std::mem::take(&mut self.fractions.liquid);
        let result = self.solve_with(trial, &phi);
        self.fractions.liquid = phi;
        result
    }

    fn solve_with(&mut self, trial: &Trial, phi: &[f32]) -> Result<Solution, Failure> {
        let lattice = &trial.lattice;
        let scales = self.scales(trial.dt);
        let volumes = Volumes::new(lattice, phi);
        let mut operator = self
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
        let varies = system::varies(&self.liquid.viscosity);
        if varies {
            self.update_viscosity(&mut operator, &now.u);
        }
        let mut pass = 0;
        let (system, forces, power) = loop {
            let solved = self.controlled(&operator, before, &mut now)?;
            pass += 1;
            let most = PASSES[usize::from(self.steps == 0)];
            if !varies || pass == most || self.update_viscosity(&mut operator, &now.u) < SETTLED {
                break solved;
            }
        };
        let pick = |field: &[f32]| {
            (operator.dofs.cells.iter())
                .map(|&c| field[c as usize])
                .collect()
        };
        let (density, fraction) = (pick(&self.fractions.density), pick(&volumes.fraction));
        let volume = pick(&volumes.cell);
        Ok(Solution {
            pressure: self.spread(&operator, &now.p),
            bodies: self.drive.velocities(),
            speed: self.drive.speed,
            forces,
            power: power * self.units.force(),
            iterations: now.iterations,
            u: now.u,
            g: system.g,
            density,
            fraction,
            volume,
            face_volume: operator.face_volume,
            dofs: operator.dofs,
        })
    }

    /// Velocities and scaled pressures that the particles carry to the unknowns.
    fn carried(&mut self, operator: &Operator) -> Unknowns {
        let window = &operator.lattice.window;
        let (dofs, units) = (&operator.dofs, self.units);
        let (particles, bins) = (&self.particles, &self.bins);
        self.stages.time(Stage::Fractions, || {
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
            liquid::pressures(particles, bins, window, self.liquid.tait, &mut field);
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
        let (tait, unit) = (self.liquid.tait, self.units.pressure());
        (pressure.iter())
            .map(|p| {
                let j = tait.volume_change(p * unit);
                (1.0 + j) * tait.stiffness(j) / tait.bulk_modulus
            })
            .collect()
    }

    /// Solves at the clamp's speed or, where it is held at its pressure limit, for that speed.
    fn controlled(
        &mut self,
        operator: &Operator,
        before: Before,
        now: &mut Unknowns,
    ) -> Result<(System, Vec<[f64; 3]>, f64), Failure> {
        let bodies = self.drive.velocities();
        let mut system = (self.stages)
            .time(Stage::Assembly, || operator.assemble(&bodies, before))
            .map_err(|error| self.unsolved(error))?;
        let clamped = self.drive.clamped();
        let solved = match (clamped, self.drive.held()) {
            (Some(clamped), Some(limit)) => self.solve_held(&mut system, clamped, limit, now)?,
            _ => false,
        };
        if !solved {
            self.solve_system(&system, now)?;
        }
        let (forces, power) = self.reactions(&system, now);
        let Some(clamped) = clamped else {
            return Ok((system, forces, power));
        };
        let speed = self.drive.speed;
        let pressure = forces[clamped][1] * self.units.force() / self.area;
        let Some(limit) = self.drive.exceeded(pressure) else {
            return Ok((system, forces, power));
        };
        let factor = self.drive.speed / speed;
        for x in now.u.iter_mut().chain(&mut now.p) {
            *x *= factor;
        }
        if !self.solve_held(&mut system, clamped, limit, now)? {
            self.solve_system(&system, now)?;
        }
        let (forces, power) = self.reactions(&system, now);
        Ok((system, forces, power))
    }

    fn reactions(&mut self, system: &System, now: &Unknowns) -> (Vec<[f64; 3]>, f64) {
        (self.stages).time(Stage::Forces, || system.reactions(&now.u, &now.p))
    }

    /// Solves for the speed at which the pressure on body `clamped` is `limit` (Pa); `false`
    /// where the clamp cannot move like that, and moves as near to it as it can.
    fn solve_held(
        &mut self,
        system: &mut System,
        clamped: usize,
        limit: f64,
        now: &mut Unknowns,
    ) -> Result<bool, Failure> {
        let force = limit * self.area / self.units.force();
        let mut bodies = self.drive.velocities();
        let load = system.load(clamped, force);
        if !load.is_felt() {
            // No liquid touches the body: at any speed it stays below its limit.
            self.drive.follow(f64::INFINITY);
            return Ok(false);
        }
        bodies[clamped] = [0.0; 3];
        system.steer(&bodies);
        let mut speed = self.drive.speed;
        let solver = &mut self.solver;
        let outcome = (self.stages).time(Stage::Solve, || {
            solver.solve_loaded(&system.saddle(), &load, &mut now.u, &mut now.p, &mut speed)
        });
        self.count(outcome, now)?;
        let follows = self.drive.follow(speed);
        system.steer(&self.drive.velocities());
        Ok(follows)
    }

    fn solve_system(&mut self, system: &System, now: &mut Unknowns) -> Result<(), Failure> {
        let solver = &mut self.solver;
        let outcome = (self.stages).time(Stage::Solve, || {
            solver.solve(&system.saddle(), &mut now.u, &mut now.p)
        });
        self.count(outcome, now)
    }

    /// Counts the iterations of a solve that converged, or nearly.
    fn count(
        &self,
        outcome: Result<SaddleReport, SolveError>,
        now: &mut Unknowns,
    ) -> Result<(), Failure> {
        match outcome {
            Ok(report) => now.iterations += report.iterations() as u32,
            Err(SolveError::NotConverged {
                iterations,
                residual,
                tolerance,
            }) if residual <= NEARLY * tolerance => now.iterations += iterations as u32,
            Err(error) => return Err(self.unsolved(error)),
        }
        Ok(())
    }

    /// Viscosities at the rates of the velocities `u`; how much they changed.
    fn update_viscosity(&mut self, operator: &mut Operator, u: &[f64]) -> f64 {
        let bodies = self.drive.velocities();
        let influence = self.wall.influence_length() / self.units.h;
        let (lattice, liquid, units) = (operator.lattice, &self.liquid, self.units);
        self.stages.time(Stage::Assembly, || {
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
                    cell => (p[cell as usize] * self.units.pressure()) as f32,
                }
            })
            .collect()
    }
}

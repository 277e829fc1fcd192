//! Stages 4 to 6: what the particles carry to the unknowns, and passes over the viscosity.

use physics::{Failure, Viscosity};

use super::air::Air;
use super::controlled::Solved;
use super::{Implicit, Part, Trial, Units};
use crate::liquid::{self, Fractions, Volumes};
use crate::system::air::Held;
use crate::system::{Before, Dofs, Found, NONE, Operator, Sheared};
use crate::transport::density::Cells;
use crate::transport::{Field, Near};
use saddle_point::Csr;

/// Largest number of passes over a viscosity that depends on the shear rate.
pub(super) const PASSES: usize = 20;
/// Most solves of a step for which contact lines hold and which go.
pub(super) const LINES: usize = 10;
/// Relative change of the viscosity, weighted by dissipation, below which no further pass is made.
const SETTLED: f64 = 1e-3;
/// The same after the last pass from which the viscosity does not count as that of the flow.
const UNSETTLED: f64 = 0.01;

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
    /// Where the viscosity depends on the shear rate: what that asked for.
    pub(super) viscous: Option<Viscous>,
    /// Whether contact lines hold and go as the flow asks for.
    pub(super) decided: bool,
    /// For the density projection: fluxes, liquid volumes of the faces, and the liquid in the
    /// pressure unknowns.
    pub(super) g: Csr<f64>,
    pub(super) face_volume: Vec<f64>,
    pub(super) cells: Cells,
    /// Air of the pockets, where they have pressures, and what those beside liquid grow by in the step, cells.
    pub(super) air: Option<(Held, Vec<f64>)>,
}

/// The flow that a viscosity was taken from.
pub(super) struct Viscous {
    pub(super) field: Field,
    /// Whether the viscosity that was solved with is that of this flow.
    pub(super) settled: bool,
}

/// Unknowns of a solve, scaled: start values and result.
pub(super) struct Unknowns {
    pub(super) u: Vec<f64>,
    pub(super) p: Vec<f64>,
    pub(super) iterations: u32,
    /// Whether contact lines hold and go as the velocities ask for.
    pub(super) decided: bool,
}

impl Implicit {
    /// Stages 4 to 6: assembles, solves and finds the forces, with viscosity passes and load control.
    pub(super) fn solve(&mut self, trial: &Trial) -> Result<Solution, Failure> {
        let fractions = std::mem::take(&mut self.workspace.fractions);
        let result = self.solve_with(trial, &fractions);
        self.workspace.fractions = fractions;
        result
    }

    fn solve_with(&mut self, trial: &Trial, fractions: &Fractions) -> Result<Solution, Failure> {
        let lattice = &trial.lattice;
        let scales = self.setup.scales(trial.dt);
        let volumes = Volumes::new(lattice, &fractions.liquid).lacking(&fractions.lack);
        let mut operator = self
            .workspace
            .clock
            .time(Part::Assembly, || Operator::new(lattice, &volumes, scales));
        if let Some(exchange) = &trial.exchange {
            operator.thicken(&exchange.factor);
        }
        let start = self.carried(&operator);
        self.state.particles.go_back();
        let mut now = Unknowns {
            u: start.u.clone(),
            p: start.p.clone(),
            iterations: 0,
            decided: true,
        };
        let (pockets, mut air) = match self.closed_off(&operator) {
            Some(Air {
                pockets,
                held,
                fresh,
            }) => (Some((pockets, fresh)), Some(held)),
            None => (None, None),
        };
        let bodies = self.state.drive.velocities();
        operator.pull =
            (self.workspace.clock).time(Part::Assembly, || operator.pull(&start.u, &bodies));
        operator.pockets = pockets.as_ref().map(|(pockets, _)| pockets);
        let lost = self.lost(&operator, trial, &start.u);
        let stiffness = self.stiffness(&start.p);
        let before = Before {
            velocity: &start.u,
            pressure: &start.p,
            stiffness: &stiffness,
            lost: &lost,
            air: &[],
        };
        let ((system, reactions), viscous, growth) = match (&pockets, &mut air) {
            (Some((pockets, fresh)), Some(held)) => {
                let air = (pockets, held, &fresh[..]);
                self.solve_with_air(&mut operator, before, air, trial, &mut now)?
            }
            _ => {
                let (solved, viscous) = self.solve_once(&mut operator, before, &mut now)?;
                (solved, viscous, Vec::new())
            }
        };
        let pick = |field: &[f32]| {
            (operator.dofs.cells.iter())
                .map(|&c| field[c as usize])
                .collect()
        };
        let cells = Cells {
            density: pick(&fractions.density),
            fraction: pick(&volumes.fraction),
            volume: pick(&volumes.cell),
        };
        Ok(Solution {
            pressure: self.spread(&operator, &now.p),
            bodies: self.state.drive.velocities(),
            speed: self.state.drive.speed,
            forces: reactions.forces,
            power: reactions.power * self.setup.units.force(),
            iterations: now.iterations,
            viscous,
            decided: now.decided,
            u: now.u,
            g: match &air {
                Some(_) => system.g.first_rows(operator.dofs.cells.len()),
                None => system.g,
            },
            air: air.map(|held| (held, growth)),
            cells,
            face_volume: system.face_volume,
            dofs: operator.dofs,
        })
    }

    /// What liquid loses to cells that are not as full as they count, with the velocities `u` before the step, and to walls,
    /// cells^2 m/s.
    fn lost(&self, operator: &Operator, trial: &Trial, u: &[f64]) -> Vec<f64> {
        let mut lost = operator.filling(u, &trial.bodies);
        if let Some(exchange) = &trial.exchange {
            lost.resize(lost.len().max(operator.dofs.cells.len()), 0.0);
            exchange.add_lost(
                &operator.dofs.cell,
                self.setup.units.h / trial.dt,
                &mut lost,
            );
        }
        lost
    }

    /// Stages 4 to 6 with the air as given.
    pub(super) fn solve_once(
        &mut self,
        operator: &mut Operator,
        before: Before,
        now: &mut Unknowns,
    ) -> Result<(Solved, Option<Viscous>), Failure> {
        let mut solves = 1;
        loop {
            let solved = self.solve_with_lines(operator, before, now)?;
            let bodies = self.state.drive.velocities();
            now.decided = operator.settle_lines(&now.u, &bodies);
            if now.decided || solves == LINES {
                return Ok(solved);
            }
            solves += 1;
        }
    }

    /// The same with contact lines as they are.
    fn solve_with_lines(
        &mut self,
        operator: &mut Operator,
        before: Before,
        now: &mut Unknowns,
    ) -> Result<(Solved, Option<Viscous>), Failure> {
        if self.setup.present.table {
            self.solve_passes(operator, before, now)
        } else {
            Ok((self.controlled(operator, before, now)?, None))
        }
    }

    /// Velocities and scaled pressures that the particles carry to the unknowns.
    fn carried(&mut self, operator: &Operator) -> Unknowns {
        let window = &operator.lattice.window;
        let (dofs, units) = (&operator.dofs, self.setup.units);
        let (particles, bins) = (&self.state.particles, &self.workspace.bins);
        self.workspace.clock.time(Part::Fractions, || {
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
                decided: true,
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

    /// Stages 4 to 6 in passes over the viscosity, until it is that of the flow; and that flow.
    fn solve_passes(
        &mut self,
        operator: &mut Operator,
        before_step: Before,
        now: &mut Unknowns,
    ) -> Result<(Solved, Option<Viscous>), Failure> {
        let carried = before_step.velocity;
        let by_formula = matches!(self.setup.liquid.viscosity, Viscosity::Law(_));
        // Without a last step the first pass takes the unit: liquid at rest may be decades thicker than what will flow, and
        // thick beside what a wall already shears is the hardest of systems.
        if let Some(last) = &self.state.last {
            let start = last.at(&operator.lattice.window, &operator.dofs, carried);
            self.update_viscosity(operator, &start);
        }
        let (mut pass, mut before, mut response) = (0, None, 0.0);
        loop {
            let solved = self.controlled(operator, before_step, now)?;
            pass += 1;
            let (field, found) = self.update_viscosity(operator, &now.u);
            if found.change < SETTLED || pass == PASSES {
                let settled = found.change < UNSETTLED;
                return Ok((solved, Some(Viscous { field, settled })));
            }
            if by_formula {
                if let Some(before) = &before {
                    response = operator.response(before, &found, response);
                }
                let Units { eta, h, .. } = self.setup.units;
                operator.anticipate(&self.setup.liquid, eta, h, &found, response);
                before = Some(found);
            }
        }
    }

    /// Viscosities at the rates of the velocities `u`; the flow of these, and how much the
    /// viscosities changed.
    fn update_viscosity(&mut self, operator: &mut Operator, u: &[f64]) -> (Field, Found) {
        let bodies = self.state.drive.velocities();
        let (liquid, units) = (&self.setup.liquid, self.setup.units);
        let influence = self.setup.influence_length();
        self.workspace.clock.time(Part::Assembly, || {
            let field = Field::new(operator.lattice, &operator.dofs.face, u, &bodies, influence);
            let sheared = Sheared {
                deviator: |x| field.flow.deviator_norm(x, &mut Near::default()),
                u,
                bodies: &bodies,
            };
            let found = operator.set_viscosity(liquid, units.eta, units.h, &sheared);
            (field, found)
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

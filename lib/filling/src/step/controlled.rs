//! Stages 5 and 6: the linear solve at the clamp's speed or pressure limit, and the forces.

use physics::Failure;
use saddle_point::{NEARLY, SaddleReport, SolveError};

use super::drive::Asked;
use super::solution::Unknowns;
use super::{Implicit, Part};
use crate::settings::Settings;
use crate::system::{Before, Operator, Reactions, System};

/// Part of the forces on the bodies that what the solver leaves may add up to, over its tolerance or the usual one, where that is more.
const UNBALANCED: f64 = 10.0;
/// Solves of a system until it is less: to these parts of the tolerance.
const SOLVES: [f64; 3] = [1.0, 0.1, 0.01];

/// A solved system and what follows from its solution.
pub(super) type Solved = (System, Reactions);

impl Implicit {
    /// Assembles and solves until forces on the bodies are those on the liquid.
    pub(super) fn controlled(
        &mut self,
        operator: &Operator,
        before: Before,
        now: &mut Unknowns,
    ) -> Result<Solved, Failure> {
        let bodies = self.state.drive.velocities();
        let mut system = (self.workspace.clock)
            .time(Part::Assembly, || operator.assemble(&bodies, before))
            .map_err(|error| self.unsolved(error))?;
        let tolerance = self.setup.settings.tolerance;
        let most = UNBALANCED * tolerance.max(Settings::default().tolerance);
        let mut unbalanced = 0.0;
        for part in SOLVES {
            self.workspace.solver.set_tolerance(part * tolerance);
            let reactions = self.solve_at_speed_or_load(&mut system, operator, now)?;
            if reactions.unbalanced <= most {
                return Ok((system, reactions));
            }
            unbalanced = reactions.unbalanced;
        }
        Err(self.unbalanced(unbalanced))
    }

    /// Solves at the clamp's speed or, where it is held at its pressure limit, for that speed.
    fn solve_at_speed_or_load(
        &mut self,
        system: &mut System,
        operator: &Operator,
        now: &mut Unknowns,
    ) -> Result<Reactions, Failure> {
        let clamped = self.state.drive.clamped();
        let solved = match (clamped, self.state.drive.held()) {
            (Some(clamped), Some(asked)) => self.solve_held(system, clamped, asked, now)?,
            _ => false,
        };
        if !solved {
            self.solve_system(system, now)?;
        }
        let reactions = self.reactions(system, operator, now);
        let Some(clamped) = clamped else {
            return Ok(reactions);
        };
        let speed = self.state.drive.speed;
        let pressure = self.setup.pressure(&reactions.forces, clamped);
        let Some(asked) = self.state.drive.exceeded(pressure) else {
            return Ok(reactions);
        };
        if speed > 0.0 {
            let factor = self.state.drive.speed / speed;
            for x in now.u.iter_mut().chain(&mut now.p) {
                *x *= factor;
            }
        }
        if !self.solve_held(system, clamped, asked, now)? {
            self.solve_system(system, now)?;
        }
        Ok(self.reactions(system, operator, now))
    }

    fn reactions(&mut self, system: &System, operator: &Operator, now: &Unknowns) -> Reactions {
        (self.workspace.clock).time(Part::Forces, || {
            system.reactions(&operator.dofs.faces, &now.u, &now.p)
        })
    }

    /// Solves for the speed at which the pressure on body `clamped` is that asked for; `false`
    /// where the clamp cannot move like that, and moves as near to it as it can.
    fn solve_held(
        &mut self,
        system: &mut System,
        clamped: usize,
        asked: Asked,
        now: &mut Unknowns,
    ) -> Result<bool, Failure> {
        let unit = self.setup.area / self.setup.units.force();
        let mut bodies = self.state.drive.velocities();
        let load = system.load(clamped, asked.limit * unit, asked.least * unit);
        if !load.is_felt() {
            // No liquid touches the body: at any speed it stays below its limit.
            self.state.drive.follow(f64::INFINITY);
            return Ok(false);
        }
        bodies[clamped] = [0.0; 3];
        system.steer(&bodies);
        let mut speed = self.state.drive.speed;
        let solver = &mut self.workspace.solver;
        system.take_shift(&mut now.p);
        let outcome = (self.workspace.clock).time(Part::Solve, || {
            solver.solve_loaded(&system.saddle(), &load, &mut now.u, &mut now.p, &mut speed)
        });
        system.add_shift(&mut now.p);
        self.count(outcome, now)?;
        let follows = self.state.drive.follow(speed);
        system.steer(&self.state.drive.velocities());
        Ok(follows)
    }

    fn solve_system(&mut self, system: &System, now: &mut Unknowns) -> Result<(), Failure> {
        let solver = &mut self.workspace.solver;
        system.take_shift(&mut now.p);
        let outcome = (self.workspace.clock).time(Part::Solve, || {
            solver.solve(&system.saddle(), &mut now.u, &mut now.p)
        });
        system.add_shift(&mut now.p);
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
}

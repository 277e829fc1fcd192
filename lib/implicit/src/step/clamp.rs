//! The clamp in a step: its speed under a pressure limit, and the step length that ends its travel (docs/methods.md sections
//! 3.1 and 3.7).

use physics::{PressRun, StepLimit};

use super::Implicit;
use super::drive::LoadControl;
use super::mid_step::MidStep;
use super::solve::Solved;
use crate::settings::ITERATION_TOLERANCE;
use crate::system::{Drive, Flow, REST_DISTANCE};

/// Share of the remaining travel from which on a step is fitted to end the travel. A smaller one lengthens steps too much; a
/// larger one leaves a last step that hardly moves.
const FIT_FROM: f64 = 0.7;
/// Bound on the solves that fit a step to the end of the travel, and that find the speed of a clamp under a pressure limit:
/// both converge in one or two, or not at all.
const MAX_SOLVES: usize = 4;

/// Length of the step that covers the travel `left`. The clamp's speed is taken as linear in the length, through the last solve
/// and the one `before`, each given as length and speed.
fn length_to_end_of_travel(left: f64, [dt, speed]: [f64; 2], before: Option<[f64; 2]>) -> f64 {
    let slope = before.map_or(0.0, |[other, slower]| (speed - slower) / (dt - other));
    let first = speed - slope * dt;
    let end = 2.0 * left / (first + (first * first + 4.0 * slope * left).sqrt());
    if end > 0.0 && end.is_finite() {
        end
    } else {
        left / speed
    }
}

/// Whether the gap's height by the speed found differs from that `assumed`.
fn height_differs(assumed: f64, height: f64) -> bool {
    // Ten times the tolerance: flow goes with the cube of the height, but another solve costs as much as a step.
    (height - assumed).abs() > 10.0 * ITERATION_TOLERANCE * assumed
}

impl Implicit {
    /// Solves the flow of a step of `dt` (s), or of another length up to `longest` if the step ends the clamp's travel.
    /// `start` is the flow from which a solve starts; it is replaced by the result.
    pub(super) fn solve(
        &mut self,
        dt: f64,
        limit: StepLimit,
        longest: f64,
        start: &mut Flow,
    ) -> Result<Solved, String> {
        let left = self.travel_left(limit);
        let mut solved = self.solve_controlled(dt, start)?;
        if left == f64::INFINITY || left == 0.0 {
            return Ok(solved);
        }
        // Under a pressure limit the clamp's speed depends on the step length: secant iteration on the length.
        let mut before = None;
        for _ in 0..MAX_SOLVES {
            let now = [solved.dt, solved.flow.speed];
            let reach = now[0] * now[1];
            let end = length_to_end_of_travel(left, now, before.replace(now));
            if reach < FIT_FROM * left
                || (reach / left - 1.0).abs() <= ITERATION_TOLERANCE
                || end > longest
            {
                break;
            }
            solved = self.solve_controlled(end, start)?;
        }
        let reach = solved.flow.speed * solved.dt;
        // An absolute tolerance too: a film under pressure never closes, and voxel surfaces are known less well than that.
        let tolerance = (ITERATION_TOLERANCE * left).max(REST_DISTANCE);
        if reach > left + tolerance {
            let dt = solved.dt;
            let mut middle = self.middle(dt, Some(&solved.flow), &solved.full);
            self.find_water_loss(&mut middle)?;
            solved = self.solve_driven(&middle, Drive::Speed(left / dt), start)?;
        }
        let reach = solved.flow.speed * solved.dt;
        solved.ends_travel = (reach - left).abs() <= tolerance;
        Ok(solved)
    }

    /// Travel that is left, cells, at most the gap; infinite in a programme whose clamp has closed and now stands or retreats.
    pub(super) fn travel_left(&self, limit: StepLimit) -> f64 {
        let programme = self.state.drive.programme.as_ref();
        if programme.is_some_and(PressRun::is_closed) {
            return f64::INFINITY;
        }
        let travel = limit.travel_m / self.setup.units.cell_m;
        match self.setup.lattice.moving {
            Some(_) => travel.min(self.height),
            None => travel,
        }
    }

    /// Solves the flow of a step of `dt` (s) with the clamp at full speed, or at the speed of its pressure limit.
    fn solve_controlled(&mut self, dt: f64, start: &mut Flow) -> Result<Solved, String> {
        // Liquid has the pressure of the middle of the step, air that of its volume at the end.
        self.state.drive.set_limit_ahead(match self.setup.gas {
            Some(_) => dt,
            None => 0.5 * dt,
        });
        let mut middle = self.middle(dt, None, &[]);
        self.find_water_loss(&mut middle)?;
        for _ in 1..MAX_SOLVES {
            let solved = self.solve_middle(&middle, start)?;
            let [assumed, height] = self.mid_heights(&middle, &solved, dt);
            let is_off = height_differs(assumed, height);
            let overfills = self.overfills(&middle, &solved.flow);
            if !overfills && !is_off && height >= (1.0 - ITERATION_TOLERANCE) * assumed {
                return Ok(solved);
            }
            // A faster clamp may fill pores that were not full before. A slower one keeps the pores that were full, or the
            // iteration would oscillate.
            let other = self.middle(dt, Some(&solved.flow), &middle.full);
            let accepted = match height < assumed {
                _ if overfills => false,
                true => !is_off && !other.has_more_full_pores(&middle),
                false => middle.has_more_full_pores(&other),
            };
            if accepted {
                self.mesh.set_height(assumed);
                return Ok(solved);
            }
            middle = other;
            self.find_water_loss(&mut middle)?;
        }
        let mut solved = self.solve_middle(&middle, start)?;
        let [assumed, height] = self.mid_heights(&middle, &solved, dt);
        solved.settled &= !height_differs(assumed, height);
        Ok(solved)
    }

    /// Height of the gap in the middle of a step of `dt` (s), cells: as assumed, and by the speed found.
    fn mid_heights(&self, middle: &MidStep, solved: &Solved, dt: f64) -> [f64; 2] {
        [middle.closing_speed, solved.flow.speed].map(|closing| self.middle_height(dt, closing))
    }

    /// Solves the flow with the clamp at full speed, or at the speed of its pressure limit, from a given `middle` of the step.
    fn solve_middle(&mut self, middle: &MidStep, start: &mut Flow) -> Result<Solved, String> {
        if let Some(control) = self.state.drive.active_load_control() {
            return self.solve_at_limit(middle, control, start);
        }
        let full = Drive::Speed(self.state.drive.speed / self.setup.units.cell_m);
        let free = self.solve_driven(middle, full, start)?;
        let pressure = self.setup.pressure(free.flow.force);
        match self.state.drive.activate_if_exceeded(pressure) {
            Some(control) => self.solve_at_limit(middle, control, start),
            None => Ok(free),
        }
    }

    /// Solves the flow with a given pressure on the clamp. If the clamp cannot move at the speed found, solves at the
    /// nearest speed that it can.
    fn solve_at_limit(
        &mut self,
        middle: &MidStep,
        control: LoadControl,
        start: &mut Flow,
    ) -> Result<Solved, String> {
        let cell_m = self.setup.units.cell_m;
        // Viscous flow is proportional to the closing speed.
        start.scale_to_speed(self.state.drive.speed / cell_m);
        let drive = Drive::Force {
            force: self.setup.force(control.limit),
            scale: self.setup.force(control.scale()),
            start_speed: self.state.drive.speed / cell_m,
        };
        let solved = self.solve_driven(middle, drive, start)?;
        match self.state.drive.accept_speed(solved.flow.speed * cell_m) {
            true => Ok(solved),
            false => {
                let drive = Drive::Speed(self.state.drive.speed / cell_m);
                self.solve_driven(middle, drive, start)
            }
        }
    }
}

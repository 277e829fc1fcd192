//! How long a step is, and whether what was solved fits it.

use physics::{Failure, StepLimit, restored};
use rayon::prelude::*;

use super::{Implicit, Solution, State, Trial};

/// Part of the CFL number that the liquid is to cross in a step.
const AIM: f64 = 0.97;
/// CFL numbers that it may cross, bodies one; a step in which more is crossed is solved again.
const OVERSHOT: f64 = 1.1;
/// Cells by which the middle of a body's way may lie off the place that the step was solved for: its
/// speed under load control is known only then. With a tenth of a cell a plate that is about to
/// touch liquid can be held back before it does, step after step.
const MISPLACED: f64 = 0.02;
/// Fraction of the face velocities, the fastest, that the CFL number ignores: jets through holes of
/// one voxel must not set the time step of the whole bond. They cross [`JET_CFL`] cells at most.
const JETS: f64 = 1e-3;
/// Most cells that any liquid crosses per step.
const JET_CFL: f64 = 1.5;
/// Most that cure changes ln(viscosity) by in a step, in which it is that of the step's middle: the mean of
/// 1/viscosity over the step is then within (0.2/2)^2/6 of it.
pub(crate) const CURED: f64 = 0.2;
/// Part of the clamp's way left by which the step that ends it may miss the end.
const MISSED: f64 = 1e-3;

/// Whether a solution fits the step that it was solved for.
#[derive(Clone, Copy)]
pub(super) enum Fit {
    Good,
    /// Liquid or bodies overshoot the CFL number; the pace is known better now.
    Fast,
    /// The bodies are not where they were placed.
    Misplaced,
    /// The clamp goes beyond the end of its way, or not all of it in a step that was to end it; its
    /// speed is known now.
    Missed,
    /// The liquid dries too fast for it: the part of it that is to be tried next.
    Dried(f64),
}

/// How the pace changed from the last step but one to the last, by which the next is foreseen.
#[derive(Clone, Copy, Default)]
pub(super) struct Trend {
    /// Change of ln(pace) over time, 1/s.
    rate: f64,
    /// Pace of the last step, m/s; 0 before the first.
    last: f64,
    /// Its length, s.
    dt: f64,
}

/// Name of the array that holds it in a checkpoint.
pub(super) const TREND: &str = "trend";
/// Most that the pace is foreseen to grow by in a step.
const FORESEEN: f64 = 1.25;
/// Growth of it that is not foreseen: with the place of fronts in their cells that of a steady flow goes up and down.
const UNSTEADY: f64 = 1.05;

impl Trend {
    /// Takes in the pace (m/s) of the middle of a step of `dt` (s).
    pub(super) fn observe(&mut self, pace: f64, dt: f64) {
        self.rate = match self.last > 0.0 && pace > 0.0 {
            true => (pace / self.last).ln() / (0.5 * (self.dt + dt)),
            false => 0.0,
        };
        (self.last, self.dt) = (pace, dt);
    }

    /// What the pace grows by until the middle of a next step of `dt` (s); 1 where it falls.
    fn growth(&self, dt: f64) -> f64 {
        let growth = (self.rate * 0.5 * (self.dt + dt)).exp();
        (growth / UNSTEADY).clamp(1.0, FORESEEN)
    }

    /// For checkpoints.
    pub(super) fn state(&self) -> Vec<f64> {
        vec![self.rate, self.last, self.dt]
    }

    /// That of a checkpoint.
    ///
    /// # Errors
    /// A sentence where no run saves it.
    pub(super) fn restore(saved: &[f64]) -> Result<Self, String> {
        restored::check_finite(saved, TREND)?;
        match saved {
            &[rate, last, dt] if last >= 0.0 && dt >= 0.0 => Ok(Self { rate, last, dt }),
            _ => Err("the checkpoint's trend is not that of the implicit scheme".into()),
        }
    }
}

impl Implicit {
    /// Sets the pace to that of the middle of the next step, as the last two go on. A programme foresees by its
    /// pressure ([`Drive::aim`](super::Drive::aim)).
    pub(super) fn foresee(&mut self, limit: StepLimit) -> Result<(), Failure> {
        if self.state.drive.programme().is_none() {
            let dt = self.time_step(limit)?;
            self.state.pace *= self.state.trend.growth(dt);
        }
        Ok(())
    }

    /// Stage 1: CFL cells of the fastest motion known, in equal parts of what is left, s.
    pub(super) fn time_step(&self, limit: StepLimit) -> Result<f64, Failure> {
        let (setup, drive) = (&self.setup, &self.state.drive);
        let speed = (self.state.pace / AIM).max(fastest(&drive.velocities()));
        let mut left = limit.time_s;
        if drive.clamped().is_some() && drive.speed > 0.0 {
            left = left.min(limit.travel_m / drive.speed);
        }
        let step = if speed > 0.0 {
            setup.settings.cfl * setup.units.h / speed
        } else {
            // From rest under a body force: the distance fallen in the step.
            let pull = setup.gravity.iter().fold(0.0, |m: f64, g| m.max(g.abs()));
            let way = setup.settings.cfl * setup.units.h;
            let fallen = (2.0 * way / pull).sqrt();
            // No meniscus draws liquid on faster than sigma/eta. Without this bound pins, which know no
            // speed of a step before, would hold one that fills for all of the time that is left.
            (setup.liquid.wetting).map_or(fallen, |wetting| {
                fallen.min(way * setup.units.viscosity() / wetting.tension)
            })
        };
        let step = (setup.liquid.cure.as_ref())
            .map_or(step, |cure| step.min(cure.steady(self.state.time, CURED)));
        let step = step.min(self.moist());
        let dt = if step < left {
            left / (left / step).ceil()
        } else {
            left
        };
        if dt > 0.0 && dt.is_finite() {
            return Ok(dt);
        }
        Err(self.failure("nothing moves and no time is left: there is no time step to take"))
    }

    /// What cure multiplies the viscosity by in the middle of a step of `dt` (s) from now on.
    pub(super) fn cured(&self, dt: f64) -> f64 {
        let cure = self.setup.liquid.cure.as_ref();
        cure.map_or(1.0, |cure| cure.factor(self.state.time + 0.5 * dt))
    }

    /// Aims the clamp at the middle of a step of at most `dt` (s), made as short as the pressure that is set
    /// there asks for; its length.
    pub(super) fn aim(&mut self, mut dt: f64) -> f64 {
        let State { drive, pace, .. } = &mut self.state;
        if drive.programme().is_none() {
            return dt;
        }
        let way = self.setup.settings.cfl * self.setup.units.h;
        loop {
            *pace *= drive.aim(dt);
            if pace.max(fastest(&drive.velocities())) * dt <= way * (1.0 + 1e-9) {
                return dt;
            }
            dt *= 0.5;
        }
    }

    /// Whether neither liquid nor bodies overshoot the CFL number, and the bodies are where they
    /// were placed; whether the clamp is to end its way in this step, and does. The solution sets the pace.
    pub(super) fn fit(&mut self, trial: &Trial, solution: &Solution, limit: StepLimit) -> Fit {
        let (cfl, h) = (self.setup.settings.cfl, self.setup.units.h);
        self.state.pace = pace(&solution.u, cfl);
        let overshoots = self.overshoots(&solution.bodies, trial.dt);
        let misplaced = 0.5 * trial.dt / h * apart(&trial.bodies, &solution.bodies);
        if misplaced > MISPLACED {
            Fit::Misplaced
        } else if overshoots {
            Fit::Fast
        } else if self.misses(trial, solution, limit) {
            Fit::Missed
        } else {
            Fit::Good
        }
    }

    /// How long an accepted step is, s: as it was solved for, or to the end of the clamp's way where that
    /// is before, or next to it and within the bounds of the step.
    pub(super) fn length(&self, trial: &Trial, solution: &Solution, limit: StepLimit) -> f64 {
        if self.state.drive.clamped().is_none() || solution.speed <= 0.0 {
            return trial.dt;
        }
        let end = limit.travel_m / solution.speed;
        let near = (trial.dt / end - 1.0).abs() <= MISSED;
        if near && end <= limit.time_s && !self.overshoots(&solution.bodies, end) {
            end
        } else {
            trial.dt.min(end)
        }
    }

    /// Whether liquid or bodies cross too many cells in `dt` (s).
    fn overshoots(&self, bodies: &[[f64; 3]], dt: f64) -> bool {
        let way = self.setup.settings.cfl * self.setup.units.h * (1.0 + 1e-9);
        // A clamp at its limit follows the step: a long one there is felt all the way after.
        let most = match self.state.drive.held() {
            Some(_) => 1.0,
            None => OVERSHOT,
        };
        self.state.pace * dt > most * way || fastest(bodies) * dt > way
    }

    fn misses(&self, trial: &Trial, solution: &Solution, limit: StepLimit) -> bool {
        let Some(clamped) = self.state.drive.clamped() else {
            return false;
        };
        // Part of the way by which a step at a speed goes beyond its end.
        let beyond = |speed: f64| speed * trial.dt / limit.travel_m - 1.0;
        let (guess, solved) = (beyond(-trial.bodies[clamped][1]), beyond(solution.speed));
        let last = guess > -1e-9;
        solved > MISSED || last && solved < -MISSED
    }
}

/// The speed (m/s) that is to cross `cfl` cells per step: that of all liquid but [`JETS`], or more
/// where jets would cross more than [`JET_CFL`].
fn pace(u: &[f64], cfl: f64) -> f64 {
    let mut speeds: Vec<f32> = u.par_iter().map(|u| u.abs() as f32).collect();
    let Some(last) = speeds.len().checked_sub(1) else {
        return 0.0;
    };
    let place = ((1.0 - JETS) * last as f64).ceil() as usize;
    let (_, &mut most, jets) = speeds.select_nth_unstable_by(place, f32::total_cmp);
    let fastest = jets.iter().fold(most, |m, &u| m.max(u));
    f64::from(most).max(f64::from(fastest) * cfl / JET_CFL.max(cfl))
}

/// Largest component of velocities, m/s.
fn fastest(velocities: &[[f64; 3]]) -> f64 {
    (velocities.iter().flatten()).fold(0.0, |most, v| most.max(v.abs()))
}

/// Largest difference of a component between velocities, m/s.
fn apart(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    (a.iter().flatten())
        .zip(b.iter().flatten())
        .fold(0.0, |most, (a, b)| most.max((a - b).abs()))
}

#[cfg(test)]
mod tests {
    use super::Trend;

    /// What doubles in 4 s goes on doing so, for as long as both steps take; what jumps is not followed, nor what falls.
    #[test]
    fn the_next_step_goes_on_as_the_last_two() {
        let mut trend = Trend::default();
        assert_eq!(trend.growth(1.0), 1.0);
        trend.observe(3.0, 1.0);
        assert_eq!(trend.growth(1.0), 1.0);
        // Middles are 2 s apart.
        trend.observe(3.0 * 2_f64.sqrt(), 3.0);
        let growth = 2_f64.powf(1.5 / 4.0) / 1.05;
        assert!((trend.growth(0.0) - growth).abs() < 1e-12);
        trend.observe(1e3, 0.5);
        assert_eq!(trend.growth(0.5), 1.25);
        trend.observe(1.0, 0.5);
        assert_eq!(trend.growth(0.5), 1.0);
    }

    #[test]
    fn a_thousandth_of_the_faces_may_be_jets_of_one_and_a_half_cells() {
        let paced = |jets: usize, speed: f64| {
            let u: Vec<f64> = (0..10_000)
                .map(|face| if face < jets { speed } else { 1.0 })
                .collect();
            super::pace(&u, 0.5)
        };
        assert_eq!((paced(9, 2.0), paced(12, 2.0)), (1.0, 2.0));
        assert!((paced(9, 30.0) / 10.0 - 1.0).abs() < 1e-6);
    }
}

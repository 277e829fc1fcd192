//! Progress of a clamp through its press programme.

use super::{Press, PressStage, Reason, StageEnd};
use crate::{Choice, StepLimit};

/// The data of a step that the programme needs.
#[derive(Clone, Copy, Debug)]
pub struct PressStep {
    /// Duration, s.
    pub dt_s: f64,
    /// Speed of the clamp, m/s.
    pub speed: f64,
    /// Travel of the clamp after it, m.
    pub travel_m: f64,
    /// Pressure on the clamp's body, Pa.
    pub pressure: f64,
}

/// Relative tolerance of pressure control, half of the 1 % aimed at: a pressure this far below counts as reached, and this far
/// above it a clamp is held.
pub const CONTROLLED: f64 = 5e-3;
/// Rounding of a travel or a time, relative.
const ROUNDING: f64 = 1e-9;
/// Least number of steps of a ramp, and of a stage that ends when the clamp is slow.
const LEAST_STEPS: f64 = 10.0;
/// Numbers in the state without the ended stages.
const STATE_NUMBERS: usize = 5;
/// Numbers in the state for each ended stage.
const STAGE_NUMBERS: usize = 4;

/// A press programme and the progress of a clamp through it.
#[derive(Clone, Debug, PartialEq)]
pub struct PressRun {
    stages: Vec<PressStage>,
    /// Largest travel of the clamp, m.
    room_m: f64,
    /// Index of the stage of the last step.
    last_stage: usize,
    elapsed_s: f64,
    time_s: f64,
    /// Pressure at the start of the stage, Pa.
    start_pressure: f64,
    closed: bool,
    ended: Vec<StageEnd>,
}

impl PressRun {
    /// The start of a programme of at least one stage for a clamp that can travel `room_m` (m).
    pub fn new(stages: Vec<PressStage>, room_m: f64) -> Self {
        Self {
            stages,
            room_m,
            last_stage: 0,
            elapsed_s: 0.0,
            time_s: 0.0,
            start_pressure: 0.0,
            closed: false,
            ended: Vec::new(),
        }
    }

    /// The current stage; the last one when all are over.
    pub fn stage(&self) -> &PressStage {
        &self.stages[self.ended.len().min(self.stages.len() - 1)]
    }

    /// Whether all stages are over.
    pub fn is_over(&self) -> bool {
        self.ended.len() == self.stages.len()
    }

    /// Index of the stage of the last step.
    pub fn last_stage(&self) -> usize {
        self.last_stage
    }

    /// The ended stages with their ends.
    pub fn ended(&self) -> impl Iterator<Item = (&PressStage, &StageEnd)> {
        self.stages.iter().zip(&self.ended)
    }

    /// Whether the clamp has reached the end of its travel.
    pub fn is_closed(&self) -> bool {
        self.closed
    }

    /// Whether a stage ended with the clamp at the end of its travel, under less than the stage's pressure.
    pub fn is_closed_below(&self, stage: &PressStage, end: &StageEnd) -> bool {
        let less = |p: f64| end.pressure < p * (1.0 - CONTROLLED);
        stage.kind != Press::Release
            && end.travel_m >= self.room_m * (1.0 - ROUNDING)
            && stage.pressure.is_some_and(less)
    }

    /// Largest pressure of the programme, Pa.
    pub fn largest(&self) -> f64 {
        (self.stages.iter())
            .filter_map(|stage| stage.pressure)
            .fold(0.0, f64::max)
    }

    /// Set pressure (Pa) at `ahead_s` (s) from now; infinite without a limit.
    pub fn set_pressure(&self, ahead_s: f64) -> f64 {
        let stage = self.stage();
        let target = stage.pressure.unwrap_or(f64::INFINITY);
        if stage.kind != Press::Ramp {
            return target;
        }
        let part = ((self.elapsed_s + ahead_s) / stage.time_s).min(1.0);
        self.start_pressure + (target - self.start_pressure) * part
    }

    /// Whether the stage begins with a set pressure below the one reached, so that the clamp gives way at once.
    pub fn gives_way(&self) -> bool {
        self.elapsed_s == 0.0 && self.set_pressure(0.0) < (1.0 - CONTROLLED) * self.start_pressure
    }

    /// Limits a step to the current stage, for a clamp that has travelled `travel_m` (m).
    pub fn within(&self, limit: StepLimit, travel_m: f64) -> StepLimit {
        let stage = self.stage();
        let end = stage.travel_m.unwrap_or(self.room_m).min(self.room_m);
        let left = stage.time_s - self.elapsed_s;
        // A ramp changes within a step, and slowness is checked at its end: both need several steps in a long stage.
        let parts = match (stage.kind, stage.slower) {
            (Press::Ramp, _) | (_, Some(_)) => (LEAST_STEPS * left / stage.time_s).ceil().max(1.0),
            _ => 1.0,
        };
        StepLimit {
            time_s: limit.time_s.min(left / parts),
            travel_m: limit.travel_m.min((end - travel_m).max(0.0)),
        }
    }

    /// Advances by a step; returns whether it ended the stage.
    pub fn observe(&mut self, step: PressStep) -> bool {
        self.last_stage = self.ended.len().min(self.stages.len() - 1);
        self.elapsed_s += step.dt_s;
        self.time_s += step.dt_s;
        self.closed = step.travel_m >= self.room_m * (1.0 - ROUNDING);
        let Some(reason) = self.reason(&step) else {
            return false;
        };
        let set = self.set_pressure(0.0);
        self.ended.push(StageEnd {
            reason,
            time_s: self.time_s,
            travel_m: step.travel_m,
            pressure: step.pressure,
        });
        self.elapsed_s = 0.0;
        let most = match set.is_finite() {
            true => set,
            false => self.stage().pressure.unwrap_or(0.0),
        };
        self.start_pressure = step.pressure.clamp(0.0, most);
        true
    }

    fn reason(&self, step: &PressStep) -> Option<Reason> {
        let stage = self.stage();
        let approach = stage.kind == Press::Approach;
        let reached = |p: f64| step.pressure >= p * (1.0 - CONTROLLED);
        let gone = |way: f64| step.travel_m >= way - ROUNDING * self.room_m;
        if approach && stage.pressure.is_some_and(reached) {
            Some(Reason::Pressure)
        } else if stage.contact && step.pressure > 0.0 {
            Some(Reason::Contact)
        } else if stage.travel_m.is_some_and(gone) {
            Some(Reason::Travel)
        } else if approach && self.closed {
            Some(Reason::Closed)
        } else if stage.slower.is_some_and(|least| step.speed.abs() < least) {
            // A closed clamp stands on wood: the liquid is not the reason.
            Some(match self.closed && stage.kind == Press::Hold {
                true => Reason::Closed,
                false => Reason::Slower,
            })
        } else if self.elapsed_s >= stage.time_s * (1.0 - ROUNDING) {
            Some(Reason::Time)
        } else {
            None
        }
    }

    /// The state for checkpoints.
    pub fn state(&self) -> Vec<f64> {
        let closed = f64::from(u8::from(self.closed));
        let before = self.last_stage as f64;
        let mut state = vec![
            before,
            self.elapsed_s,
            self.time_s,
            self.start_pressure,
            closed,
        ];
        for end in &self.ended {
            let index = Reason::NAMED.iter().position(|(_, r)| *r == end.reason);
            let index = index.unwrap_or_default() as f64;
            state.extend([index, end.time_s, end.travel_m, end.pressure]);
        }
        state
    }

    /// Restores a saved state.
    ///
    /// # Errors
    /// A sentence if no run of this programme can have this state.
    pub fn set_state(&mut self, state: &[f64]) -> Result<(), String> {
        let wrong = || "the checkpoint's press programme is not that of the case".to_owned();
        let Some((place, ends)) = state.split_first_chunk::<STATE_NUMBERS>() else {
            return Err(wrong());
        };
        let &[before, elapsed_s, time_s, from, closed] = place;
        let (ends, rest) = ends.as_chunks::<STAGE_NUMBERS>();
        if !rest.is_empty()
            || ends.len() > self.stages.len()
            || place.iter().any(|x| *x < 0.0)
            || before > ends.len() as f64
        {
            return Err(wrong());
        }
        self.ended.clear();
        for &[index, time_s, travel_m, pressure] in ends {
            let reason = Reason::NAMED.get(index as usize).ok_or_else(wrong)?.1;
            let end = StageEnd {
                reason,
                time_s,
                travel_m,
                pressure,
            };
            self.ended.push(end);
        }
        if !self.is_over() && elapsed_s > self.stage().time_s {
            return Err(wrong());
        }
        self.last_stage = before as usize;
        (self.elapsed_s, self.time_s, self.start_pressure) = (elapsed_s, time_s, from);
        self.closed = closed != 0.0;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stage(kind: Press, pressure: Option<f64>, time_s: f64) -> PressStage {
        PressStage {
            kind,
            speed: 1e-3,
            pressure,
            time_s,
            travel_m: None,
            contact: false,
            slower: None,
        }
    }

    fn programme() -> PressRun {
        let hold = PressStage {
            slower: Some(1e-9),
            ..stage(Press::Hold, Some(1e6), 300.0)
        };
        let stages = vec![
            stage(Press::Approach, Some(2e5), 1.0),
            stage(Press::Ramp, Some(1e6), 2.0),
            hold,
            stage(Press::Release, Some(0.0), 10.0),
        ];
        PressRun::new(stages, 50e-6)
    }

    fn step(dt_s: f64, speed: f64, travel_m: f64, pressure: f64) -> PressStep {
        PressStep {
            dt_s,
            speed,
            travel_m,
            pressure,
        }
    }

    #[test]
    fn stages_follow_one_another_by_their_ends() {
        let mut run = programme();
        assert!(!run.observe(step(0.01, 1e-3, 10e-6, 0.0)));
        assert_eq!(run.set_pressure(0.0), 2e5);
        assert!(run.observe(step(0.001, 1e-3, 11e-6, 2e5)));
        assert_eq!(run.stage().kind, Press::Ramp);
        // Half way up the ramp at the middle of a step of two seconds.
        assert_eq!(run.set_pressure(1.0), 6e5);
        let limit = StepLimit {
            time_s: 1e9,
            travel_m: 1e9,
        };
        let within = run.within(limit, 11e-6);
        assert_eq!((within.time_s, within.travel_m), (0.2, 50e-6 - 11e-6));
        assert!(run.observe(step(2.0, 1e-6, 13e-6, 9.9e5)));
        assert_eq!(run.last_stage(), 1);
        assert!(!run.observe(step(100.0, 1e-8, 14e-6, 1e6)));
        assert!(run.observe(step(100.0, 1e-10, 14e-6, 1e6)));
        assert_eq!(run.set_pressure(0.0), 0.0);
        assert!(run.observe(step(10.0, -1e-10, 14e-6, 0.0)));
        assert!(run.is_over());
        let reasons: Vec<Reason> = run.ended().map(|(_, end)| end.reason).collect();
        let wanted = [Reason::Pressure, Reason::Time, Reason::Slower, Reason::Time];
        assert_eq!(reasons, wanted);
    }

    #[test]
    fn a_closed_clamp_ends_its_approach_and_a_hold_until_it_is_slow() {
        let mut run = programme();
        assert!(run.observe(step(0.05, 1e-3, 50e-6, 0.0)));
        assert!(run.is_closed());
        assert!(run.observe(step(2.0, 0.0, 50e-6, 0.0)));
        assert!(run.observe(step(1.0, 0.0, 50e-6, 0.0)));
        let reasons: Vec<Reason> = run.ended().map(|(_, end)| end.reason).collect();
        assert_eq!(reasons, [Reason::Closed, Reason::Time, Reason::Closed]);
        assert!(
            run.ended()
                .all(|(stage, end)| run.is_closed_below(stage, end))
        );
    }

    #[test]
    fn a_saved_place_comes_back_and_a_forged_one_is_refused() {
        let mut run = programme();
        run.observe(step(0.001, 1e-3, 11e-6, 2e5));
        run.observe(step(0.5, 1e-3, 12e-6, 3e5));
        let state = run.state();
        let mut again = programme();
        again.set_state(&state).unwrap();
        assert_eq!(again, run);
        assert_eq!(state.len(), STATE_NUMBERS + STAGE_NUMBERS);
        for (place, value) in [(0, 9.0), (1, 3.0), (1, -1.0), (STATE_NUMBERS, 17.0)] {
            let mut forged = state.clone();
            forged[place] = value;
            assert!(programme().set_state(&forged).is_err(), "{place} {value}");
        }
        assert!(programme().set_state(&state[..6]).is_err());
    }
}

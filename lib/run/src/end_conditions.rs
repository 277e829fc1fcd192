//! End conditions of a run: whether one is reached, how far a step may go, and the progress towards each.

use physics::{Cure, Scheme, StepLimit, Stop};

use crate::clock::Clock;
use crate::resolve::Setup;

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum End {
    /// The clamp has closed the bond.
    Closed,
    /// The requested time is reached.
    Time,
    /// All stages of the press programme are over.
    Programme,
    /// The time limit came before closure: the pressure limit holds the gap open.
    TimeLimit,
    /// The adhesive has set.
    Set,
    /// Stopped by the user; can be resumed.
    Interrupted,
}

/// A possible end of a run: a text in which `{}` stands for the time left, and the fraction done. Of several, the last one
/// is the latest.
pub type PossibleEnd = (&'static str, f64);

/// The end conditions of a run.
pub(crate) struct EndConditions<'a> {
    setup: &'a Setup,
    /// Time at which the adhesive sets, s.
    set: Option<f64>,
}

impl<'a> EndConditions<'a> {
    pub(crate) fn new(setup: &'a Setup) -> Self {
        Self {
            setup,
            set: setup.scene.liquid.cure.as_ref().and_then(Cure::set_at),
        }
    }

    /// The end condition that is met, if any.
    pub(crate) fn reached(&self, clock: &Clock, scheme: &dyn Scheme) -> Option<End> {
        // A tolerance for the rounding of a sum of many steps.
        let reached = |t: f64, goal: f64| t >= goal * (1.0 - 1e-12);
        if scheme.has_set() || self.set.is_some_and(|set| reached(clock.time_s, set)) {
            return Some(End::Set);
        }
        if let Some(programme) = scheme.programme() {
            return programme.is_over().then_some(End::Programme);
        }
        match self.setup.scene.stop {
            Stop::Time(t) => reached(clock.time_s, t).then_some(End::Time),
            Stop::Closed { travel_m } => {
                if clock.travel_m >= travel_m * (1.0 - 1e-9) {
                    Some(End::Closed)
                } else {
                    reached(clock.time_s, self.setup.time_limit_s).then_some(End::TimeLimit)
                }
            }
        }
    }

    /// Latest end of the run, s.
    fn latest_s(&self) -> f64 {
        let limit = self.setup.time_limit_s;
        self.set.map_or(limit, |set| limit.min(set))
    }

    /// The limits of the next step.
    pub(crate) fn limit(&self, clock: &Clock) -> StepLimit {
        if !self.setup.scene.programme.is_empty() {
            // The stages of a press programme limit their steps themselves.
            return StepLimit {
                time_s: (self.set).map_or(f64::INFINITY, |set| set - clock.time_s),
                travel_m: f64::INFINITY,
            };
        }
        StepLimit {
            time_s: self.latest_s() - clock.time_s,
            travel_m: match self.setup.scene.stop {
                Stop::Closed { travel_m } => travel_m - clock.travel_m,
                Stop::Time(_) => f64::INFINITY,
            },
        }
    }

    /// The possible ends of the run. A pressure limit slows the clamp down more and more and may stop it, so the time to
    /// closure is only a lower bound, and the time limit is the latest end.
    pub(crate) fn possible_ends(&self, clock: &Clock) -> Vec<PossibleEnd> {
        let scene = &self.setup.scene;
        let latest_s = self.latest_s();
        let time = clock.time_s / latest_s;
        let sets = latest_s < self.setup.time_limit_s;
        let Stop::Closed { travel_m } = scene.stop else {
            let time_is_up = "of the time, {} left";
            let set = "of the time until it sets, {} left at most";
            return vec![(if sets { set } else { time_is_up }, time)];
        };
        if !scene.programme.is_empty() {
            // Stages continue after closure. Steps last from microseconds to minutes, so no wall time can be predicted.
            let set = "of the time until it sets";
            return vec![(if sets { set } else { "of the programme's time" }, time)];
        }
        let latest = match sets {
            true => "of the time until it sets, {} left at most",
            false => "of the time limit, {} left at most",
        };
        let closed = clock.travel_m / travel_m;
        let (limited, speed) = (scene.clamp).map_or((false, 0.0), |clamp| {
            (clamp.max_pressure.is_some(), clamp.closing_speed)
        });
        match limited {
            true => vec![("closed, {} left at least", closed), (latest, time)],
            false if travel_m <= speed * latest_s => vec![("closed, {} left", closed)],
            false => vec![(latest, time)],
        }
    }
}

#[cfg(test)]
mod tests {
    use physics::{Clamp, Press, PressStage};

    use super::*;
    use crate::verdict::tests::setup;

    /// With a pressure limit, closure and time are separate fractions.
    #[test]
    fn a_clamp_with_a_limit_closes_at_the_earliest_and_ends_at_its_time_limit_at_the_latest() {
        let mut setup = setup();
        let clock = Clock {
            time_s: 2e-6,
            travel_m: 1e-6,
            ..Clock::default()
        };
        let mut ahead = |max_pressure, stop, limit_s, programme| {
            setup.scene.clamp = Some(Clamp {
                closing_speed: 1.0,
                max_pressure,
                pid: None,
            });
            (setup.scene.stop, setup.time_limit_s) = (stop, limit_s);
            setup.scene.programme = programme;
            EndConditions::new(&setup).possible_ends(&clock)
        };
        let hold = PressStage {
            kind: Press::Hold,
            speed: 1.0,
            pressure: None,
            contact: false,
            travel_m: None,
            slower: None,
            time_s: 8e-6,
        };
        let (closed, limit) = (
            Stop::Closed { travel_m: 4e-6 },
            "of the time limit, {} left at most",
        );
        let held = ahead(Some(1e6), closed, 8e-6, Vec::new());
        assert_eq!(held, [("closed, {} left at least", 0.25), (limit, 0.25)]);
        let free = ahead(None, closed, 8e-6, Vec::new());
        assert_eq!(free, [("closed, {} left", 0.25)]);
        let slow = ahead(None, closed, 3e-6, Vec::new());
        assert_eq!(slow, [(limit, 2.0 / 3.0)]);
        let timed = ahead(None, Stop::Time(8e-6), 8e-6, Vec::new());
        assert_eq!(timed, [("of the time, {} left", 0.25)]);
        let told = ahead(None, closed, 8e-6, vec![hold]);
        assert_eq!(told, [("of the programme's time", 0.25)]);
    }
}

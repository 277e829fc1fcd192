//! Speed of the moving body: constant, or that of a clamp under load control or a press programme.

use physics::{CONTROLLED, Clamp, PidControl, Press, PressRun, PressStep, breaks};

use crate::settings::ITERATION_TOLERANCE;

/// Control of the clamp's speed.
#[derive(Clone, Copy, Debug, Default)]
enum Control {
    /// No clamp, or one at constant speed.
    #[default]
    Free,
    /// Full speed while the pressure is below the limit; else the speed that keeps the limit.
    Limit(LoadControl),
    /// The case's PID sets the speed after each step.
    Pid(PidControl),
}

/// What sets the speed of a clamp under load control.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Sets {
    /// Its full speed: the pressure is below the limit.
    Full,
    /// The limit: the speed is an unknown.
    Limit,
    /// Its least speed: it cannot give way as fast as the limit asks.
    Least,
}

/// Load control: an upper limit on pressure.
#[derive(Clone, Copy, Debug)]
pub(super) struct LoadControl {
    /// Largest and least speed, m/s; the least is negative where the clamp may retreat.
    speeds: [f64; 2],
    /// Pressure limit, and the lower bound on its scale of error, Pa.
    pub(super) limit: f64,
    min_scale: f64,
    sets: Sets,
    /// Pressure at full speed where it exceeded the limit in this step, Pa.
    exceeded: Option<f64>,
    /// Whether the stage releases the pressure.
    releases: bool,
}

impl LoadControl {
    /// The control of the programme's current stage.
    fn of(programme: &PressRun) -> Self {
        let stage = programme.stage();
        let full = match programme.is_closed() {
            true => 0.0,
            false => stage.speed,
        };
        let releases = stage.kind == Press::Release;
        Self {
            speeds: [full, -stage.speed],
            limit: programme.set_pressure(0.0),
            // A release has a limit of zero, which is no scale for a residual.
            min_scale: ITERATION_TOLERANCE * programme.largest(),
            sets: if releases { Sets::Limit } else { Sets::Full },
            exceeded: None,
            releases,
        }
    }

    /// Scale of errors in the pressure, Pa.
    pub(super) fn scale(&self) -> f64 {
        self.limit.max(self.min_scale)
    }
}

/// The drive of the moving body.
#[derive(Clone, Debug, Default)]
pub(super) struct ClampDrive {
    control: Control,
    /// The press programme that sets the control, if there is one.
    pub(super) programme: Option<PressRun>,
    /// Closing speed now, m/s.
    pub(super) speed: f64,
    /// Number of steps that exceeded the pressure limit, and the pressure of the last step if it did, Pa.
    pub(super) violations: (u64, f64),
}

impl ClampDrive {
    /// `acoustic_time` is how long sound takes to cross a cell, s; `full` the speed of a body that no clamp moves, m/s.
    pub(super) fn new(
        clamp: Option<Clamp>,
        programme: Option<PressRun>,
        acoustic_time: f64,
        full: f64,
    ) -> Self {
        let limited = clamp.and_then(|clamp| Some((clamp, clamp.max_pressure?)));
        let control = match (&programme, limited) {
            (Some(programme), _) => Control::Limit(LoadControl::of(programme)),
            (None, Some((clamp, _))) if clamp.pid.is_some() => {
                Control::Pid(PidControl::new(clamp, acoustic_time))
            }
            (None, Some((clamp, limit))) => Control::Limit(LoadControl {
                speeds: [clamp.closing_speed, 0.0],
                limit,
                min_scale: 0.0,
                sets: Sets::Full,
                exceeded: None,
                releases: false,
            }),
            _ => Control::Free,
        };
        let first = |programme: &PressRun| programme.stage().speed;
        Self {
            control,
            speed: programme.as_ref().map_or(full, first),
            programme,
            violations: (0, 0.0),
        }
    }

    /// Begins a step: sets the pressure limit to that of the programme `ahead` (s) of now. Under a limit the estimated speed
    /// changes in proportion, as that of viscous flow does. Returns whether a constant limit sets the speed.
    pub(super) fn begin(&mut self, ahead: f64) -> bool {
        let Control::Limit(control) = &mut self.control else {
            return false;
        };
        control.exceeded = None;
        if control.sets == Sets::Least {
            control.sets = Sets::Limit;
        }
        let Some(programme) = &self.programme else {
            return control.sets == Sets::Limit;
        };
        let limit = programme.set_pressure(ahead);
        let factor = limit / control.limit;
        control.limit = limit;
        if control.sets == Sets::Limit && factor > 0.0 && factor.is_finite() {
            self.speed = (self.speed * factor).min(control.speeds[0]);
        }
        control.sets == Sets::Limit && factor == 1.0
    }

    /// The load control if the limit sets the speed.
    pub(super) fn held(&self) -> Option<LoadControl> {
        match self.control {
            Control::Limit(control) if control.sets == Sets::Limit => Some(control),
            _ => None,
        }
    }

    /// Whether a `pressure` (Pa) and a `speed` (m/s) found agree with what sets the speed. If not, the other bound sets it, and
    /// the speed is estimated. The bounds of the speed are the full one and zero without a programme: compressed liquid does
    /// not open the clamp.
    pub(super) fn agrees(&mut self, pressure: f64, speed: f64) -> bool {
        let Control::Limit(control) = &mut self.control else {
            return true;
        };
        let [full, least] = control.speeds;
        match control.sets {
            Sets::Full if pressure > control.limit + CONTROLLED * control.scale() => {
                control.exceeded.get_or_insert(pressure);
                control.sets = Sets::Limit;
                self.speed *= control.limit / pressure;
            }
            Sets::Limit if speed >= full => (control.sets, self.speed) = (Sets::Full, full),
            Sets::Limit if speed < least => (control.sets, self.speed) = (Sets::Least, least),
            Sets::Limit => {
                self.speed = speed;
                return true;
            }
            Sets::Full | Sets::Least => return true,
        }
        false
    }

    /// The limit and the pressure at full speed, Pa, of a step that began at full speed and had the `pressure` found.
    pub(super) fn at_full_speed(&self, pressure: f64) -> Option<[f64; 2]> {
        match self.control {
            Control::Limit(control) if control.limit.is_finite() && !control.releases => {
                match (control.sets, control.exceeded) {
                    (_, Some(exceeded)) => Some([control.limit, exceeded]),
                    (Sets::Full, None) => Some([control.limit, pressure]),
                    _ => None,
                }
            }
            _ => None,
        }
    }

    /// Change of the pressure from the middle of a step of `dt` (s) to its end where the control sets it, Pa.
    pub(super) fn change_to_end(&self, dt: f64) -> Option<f64> {
        match (&self.control, &self.programme) {
            (Control::Limit(control), Some(programme)) if control.sets == Sets::Limit => {
                Some(programme.set_pressure(dt) - control.limit)
            }
            (Control::Pid(_), _) => Some(0.0),
            (Control::Limit(control), None) if control.sets == Sets::Limit => Some(0.0),
            _ => None,
        }
    }

    /// Updates the control by the `pressure` (Pa) at the end of a step of `dt` (s), after which the clamp has travelled
    /// `travel` (m). Returns whether a stage of the programme ended.
    pub(super) fn observe(&mut self, pressure: f64, dt: f64, travel: f64) -> bool {
        let bounds = match &self.control {
            // A release has no limit to exceed: expanding air keeps pressing on a retreating body.
            Control::Limit(control) if control.releases => None,
            Control::Limit(control) => {
                let programme = self.programme.as_ref();
                let limit = programme.map_or(control.limit, |run| run.set_pressure(dt));
                Some((limit, control.scale()))
            }
            Control::Pid(pid) => pid.limit().map(|limit| (limit, limit)),
            Control::Free => None,
        };
        if bounds.is_some_and(|(limit, scale)| breaks(pressure, limit, scale)) {
            self.violations = (self.violations.0 + 1, pressure);
        } else {
            self.violations.1 = 0.0;
        }
        match (&mut self.control, &mut self.programme) {
            (Control::Pid(pid), _) => {
                pid.observe(pressure, dt);
                self.speed = pid.speed();
            }
            (Control::Limit(control), Some(programme)) => {
                let step = PressStep {
                    dt_s: dt,
                    speed: self.speed,
                    travel_m: travel,
                    pressure,
                };
                let next = programme.observe(step);
                let before = *control;
                *control = LoadControl::of(programme);
                let kind = programme.stage().kind;
                let held = before.sets != Sets::Full;
                if !next || held && kind != Press::Approach && before.limit > 0.0 {
                    // The speed and the limit of the last step are the estimate for the next.
                    if held {
                        control.sets = before.sets;
                    }
                    control.limit = before.limit;
                    self.speed = self.speed.min(control.speeds[0]);
                } else {
                    self.speed = match kind {
                        Press::Release => 0.0,
                        _ => control.speeds[0],
                    };
                }
                return next;
            }
            _ => {}
        }
        false
    }

    /// The state for checkpoints.
    pub(super) fn state(&self) -> [f64; 7] {
        let control = match (&self.control, &self.programme) {
            (Control::Pid(pid), _) => pid.state(),
            (Control::Limit(control), Some(_)) if control.limit.is_finite() => {
                [control.limit, 0.0, 0.0]
            }
            _ => [0.0; 3],
        };
        let held = match self.control {
            Control::Limit(control) => control.sets != Sets::Full,
            _ => false,
        };
        let active = f64::from(u8::from(held));
        let (steps, pressure) = (self.violations.0 as f64, self.violations.1);
        [
            self.speed, active, steps, pressure, control[0], control[1], control[2],
        ]
    }

    /// Restores a saved state; that of the programme must have been restored before.
    pub(super) fn set_state(&mut self, [speed, was_active, steps, pressure, a, b, c]: [f64; 7]) {
        (self.speed, self.violations) = (speed, (steps as u64, pressure));
        match (&mut self.control, &self.programme) {
            (Control::Pid(pid), _) => pid.set_state([a, b, c]),
            (Control::Limit(control), programme) => {
                if let Some(programme) = programme {
                    *control = LoadControl::of(programme);
                    control.limit = a;
                }
                control.sets = match was_active {
                    0.0 => Sets::Full,
                    _ => Sets::Limit,
                };
            }
            (Control::Free, _) => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use physics::PressStage;

    use super::*;

    #[test]
    fn the_clamp_is_held_above_half_a_percent_and_never_opens() {
        let clamp = Clamp {
            closing_speed: 2.0,
            max_pressure: Some(1e6),
            pid: None,
        };
        let mut drive = ClampDrive::new(Some(clamp), None, 1e-9, 2.0);
        drive.begin(0.0);
        assert!(drive.agrees(1.004e6, 2.0) && drive.held().is_none());
        assert!(!drive.agrees(1.006e6, 2.0));
        assert_eq!(drive.held().map(|control| control.limit), Some(1e6));
        assert!(!drive.agrees(1e6, -1.0) && drive.held().is_none());
        assert_eq!(drive.speed, 0.0);
        drive.begin(0.0);
        assert!(drive.held().is_some() && !drive.agrees(1e6, 3.0));
        assert_eq!((drive.speed, drive.held().is_none()), (2.0, true));
        let broken = [1.019e6, 1.021e6, 1.03e6, 1e6].map(|pressure| {
            drive.observe(pressure, 1e-9, 0.0);
            drive.violations
        });
        assert_eq!(broken, [(0, 0.0), (1, 1.021e6), (2, 1.03e6), (2, 0.0)]);
    }

    /// Expanding air presses on a body that retreats at full speed; in a hold the same pressure exceeds the limit.
    #[test]
    fn a_release_has_no_limit_to_break() {
        let broken = [Press::Hold, Press::Release].map(|kind| {
            let stage = PressStage {
                kind,
                speed: 1e-3,
                pressure: (kind == Press::Hold).then_some(1e6),
                time_s: 10.0,
                travel_m: None,
                contact: false,
                slower: None,
            };
            let programme = PressRun::new(vec![stage], 1e-5);
            let mut drive = ClampDrive::new(None, Some(programme), 1e-9, 1e-3);
            drive.begin(1.0);
            drive.agrees(2e6, -2e-3);
            drive.observe(2e6, 1.0, 0.0);
            drive.violations.0
        });
        assert_eq!(broken, [1, 0]);
    }
}

//! How the bodies move: constant speeds, and the clamp under load control.

use physics::{Clamp, Motion, PidControl, breaks};

use crate::stages::Present;

/// Relative excess over the pressure limit that is tolerated.
const TOLERANCE: f64 = 5e-3;

/// Speed of the clamp.
#[derive(Clone, Copy, Debug)]
enum Control {
    /// Nothing is clamped, or at constant speed.
    Free,
    /// At full speed until that would exceed the limit (Pa); held at the limit then, and at full
    /// speed again where that no longer reaches it.
    Limit {
        clamp: Clamp,
        limit: f64,
        held: bool,
    },
    /// By the case's PID, after each step.
    Pid(PidControl),
}

/// Motion of all bodies.
#[derive(Clone, Debug)]
pub(super) struct Drive {
    motions: Vec<Motion>,
    control: Control,
    /// Closing speed now, m/s.
    pub(super) speed: f64,
    /// Steps that did not keep the pressure limit, and the pressure of the last step if it is one, Pa.
    pub(super) broken: (u64, f64),
}

impl Drive {
    /// `acoustic_time` is how long sound takes to cross a cell, s.
    pub(super) fn new(
        motions: Vec<Motion>,
        clamp: Option<Clamp>,
        acoustic_time: f64,
        present: Present,
    ) -> Self {
        let limited = clamp.and_then(|clamp| Some((clamp, clamp.max_pressure?)));
        let control = match limited {
            Some((clamp, _)) if present.pid => Control::Pid(PidControl::new(clamp, acoustic_time)),
            Some((clamp, limit)) if present.load => Control::Limit {
                clamp,
                limit,
                held: false,
            },
            _ => Control::Free,
        };
        Self {
            motions,
            control,
            speed: clamp.map_or(0.0, |c| c.closing_speed),
            broken: (0, 0.0),
        }
    }

    /// How each body moves.
    pub(super) fn motions(&self) -> &[Motion] {
        &self.motions
    }

    /// Velocities of the bodies, m/s.
    pub(super) fn velocities(&self) -> Vec<[f64; 3]> {
        (self.motions.iter())
            .map(|motion| match motion {
                Motion::Fixed => [0.0; 3],
                Motion::Constant(v) => *v,
                Motion::Clamped => [0.0, -self.speed, 0.0],
            })
            .collect()
    }

    /// Index of the body that the clamp moves.
    pub(super) fn clamped(&self) -> Option<usize> {
        self.motions.iter().position(|m| *m == Motion::Clamped)
    }

    /// The pressure (Pa) at which the clamp is held, its speed being unknown.
    pub(super) fn held(&self) -> Option<f64> {
        match self.control {
            Control::Limit {
                limit, held: true, ..
            } => Some(limit),
            _ => None,
        }
    }

    /// The limit (Pa) where `pressure` (Pa) at full speed exceeds it: the clamp is held from now
    /// on, and `speed` is a guess at its speed.
    pub(super) fn exceeded(&mut self, pressure: f64) -> Option<f64> {
        let Control::Limit { limit, held, .. } = &mut self.control else {
            return None;
        };
        if *held || pressure <= *limit * (1.0 + TOLERANCE) {
            return None;
        }
        *held = true;
        self.speed *= *limit / pressure;
        Some(*limit)
    }

    /// Takes the speed (m/s) that the limit asks for; `false` where the clamp cannot follow it and
    /// moves at the nearest speed that it can: it goes no faster than at full speed, and stands where
    /// compressed liquid would open it.
    pub(super) fn follow(&mut self, speed: f64) -> bool {
        let Control::Limit { clamp, held, .. } = &mut self.control else {
            return true;
        };
        let full = clamp.closing_speed;
        *held = speed < full;
        self.speed = speed.clamp(0.0, full);
        self.speed == speed
    }

    /// Takes in the pressure (Pa) of a step of `dt` (s) that is over.
    pub(super) fn observe(&mut self, pressure: f64, dt: f64) {
        if let Control::Pid(pid) = &mut self.control {
            pid.observe(pressure, dt);
            self.speed = pid.speed();
        }
        if self.limit().is_some_and(|limit| breaks(pressure, limit)) {
            self.broken = (self.broken.0 + 1, pressure);
        } else {
            self.broken.1 = 0.0;
        }
    }

    /// The pressure limit, Pa.
    fn limit(&self) -> Option<f64> {
        match &self.control {
            Control::Limit { limit, .. } => Some(*limit),
            Control::Pid(pid) => pid.limit(),
            Control::Free => None,
        }
    }

    /// The changing part, for checkpoints.
    pub(super) fn state(&self) -> [f64; 7] {
        let pid = match &self.control {
            Control::Pid(pid) => pid.state(),
            _ => [0.0; 3],
        };
        let held = f64::from(u8::from(self.held().is_some()));
        let (steps, pressure) = (self.broken.0 as f64, self.broken.1);
        [self.speed, held, steps, pressure, pid[0], pid[1], pid[2]]
    }

    /// Goes back to a saved changing part.
    pub(super) fn set_state(&mut self, [speed, was_held, steps, pressure, a, b, c]: [f64; 7]) {
        (self.speed, self.broken) = (speed, (steps as u64, pressure));
        match &mut self.control {
            Control::Pid(pid) => pid.set_state([a, b, c]),
            Control::Limit { held, .. } => *held = was_held != 0.0,
            Control::Free => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_clamp_is_held_above_half_a_percent_and_never_opens() {
        let clamp = Clamp {
            closing_speed: 2.0,
            max_pressure: Some(1e6),
            pid: None,
        };
        let present = Present {
            friction: false,
            table: false,
            load: true,
            pid: false,
        };
        let mut drive = Drive::new(vec![Motion::Clamped], Some(clamp), 1e-9, present);
        assert_eq!(drive.exceeded(1.004e6), None);
        assert_eq!(drive.exceeded(1.006e6), Some(1e6));
        assert!(!drive.follow(-1.0));
        assert_eq!((drive.speed, drive.held()), (0.0, Some(1e6)));
        let broken = [1.019e6, 1.021e6, 1.03e6, 1e6].map(|pressure| {
            drive.observe(pressure, 1e-9);
            drive.broken
        });
        assert_eq!(broken, [(0, 0.0), (1, 1.021e6), (2, 1.03e6), (2, 0.0)]);
    }
}

//! How the bodies move: constant speeds, and the clamp under load control.

use physics::{Clamp, LinearRule, Motion, PidControl};

/// Pressure error, relative, that the linear rule leaves.
const TOLERANCE: f64 = 2e-3;

/// Speed of the clamp.
#[derive(Clone, Copy, Debug)]
enum Control {
    /// Nothing is clamped, or at constant speed.
    Free,
    /// The pressure is linear in the speed within a step.
    Linear(LinearRule),
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
}

impl Drive {
    /// `acoustic_time` is the unit of time of PID gains, s.
    pub(super) fn new(motions: Vec<Motion>, clamp: Option<Clamp>, acoustic_time: f64) -> Self {
        let control = match clamp {
            Some(clamp) if clamp.max_pressure.is_some() => match clamp.pid {
                Some(_) => Control::Pid(PidControl::new(clamp, acoustic_time)),
                None => Control::Linear(LinearRule::new(clamp)),
            },
            _ => Control::Free,
        };
        Self {
            motions,
            control,
            speed: clamp.map_or(0.0, |c| c.closing_speed),
        }
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

    /// Corrects the speed within a step that gave `pressure` (Pa); the factor by which it
    /// changed, if it did.
    pub(super) fn correct(&mut self, pressure: f64) -> Option<f64> {
        let Control::Linear(rule) = &self.control else {
            return None;
        };
        let speed = rule.correct(self.speed, pressure, TOLERANCE)?;
        let factor = speed / self.speed;
        self.speed = speed;
        (factor.is_finite() && (factor - 1.0).abs() > 1e-9).then_some(factor)
    }

    /// Takes in the pressure (Pa) of a step of `dt` (s) that is over.
    pub(super) fn observe(&mut self, pressure: f64, dt: f64) {
        if let Control::Pid(pid) = &mut self.control {
            pid.observe(pressure, dt);
            self.speed = pid.speed();
        }
    }

    /// The changing part, for checkpoints.
    pub(super) fn state(&self) -> [f64; 4] {
        let pid = match &self.control {
            Control::Pid(pid) => pid.state(),
            _ => [0.0; 3],
        };
        [self.speed, pid[0], pid[1], pid[2]]
    }

    /// Goes back to a saved changing part.
    pub(super) fn set_state(&mut self, [speed, a, b, c]: [f64; 4]) {
        self.speed = speed;
        if let Control::Pid(pid) = &mut self.control {
            pid.set_state([a, b, c]);
        }
    }
}

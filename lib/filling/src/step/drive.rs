//! How the bodies move: constant speeds, and the clamp under load control.

use physics::{Clamp, LinearRule, Motion, PidControl};

/// Pressure error, relative, that the linear rule leaves.
const TOLERANCE: f64 = 5e-3;
/// Slowest speed under load control, as part of the closing speed: from rest the rule could not
/// speed up again.
const SLOWEST: f64 = 1e-6;

/// Speed of the clamp.
#[derive(Clone, Copy, Debug)]
enum Control {
    /// Nothing is clamped, or at constant speed.
    Free,
    /// The pressure is linear in the speed within a step.
    Linear(LinearRule, Clamp),
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
    /// Speed and pressure of the solve before, within a step.
    tried: Option<[f64; 2]>,
    /// Rise of the pressure with the speed, Pa s/m; 0 when not known.
    slope: f64,
}

impl Drive {
    /// `acoustic_time` is how long sound takes to cross a cell, s.
    pub(super) fn new(motions: Vec<Motion>, clamp: Option<Clamp>, acoustic_time: f64) -> Self {
        let control = match clamp {
            Some(clamp) if clamp.max_pressure.is_some() => match clamp.pid {
                Some(_) => Control::Pid(PidControl::new(clamp, acoustic_time)),
                None => Control::Linear(LinearRule::new(clamp), clamp),
            },
            _ => Control::Free,
        };
        Self {
            motions,
            control,
            speed: clamp.map_or(0.0, |c| c.closing_speed),
            tried: None,
            slope: 0.0,
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
    ///
    /// The pressure is a + b V: b V of the flow, and a what the liquid's compression keeps of
    /// the step before. Where only one solve is known, b is the step before's, or a is zero.
    pub(super) fn correct(&mut self, pressure: f64) -> Option<f64> {
        let Control::Linear(rule, clamp) = &self.control else {
            return None;
        };
        if let Some([speed, before]) = self.tried {
            let slope = (pressure - before) / (self.speed - speed);
            if slope > 0.0 && slope.is_finite() {
                self.slope = slope;
            }
        }
        let proportional = rule.correct(self.speed, pressure, TOLERANCE)?;
        let wanted = match clamp.max_pressure {
            Some(limit) if self.slope > 0.0 => self.speed + (limit - pressure) / self.slope,
            _ => proportional,
        };
        let speed = wanted.clamp(SLOWEST * clamp.closing_speed, clamp.closing_speed);
        let factor = speed / self.speed;
        if (factor - 1.0).abs() < 1e-6 {
            return None;
        }
        self.tried = Some([self.speed, pressure]);
        self.speed = speed;
        Some(factor)
    }

    /// Takes in the pressure (Pa) of a step of `dt` (s) that is over.
    pub(super) fn observe(&mut self, pressure: f64, dt: f64) {
        self.tried = None;
        if let Control::Pid(pid) = &mut self.control {
            pid.observe(pressure, dt);
            self.speed = pid.speed();
        }
    }

    /// The changing part, for checkpoints.
    pub(super) fn state(&self) -> [f64; 5] {
        let pid = match &self.control {
            Control::Pid(pid) => pid.state(),
            _ => [0.0; 3],
        };
        [self.speed, self.slope, pid[0], pid[1], pid[2]]
    }

    /// Goes back to a saved changing part.
    pub(super) fn set_state(&mut self, [speed, slope, a, b, c]: [f64; 5]) {
        (self.speed, self.slope) = (speed, slope);
        if let Control::Pid(pid) = &mut self.control {
            pid.set_state([a, b, c]);
        }
    }
}

//! The clamp and its load controller.

/// Drive of the upper adherend.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clamp {
    /// Largest closing speed, m/s.
    pub closing_speed: f64,
    /// Pressure limit, Pa; `None`: constant speed.
    pub max_pressure: Option<f64>,
    /// Gains of the PID controller; `None`: the default of the scheme.
    pub pid: Option<Pid>,
}

/// Dimensionless gains of the load controller. The error is (p_max - p)/p_max, the output a factor on the closing speed.
/// Time is in units of [`PidControl`]'s reference time, so that gains do not depend on the time step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pid {
    /// Proportional gain.
    pub kp: f64,
    /// Integral gain per reference time.
    pub ki: f64,
    /// Derivative gain times reference time.
    pub kd: f64,
}

impl Default for Pid {
    /// The gains of the six runs: integral only. The contact force is an impulse over the step and responds to a change of
    /// speed at once, so a proportional gain of 0.3 doubles the overshoot.
    fn default() -> Self {
        let (kp, ki, kd) = (0.0, 0.02, 0.0);
        Self { kp, ki, kd }
    }
}

/// Reference time of the gains, over the time in which sound crosses a cell. The integral acts within 1/ki of it, 2.4 ns
/// with cells of 2.9 um. It must follow a resistance that rises e-fold within 1.6 um of travel in a real bond line and, in
/// the explicit scheme, 1.75-fold within 60 nm where a wall crosses nodes.
const REFERENCE_TIME: f64 = 0.015;

/// Least integral: fraction of the closing speed from which a standing clamp recovers.
const LEAST_INTEGRAL: f64 = 1e-6;

/// Relative excess over the pressure limit that still counts as keeping it.
const TOLERATED_EXCESS: f64 = 0.02;

/// Whether `pressure` (Pa) on the clamp's body breaks the `limit` (Pa). The tolerated excess is relative to `scale` (Pa): the
/// limit itself, or more if the limit is almost zero.
pub fn breaks(pressure: f64, limit: f64, scale: f64) -> bool {
    pressure > limit + TOLERATED_EXCESS * scale
}

/// A clause for a run in whose last step `pressure` (Pa) breaks the limit.
pub fn broken(pressure: f64) -> String {
    format!(
        "liquid presses on the clamp's body with {pressure:.3e} Pa in the last step, above its \
         max_pressure: the clamp has stopped and cannot move back, while other bodies, a force, inertia or \
         compression of the liquid maintain the pressure; a later end or a lower closing_speed may help"
    )
}

/// PID control of the closing speed (the paper's section 2.2), on the logarithm of the speed.
///
/// Pressure is resistance times speed, and a press slows down by decades as its resistance rises. The gain of a controller
/// that adds to the speed would grow as much, and far above the limit it would stall or chatter. The integral lies within
/// [1e-6, 1] and so does not wind up. At its least value the clamp stands while the limit is exceeded, because in sealed
/// liquid even a millionth of the speed would raise the pressure for ever.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PidControl {
    clamp: Clamp,
    gains: Pid,
    reference_time: f64,
    integral: f64,
    last_error: f64,
    speed: f64,
}

impl PidControl {
    /// A controller at full speed; sound crosses a cell in `transit` (s).
    pub fn new(clamp: Clamp, transit: f64) -> Self {
        Self {
            clamp,
            gains: clamp.pid.unwrap_or_default(),
            reference_time: REFERENCE_TIME * transit,
            integral: 1.0,
            last_error: 1.0,
            speed: clamp.closing_speed,
        }
    }

    /// Speed for the next step, m/s.
    pub fn speed(&self) -> f64 {
        self.speed
    }

    /// The pressure limit, Pa.
    pub fn limit(&self) -> Option<f64> {
        self.clamp.max_pressure
    }

    /// Updates the speed by the pressure (Pa) in a step of `dt` (s).
    pub fn observe(&mut self, pressure: f64, dt: f64) {
        let Some(limit) = self.clamp.max_pressure else {
            return;
        };
        let error = 1.0 - pressure / limit;
        let tau = dt / self.reference_time;
        // One step changes the speed by a factor of 1.65 at most, so that long steps do not make the loop oscillate.
        let step = (self.gains.ki * tau * error).clamp(-0.5, 0.5);
        self.integral = (self.integral * step.exp()).clamp(LEAST_INTEGRAL, 1.0);
        let derivative = self.gains.kd * (error - self.last_error) / tau;
        let factor = 1.0 + self.gains.kp * error.min(0.0) + derivative;
        self.last_error = error;
        self.speed = match self.stands() {
            true => 0.0,
            false => self.clamp.closing_speed * (self.integral * factor).clamp(0.0, 1.0),
        };
    }

    /// Whether the clamp stands: the integral is at its least and the limit exceeded.
    fn stands(&self) -> bool {
        self.integral <= LEAST_INTEGRAL && self.last_error < 0.0
    }

    /// The pressure (Pa) of the last step, if the clamp stands and the pressure breaks the limit.
    pub fn overwhelmed(&self) -> Option<f64> {
        let limit = self.clamp.max_pressure?;
        let pressure = limit * (1.0 - self.last_error);
        (self.stands() && breaks(pressure, limit, limit)).then_some(pressure)
    }

    /// The state for checkpoints.
    pub fn state(&self) -> [f64; 3] {
        [self.integral, self.last_error, self.speed]
    }

    /// Restores a saved state.
    pub fn set_state(&mut self, [integral, last_error, speed]: [f64; 3]) {
        (self.integral, self.last_error, self.speed) = (integral, last_error, speed);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CLAMP: Clamp = Clamp {
        closing_speed: 1.0,
        max_pressure: Some(2.5e6),
        pid: None,
    };

    fn control() -> PidControl {
        PidControl::new(CLAMP, 2.9e-6 / 913.0)
    }

    /// Controlled system: p = R v behind a lag; R rises e-fold per 1.6 um of travel, as measured on a real bond line. Returns
    /// the largest and the last pressure over the limit.
    fn closing(dt: f64, lag: f64) -> (f64, f64) {
        let mut control = control();
        let (mut p, mut travel, mut largest) = (0.0_f64, 0.0, 0.0_f64);
        for _ in 0..(30e-6 / dt) as usize {
            let target = 0.265e6 * f64::exp(travel / 1.6e-6) * control.speed();
            p += (target - p) * (dt / lag).min(1.0);
            travel += control.speed() * dt;
            control.observe(p, dt);
            assert!((0.0..=1.0).contains(&control.speed()));
            largest = largest.max(p);
        }
        (largest / 2.5e6, p / 2.5e6)
    }

    #[test]
    fn holds_the_set_pressure_without_overshoot() {
        for dt in [0.5e-9, 1e-9, 1.5e-9] {
            for lag in [0.02e-6, 0.05e-6, 0.1e-6] {
                let (largest, late) = closing(dt, lag);
                println!("dt {dt:e} s, lag {lag:e} s: largest {largest:.4}, late {late:.4}");
                assert!(largest < 1.02 && (late - 1.0).abs() < 0.005);
            }
        }
    }

    /// A controller that adds the error to the speed would hold a pressure far above the limit for ever.
    #[test]
    fn comes_back_from_far_above_the_limit_and_from_a_thousandth_of_the_speed() {
        let resistance = 1e3 * 2.5e6;
        let mut control = control();
        let mut p = 14.0 * 2.5e6;
        for _ in 0..1000 {
            p += (resistance * control.speed() - p) * 0.02;
            control.observe(p, 1e-9);
        }
        let (pressure, speed) = (p / 2.5e6, control.speed());
        println!("{pressure:.4} of the limit at {speed:.3e} m/s");
        assert!((pressure - 1.0).abs() < 0.02 && (1e3 * speed - 1.0).abs() < 0.02);
    }

    #[test]
    fn does_not_wind_up() {
        let mut control = control();
        for _ in 0..1_000_000 {
            control.observe(0.0, 1e-9);
        }
        let mut steps = 0;
        while control.speed() > 0.9 {
            control.observe(1.5 * 2.5e6, 1e-9);
            steps += 1;
        }
        assert!(steps < 10, "{steps} steps to slow down by 10 %");
    }

    /// The clamp must stand, not creep on at a millionth of its speed.
    #[test]
    fn stands_where_liquid_gives_way_to_nothing_and_comes_back() {
        let mut control = control();
        for _ in 0..4000 {
            control.observe(1.5 * 2.5e6, 1e-9);
        }
        assert_eq!(control.speed(), 0.0);
        assert_eq!(control.overwhelmed(), Some(1.5 * 2.5e6));
        control.observe(1.01 * 2.5e6, 1e-9);
        assert_eq!((control.speed(), control.overwhelmed()), (0.0, None));
        for _ in 0..10_000 {
            control.observe(0.5 * 2.5e6, 1e-9);
        }
        assert!(control.speed() > 0.9, "{}", control.speed());
    }

    #[test]
    fn without_a_limit_the_speed_is_constant() {
        let mut control = control();
        control.clamp.max_pressure = None;
        control.observe(1e12, 1e-9);
        assert_eq!(control.speed(), 1.0);
    }
}

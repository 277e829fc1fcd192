//! The clamp and its load controller.

/// How the upper adherend is driven.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clamp {
    /// Largest closing speed, m/s.
    pub closing_speed: f64,
    /// Pressure not to be exceeded, Pa; `None`: constant speed.
    pub max_pressure: Option<f64>,
    /// Gains of the PID when the case asks for one; the scheme has its own default otherwise.
    pub pid: Option<Pid>,
}

/// Gains of the load controller, dimensionless: the error is (p_max - p)/p_max, the output a
/// factor of the closing speed, and time counts in units of [`PidControl`]'s
/// reference time, so that gains do not depend on the time step.
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
    /// The gains of the six runs: integral alone. The force of contact is an impulse over the step
    /// and answers a change of speed at once: a proportional gain of 0.3 doubles the overshoot.
    fn default() -> Self {
        let (kp, ki, kd) = (0.0, 0.02, 0.0);
        Self { kp, ki, kd }
    }
}

/// Unit of time of the gains over the time sound takes to cross a cell. The resistance of a real
/// bond line rises e-fold within 1.6 um of travel, that of the explicit scheme 1.75-fold within
/// 60 nm where a wall crosses nodes: the integral acts within 1/ki units, 2.4 ns at cells of 2.9 um.
const REFERENCE_TIME: f64 = 0.015;

/// Least integral: the speed from which a clamp that was held comes back.
const LEAST: f64 = 1e-6;

/// Relative excess over the pressure limit from which a step does not keep it.
const BROKEN: f64 = 0.02;

/// Whether `pressure` (Pa) on the clamp's body is more than a clamp that keeps its `limit` (Pa) leaves,
/// measured by `scale` (Pa): the limit itself, where that is not next to nothing.
pub fn breaks(pressure: f64, limit: f64, scale: f64) -> bool {
    pressure > limit + BROKEN * scale
}

/// What is wrong with a run in whose last step `pressure` (Pa) breaks the limit, a clause.
pub fn broken(pressure: f64) -> String {
    format!(
        "liquid presses the clamp's body with {pressure:.3e} Pa in the last step, above its \
         max_pressure: the clamp stands and does not go back, and other bodies, a force, the \
         liquid's own inertia or its compression press on; a later end or a lower closing_speed may help"
    )
}

/// PID control of the closing speed (the paper's section 2.2), on the logarithm of the speed.
///
/// Pressure is resistance times speed, and a press slows down by decades as its resistance
/// rises: a controller that adds to the speed has a gain that grows by as much, and one of a
/// pressure far above the limit either stands still there or chatters. The integral lies within
/// [1e-6, 1] and so does not wind up; at its least the clamp stands while the limit is exceeded, because
/// in sealed liquid even a millionth of the speed would press on for good.
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
    /// A controller at full speed for cells that sound crosses in `transit` seconds.
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

    /// Takes in the pressure (Pa) measured over a step of `dt` (s).
    pub fn observe(&mut self, pressure: f64, dt: f64) {
        let Some(limit) = self.clamp.max_pressure else {
            return;
        };
        let error = 1.0 - pressure / limit;
        let tau = dt / self.reference_time;
        // One step changes the speed by a factor of 1.65 at most: long steps must not make the loop ring.
        let step = (self.gains.ki * tau * error).clamp(-0.5, 0.5);
        self.integral = (self.integral * step.exp()).clamp(LEAST, 1.0);
        let derivative = self.gains.kd * (error - self.last_error) / tau;
        let factor = 1.0 + self.gains.kp * error.min(0.0) + derivative;
        self.last_error = error;
        self.speed = match self.stands() {
            true => 0.0,
            false => self.clamp.closing_speed * (self.integral * factor).clamp(0.0, 1.0),
        };
    }

    /// Whether the clamp stands, as slow as it can be, above its limit.
    fn stands(&self) -> bool {
        self.integral <= LEAST && self.last_error < 0.0
    }

    /// The pressure (Pa) of the last step, if the clamp stands and that breaks the limit.
    pub fn overwhelmed(&self) -> Option<f64> {
        let limit = self.clamp.max_pressure?;
        let pressure = limit * (1.0 - self.last_error);
        (self.stands() && breaks(pressure, limit, limit)).then_some(pressure)
    }

    /// The changing part, for checkpoints.
    pub fn state(&self) -> [f64; 3] {
        [self.integral, self.last_error, self.speed]
    }

    /// Goes back to a saved changing part.
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

    /// Plant: p = R v, R rising e-fold per 1.6 um of travel as measured on a real bond line,
    /// behind a lag. Returns the largest and the last pressure over the limit.
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

    /// Added to the speed, the error of a pressure far above the limit froze the integral where the
    /// output was just above zero: 1.3 to 14 times the limit were held for good.
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

    /// It went on at a millionth of its speed for good.
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

//! The choices that a case has.

/// Cells that liquid crosses in a step at most, in jets too: the mesh ends two cells off the liquid.
pub(crate) const LARGEST_CFL: f64 = 1.5;

/// Part by which a volume or a pressure may be off its law, and a step off the end of its travel, when passes end: the default
/// tolerance of the solver. Nearer, steps would be solved again for what the solution does not know.
pub(crate) const MISSED: f64 = 1e-3;

/// Settings of the implicit scheme.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Cells that the fastest liquid crosses in a step.
    pub cfl: f64,
    /// Relative residual of the coupled solve.
    pub tolerance: f64,
    /// Absolute pressure of the air around, Pa: air that liquid closes off has pressures. `None`: all is at that around.
    pub air_pressure: Option<f64>,
    /// Time in which what a pocket of fixed volume has above that falls to 1/e of it, s.
    pub air_leak_time: f64,
    /// What the cosine of the contact angle loses by each unit of the capillary number of a front that advances.
    pub dynamic_angle: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            cfl: 1.0,
            tolerance: 1e-3,
            air_pressure: None,
            air_leak_time: f64::INFINITY,
            dynamic_angle: 0.0,
        }
    }
}

impl Settings {
    /// Says what is wrong with the settings, if anything.
    ///
    /// # Errors
    /// A sentence that names the setting and what would be accepted.
    pub fn check(&self) -> Result<(), String> {
        if !(self.cfl > 0.0 && self.cfl <= LARGEST_CFL) {
            return Err(format!(
                "cfl is {:?}: the implicit scheme takes more than 0 and at most {LARGEST_CFL} cells per step",
                self.cfl
            ));
        }
        if !(self.tolerance >= 1e-8 && self.tolerance <= 1e-2) {
            return Err(format!(
                "the solver tolerance is {:?}: it must lie between 1e-8 and 1e-2",
                self.tolerance
            ));
        }
        if !(self.dynamic_angle >= 0.0 && self.dynamic_angle.is_finite()) {
            return Err(format!(
                "dynamic_angle is {:?}: it is zero or more",
                self.dynamic_angle
            ));
        }
        let positive = |x: f64| x > 0.0;
        if !(self.air_pressure.is_none_or(positive) && positive(self.air_leak_time)) {
            return Err("the pressure and the leak time of the air must be above zero".into());
        }
        Ok(())
    }
}

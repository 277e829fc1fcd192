//! What of the implicit scheme a case chooses.

/// Settings of the implicit scheme.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Cells that the fastest liquid or body crosses per step.
    pub cfl: f64,
    /// Relative residual of the coupled solve: 1e-3 keeps forces to 0.1-0.3 %, 1e-4 is for
    /// verification.
    pub tolerance: f64,
    /// Absolute pressure (Pa) of the air around, where air that is closed off has a pressure of its own.
    pub air_pressure: Option<f64>,
    /// Time (s) in which the excess pressure of such air falls to 1/e through its walls; infinite where
    /// they are tight.
    pub air_leak_time: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            cfl: 1.0,
            tolerance: 1e-3,
            air_pressure: None,
            air_leak_time: f64::INFINITY,
        }
    }
}

impl Settings {
    /// Says what is wrong with the settings, if anything.
    ///
    /// # Errors
    /// A sentence that names the setting and what would be accepted.
    pub fn check(&self) -> Result<(), String> {
        if !(self.cfl > 0.0 && self.cfl <= 1.5) {
            return Err(format!(
                "cfl is {:?}: the implicit scheme takes more than 0 and at most 1.5 cells per step",
                self.cfl
            ));
        }
        if !(self.tolerance >= 1e-8 && self.tolerance <= 1e-2) {
            return Err(format!(
                "the solver tolerance is {:?}: it must lie between 1e-8 and 1e-2",
                self.tolerance
            ));
        }
        if let Some(pressure) = (self.air_pressure).filter(|p| !(*p > 0.0 && p.is_finite())) {
            return Err(format!(
                "the pressure of the air is {pressure:?} Pa: it must be positive and finite"
            ));
        }
        if self.air_leak_time.is_nan() || self.air_leak_time <= 0.0 {
            return Err(format!(
                "the time in which air leaks is {:?} s: it must be positive",
                self.air_leak_time
            ));
        }
        Ok(())
    }
}

//! The choices that a case has.

/// Settings of the implicit scheme.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Cells that the fastest liquid crosses in a step.
    pub cfl: f64,
    /// Relative residual of the coupled solve.
    pub tolerance: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            cfl: 1.0,
            tolerance: 1e-3,
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
        Ok(())
    }
}

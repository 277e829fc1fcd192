//! The choices that a case has.

/// Largest Courant number of any face, jets included: the mesh reaches at least two cells beyond the liquid.
pub(crate) const LARGEST_CFL: f64 = 1.5;

/// Relative error at which the iterations of a step end: of volumes and pressures against their law, and of a step's length
/// against the travel that is left. It equals the default solver tolerance; a smaller one would repeat solves for digits that
/// the solution does not have.
pub(crate) const ITERATION_TOLERANCE: f64 = 1e-3;

/// Bound on the iterations of a linear solve that no later one continues, for solves that stagnate. Rounding can make a few
/// unknowns need twice as many iterations as there are of them.
pub(crate) const LINEAR_ITERATIONS: usize = 2000;

/// Settings of the implicit scheme.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Cells that the fastest liquid crosses in a step.
    pub cfl: f64,
    /// Relative residual of the coupled solve.
    pub tolerance: f64,
    /// Absolute pressure of the ambient air, Pa, for pockets of air with a pressure of their own. `None`: all air is ambient.
    pub air_pressure: Option<f64>,
    /// Time in which the excess pressure of a pocket of fixed volume decays to 1/e through leaks, s.
    pub air_leak_time: f64,
    /// k of the dynamic contact angle: cos(theta_d) = cos(theta) - k Ca, Ca the capillary number of the front.
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
    /// Checks the settings.
    ///
    /// # Errors
    /// A sentence that names the setting and what would be accepted.
    pub fn check(&self) -> Result<(), String> {
        if !(self.cfl > 0.0 && self.cfl <= LARGEST_CFL) {
            return Err(format!(
                "cfl is {:?}: with the implicit scheme it must be above 0 and at most {LARGEST_CFL} cells per step",
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
                "dynamic_angle is {:?}: it must be at least zero",
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

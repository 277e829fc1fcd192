//! The scale to which residuals are relative.

use crate::SolveError;
use crate::fgmres::Limits;
use crate::options::SaddleOptions;
use crate::system::SaddleSystem;
use crate::vector::norm;

/// Rounding of a residual, relative to the norm of the solution.
const ROUNDING: f64 = 1e-14;

/// Fraction of slow flow that counts as rest, so that liquid at rest is not solved to ever smaller residuals.
const REST: f64 = 1e-6;

/// The scale of residuals of a system.
pub(crate) struct ResidualScale<'a> {
    system: &'a SaddleSystem<'a>,
    /// Least scale of the forces of the flow if there are standing forces.
    least: f64,
    /// Scale if nothing moves.
    still: f64,
    /// Scale of the forces of liquid at rest.
    rest: f64,
    /// Relative rounding of residuals over the tolerance.
    rounding: f64,
}

impl<'a> ResidualScale<'a> {
    pub(crate) fn new(system: &'a SaddleSystem, options: &SaddleOptions, still: f64) -> Self {
        // Closed liquid at rest, without a face to air, has no flow to set the scale.
        let closed = options.tolerance.powi(2) * system.known_forces();
        Self {
            system,
            least: match system.standing {
                [] => 0.0,
                _ => system.slow_forces().max(closed),
            },
            still,
            rest: REST * system.slow * (system.a.n_rows() as f64).sqrt(),
            rounding: ROUNDING / options.tolerance,
        }
    }

    /// The scale at the solution `x`: the norm of what moves the liquid, `known`, and, with standing forces, of the forces of the
    /// flow. It is not below the rounding of `x`.
    pub(crate) fn of(&self, known: f64, x: &[f64]) -> f64 {
        let flow = match self.system.standing {
            [] => 0.0,
            standing => self.system.forces(&x[..standing.len()]).max(self.least),
        };
        let size = match known.hypot(flow) {
            0.0 => self.still,
            size => size,
        };
        size.max(self.rounding * norm(x)).max(self.rest)
    }

    /// Runs `solve` and returns its residuals. With standing forces it is run again with the scale of the solution found, until
    /// no iteration is needed: the scale of a guess at rest is too small, that of a guess that flows too large.
    pub(crate) fn solve_rescaled(
        &self,
        options: &SaddleOptions,
        mut solve: impl FnMut(&mut Limits) -> Result<Vec<f64>, SolveError>,
    ) -> Result<Vec<f64>, SolveError> {
        let stands = !self.system.standing.is_empty();
        let mut limits = Limits {
            tolerance: options.tolerance,
            scale: 0.0,
            enough: if stands { options.tolerance } else { 0.0 },
            max_iterations: options.max_iterations,
        };
        let mut history = solve(&mut limits)?;
        let mut done = !stands;
        while !done {
            let before = history.len() - 1;
            limits.max_iterations = options.max_iterations.saturating_sub(before);
            let more = solve(&mut limits).map_err(|error| error.after(before))?;
            done = more.len() == 1;
            history.pop();
            history.extend(more);
        }
        Ok(history)
    }
}

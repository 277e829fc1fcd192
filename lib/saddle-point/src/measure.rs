//! What the residuals of a solve are measured by.

use crate::SolveError;
use crate::fgmres::Limits;
use crate::options::SaddleOptions;
use crate::system::SaddleSystem;
use crate::vector::norm;

/// Part of a solution's size below which a residual is rounding.
const ROUNDING: f64 = 1e-14;

/// What residuals are measured by.
pub(crate) struct Measure {
    /// Area by which each face is one to air; empty where no forces stand.
    fronts: Vec<f64>,
    /// Velocity that counts there at least.
    slow: f64,
    /// What residuals are measured by where nothing moves.
    still: f64,
    /// Part of a solution below which they are rounding, over the tolerance.
    rounding: f64,
}

impl Measure {
    pub(crate) fn new(system: &SaddleSystem, options: &SaddleOptions, still: f64) -> Self {
        Self {
            fronts: system.fronts(),
            slow: system.slow,
            still: match options.tolerance * norm(system.b) {
                pushed if pushed > 0.0 && !system.standing.is_empty() => pushed,
                _ => still,
            },
            rounding: ROUNDING / options.tolerance,
        }
    }

    /// The measure at `x`, of what moves the liquid, `known`, and of what flows through the fronts; and no residual is
    /// smaller than the rounding of what stands.
    pub(crate) fn of(&self, known: f64, x: &[f64]) -> f64 {
        let flow: f64 = (self.fronts.iter().zip(x))
            .map(|(area, u)| (area * u.abs().max(self.slow)).powi(2))
            .sum();
        let size = match known.hypot(flow.sqrt()) {
            0.0 => self.still,
            size => size,
        };
        size.max(self.rounding * norm(x))
    }

    /// Residuals of `solve`, which where forces stand is asked again with the measure of what it found: one of a
    /// guess at rest would ask for too much, one of a guess that flows for too little.
    pub(crate) fn stages(
        &self,
        options: &SaddleOptions,
        mut solve: impl FnMut(&mut Limits) -> Result<Vec<f64>, SolveError>,
    ) -> Result<Vec<f64>, SolveError> {
        let stands = !self.fronts.is_empty();
        let mut limits = Limits {
            tolerance: options.tolerance,
            size: 0.0,
            enough: if stands { options.tolerance } else { 0.0 },
            max_iterations: options.max_iterations,
            restart: options.restart.max(1),
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

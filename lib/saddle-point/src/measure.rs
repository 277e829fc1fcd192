//! The measure of residuals.

use crate::SolveError;
use crate::fgmres::Limits;
use crate::options::SaddleOptions;
use crate::system::SaddleSystem;
use crate::vector::norm;

/// Part of a solution's size below which a residual is rounding.
const ROUNDING: f64 = 1e-14;

/// Part of slow flow that is none: liquid that has come to rest is not solved to a part of ever smaller numbers.
const REST: f64 = 1e-6;

/// What residuals are measured by.
pub(crate) struct Measure<'a> {
    system: &'a SaddleSystem<'a>,
    /// Least forces of a flow that count where forces stand.
    least: f64,
    /// What residuals are measured by where nothing moves.
    still: f64,
    /// Forces of flow that is none.
    rest: f64,
    /// Part of a solution below which they are rounding, over the tolerance.
    rounding: f64,
}

impl<'a> Measure<'a> {
    pub(crate) fn new(system: &'a SaddleSystem, options: &SaddleOptions, still: f64) -> Self {
        // Liquid that rests without a face to air asks for as much less once more.
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

    /// The measure at `x`, of what moves the liquid, `known`, and where forces stand of those of the flow; and no residual is
    /// smaller than the rounding of what stands.
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

    /// Residuals of `solve`, which where forces stand is asked again with the measure of what it found: one of a
    /// guess at rest would ask for too much, one of a guess that flows for too little.
    pub(crate) fn stages(
        &self,
        options: &SaddleOptions,
        mut solve: impl FnMut(&mut Limits) -> Result<Vec<f64>, SolveError>,
    ) -> Result<Vec<f64>, SolveError> {
        let stands = !self.system.standing.is_empty();
        let mut limits = Limits {
            tolerance: options.tolerance,
            size: 0.0,
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

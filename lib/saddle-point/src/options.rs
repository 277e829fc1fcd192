//! Settings and report of the solver.

/// Settings of the solver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SaddleOptions {
    /// Residual to reach, relative to the norm of the right-hand side.
    pub tolerance: f64,
    /// Iterations after which the solve fails.
    pub max_iterations: usize,
}

impl Default for SaddleOptions {
    fn default() -> Self {
        Self {
            tolerance: 1e-3,
            max_iterations: 200,
        }
    }
}

/// Report of a solve.
#[derive(Clone, Debug)]
pub struct SaddleReport {
    /// Relative residual at the start and after every iteration.
    pub history: Vec<f64>,
    /// Upper bound of the eigenvalues of `D^-1 A` used.
    pub eigenvalue_bound: f64,
}

impl SaddleReport {
    /// Number of iterations.
    pub fn iterations(&self) -> usize {
        self.history.len().saturating_sub(1)
    }

    /// Relative residual reached.
    pub fn residual(&self) -> f64 {
        self.history.last().copied().unwrap_or(0.0)
    }
}

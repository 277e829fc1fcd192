//! Settings of the solver, and what it reports.

use std::time::Duration;

/// Settings of the solver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SaddleOptions {
    /// Residual to reach, relative to the norm of the right-hand side.
    pub tolerance: f64,
    /// Iterations after which the solve fails.
    pub max_iterations: usize,
    /// Krylov vectors before a restart; memory is 8 bytes x unknowns x this.
    pub restart: usize,
    /// Degree of the Chebyshev polynomial that stands for `A^-1`. Lower ones cost more iterations than they save: a hard step
    /// of a bond of 100 x 394 x 100 voxels takes 69 with 14 and 25 with 24.
    pub chebyshev_degree: usize,
    /// Its interval: largest over smallest eigenvalue of `D^-1 A` treated.
    pub chebyshev_ratio: f64,
}

impl Default for SaddleOptions {
    fn default() -> Self {
        Self {
            tolerance: 1e-3,
            max_iterations: 200,
            restart: 30,
            chebyshev_degree: 24,
            chebyshev_ratio: 400.0,
        }
    }
}

/// What a solve did.
#[derive(Clone, Debug)]
pub struct SaddleReport {
    /// Relative residual at the start and after every iteration.
    pub history: Vec<f64>,
    /// Upper bound of the eigenvalues of `D^-1 A` used.
    pub eigenvalue_bound: f64,
    /// Time to build the preconditioner.
    pub setup: Duration,
    /// Time of the iteration.
    pub iteration: Duration,
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

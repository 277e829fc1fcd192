//! Linear solver of the saddle-point systems of viscous flow on staggered grids.
//!
//! [`SaddleSolver`] solves `[A, -G^T; -G, -C] [u; p] = [b; -g]` for face velocities and cell pressures, and the same system
//! with one more unknown, the speed of a body under a known force ([`Load`]).
//! Matrices are assembled row by row with [`Csr::assemble`]. Every result is bit-identical for any
//! number of threads: work is split into fixed ranges of rows, and sums are added in their order.

mod amg;
mod cause;
mod chebyshev;
mod components;
mod csr;
mod fgmres;
mod least_squares;
mod load;
mod options;
mod orthogonal;
mod packed;
mod preconditioner;
mod residual_scale;
mod saddle;
mod schur;
mod sealed;
mod simd;
mod system;
mod vector;
mod velocity_block;

pub use cause::Cause;
pub use csr::{Csr, RowEntries};
pub use load::Load;
pub use options::{SaddleOptions, SaddleReport};
pub use saddle::SaddleSolver;
pub use system::SaddleSystem;
pub use vector::Real;
pub use velocity_block::VelocityBlock;

/// Why a linear system was not solved.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SolveError {
    /// A matrix or a diagonal lacks a required property.
    #[error("linear system: {0}")]
    Matrix(String),
    /// A right-hand side or a guess holds an infinity or is not a number.
    #[error("linear system: right-hand side or guess is not finite at row {row}")]
    NotFinite {
        /// Its row.
        row: usize,
    },
    /// The iteration did not reach its tolerance.
    #[error(
        "linear solver: relative residual {residual:.1e} after {iterations} iterations, \
         {tolerance:.1e} wanted"
    )]
    NotConverged {
        /// Iterations done.
        iterations: usize,
        /// Relative residual reached.
        residual: f64,
        /// Relative residual wanted.
        tolerance: f64,
    },
    /// The iteration produced numbers that are not finite.
    #[error(
        "linear solver: numbers beyond single precision in iteration {iteration}, from a \
         relative residual of {residual:.1e}"
    )]
    Overflow {
        /// The iteration, from 1.
        iteration: usize,
        /// Relative residual before it.
        residual: f64,
    },
    /// [`SolveError::NotConverged`] or [`SolveError::Overflow`] with the likely cause.
    #[error("{error}: {cause}")]
    Unsolved {
        /// The failure of the iteration.
        error: Box<SolveError>,
        /// Its likely cause.
        cause: Cause,
    },
}

impl SolveError {
    /// Adds the `before` iterations of an earlier call to the count of the error.
    fn after(mut self, before: usize) -> Self {
        match &mut self {
            Self::NotConverged { iterations, .. } => *iterations += before,
            Self::Overflow { iteration, .. } => *iteration += before,
            _ => (),
        }
        self
    }
}

/// A solution with a residual up to this many times the tolerance may be used; the next step continues from it.
pub const NEARLY: f64 = 10.0;

//! Aggregation multigrid for the pressure Poisson operators: three passes of pairwise matching
//! (8:1) per level, Jacobi smoothing with Chebyshev weights, K-cycles (Notay 2010, An
//! aggregation-based algebraic multigrid method, ETNA 37, 123-146) and a dense Cholesky factor on
//! the last one.

mod aggregate;
mod cycle;
mod dense;

use super::SolveError;
use super::csr::Csr;
use super::vector::{Real, Work, for_chunks};
use aggregate::{Aggregation, coarsen};
use dense::Cholesky;

pub(crate) use cycle::Workspace;

/// Rows below which a level is factorised; a coarse solve costs the square of this.
const MAX_DENSE: usize = 256;
/// More levels than a 32-bit row count can need.
const MAX_LEVELS: usize = 12;

/// One level above the last: its operator and how its rows join into the rows of the next.
struct Level {
    matrix: Csr<Work>,
    /// `1 / diagonal`, zero for an empty row.
    inverse_diagonal: Vec<Work>,
    aggregation: Aggregation,
}

/// The last level.
enum Bottom {
    Dense(Cholesky),
    /// Coarsening stopped early: the rows are nearly decoupled and Jacobi solves them.
    Jacobi(Vec<Work>),
}

/// The hierarchy of a symmetric positive semi-definite matrix.
pub(crate) struct Amg {
    levels: Vec<Level>,
    bottom: Bottom,
}

impl Amg {
    /// Builds the hierarchy of `matrix`.
    pub(crate) fn new(matrix: &Csr<f64>) -> Result<Self, SolveError> {
        let mut levels = Vec::new();
        let mut coarse: Option<Csr<f64>> = None;
        loop {
            let fine = coarse.as_ref().unwrap_or(matrix);
            if fine.n_rows() <= MAX_DENSE {
                let bottom = Bottom::Dense(Cholesky::new(fine));
                return Ok(Self { levels, bottom });
            }
            let (aggregation, next) = coarsen(fine)?;
            if levels.len() == MAX_LEVELS || next.n_rows() * 10 > fine.n_rows() * 9 {
                let bottom = Bottom::Jacobi(inverse_diagonal(fine));
                return Ok(Self { levels, bottom });
            }
            levels.push(Level {
                matrix: fine.cast(),
                inverse_diagonal: inverse_diagonal(fine),
                aggregation,
            });
            coarse = Some(next);
        }
    }

    /// Rows of every level, finest first.
    pub(crate) fn rows_per_level(&self) -> Vec<usize> {
        let mut rows: Vec<usize> = self.levels.iter().map(|l| l.matrix.n_rows()).collect();
        rows.push(match &self.bottom {
            Bottom::Dense(factor) => factor.len(),
            Bottom::Jacobi(diagonal) => diagonal.len(),
        });
        rows
    }
}

fn inverse_diagonal(matrix: &Csr<f64>) -> Vec<Work> {
    let diagonal = matrix.diagonal();
    let mut inverse = vec![0.0; diagonal.len()];
    for_chunks(&mut inverse, |start, part| {
        for (out, &d) in part.iter_mut().zip(&diagonal[start..]) {
            *out = if d > 0.0 { Work::nearest(1.0 / d) } else { 0.0 };
        }
    });
    inverse
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn systems_of_up_to_256_rows_are_factorised() {
        let levels = |n: usize| {
            let chain = Csr::assemble(n, n, |row, entries| {
                entries.add(row, 2.0);
                if row > 0 {
                    entries.add(row - 1, -1.0);
                }
                if row + 1 < n {
                    entries.add(row + 1, -1.0);
                }
            });
            Amg::new(&chain.unwrap()).unwrap().rows_per_level().len()
        };
        assert_eq!((levels(256), levels(257)), (1, 2));
    }
}

//! Aggregation multigrid for the pressure Poisson operators: three passes of pairwise matching
//! (8:1) per level, Jacobi smoothing with Chebyshev weights, K-cycles (Notay 2010, An
//! aggregation-based algebraic multigrid method, ETNA 37, 123-146) and a dense Cholesky factor on
//! the last one.

mod aggregate;
mod cycle;
mod dense;

use super::SolveError;
use super::csr::Csr;
use super::vector::{Real, Work, for_each};
use aggregate::{Aggregation, coarsen};
use cycle::Vectors;
use dense::Cholesky;

/// Most rows of a level that is factorised; a coarse solve costs the square of this.
const MAX_DENSE: usize = 256;
/// More levels than a 32-bit row count can need.
const MAX_LEVELS: usize = 12;

/// A level above the last: its operator, and the aggregation of its rows to the rows of the next.
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
    /// Vectors of all levels, the last included.
    vectors: Vec<Vectors>,
}

impl Amg {
    /// Builds the hierarchy of `matrix`.
    pub(crate) fn new(matrix: &Csr<f64>) -> Result<Self, SolveError> {
        let (mut levels, mut vectors) = (Vec::new(), Vec::new());
        let mut coarse: Option<Csr<f64>> = None;
        let bottom = loop {
            let fine = coarse.as_ref().unwrap_or(matrix);
            vectors.push(Vectors::new(fine.n_rows()));
            if fine.n_rows() <= MAX_DENSE {
                break Bottom::Dense(Cholesky::new(fine));
            }
            let (aggregation, next) = coarsen(fine)?;
            if levels.len() == MAX_LEVELS || next.n_rows() * 10 > fine.n_rows() * 9 {
                break Bottom::Jacobi(inverse_diagonal(fine));
            }
            levels.push(Level {
                matrix: fine.cast(),
                inverse_diagonal: inverse_diagonal(fine),
                aggregation,
            });
            coarse = Some(next);
        };
        Ok(Self {
            levels,
            bottom,
            vectors,
        })
    }
}

fn inverse_diagonal(matrix: &Csr<f64>) -> Vec<Work> {
    let diagonal = matrix.diagonal();
    let mut inverse = vec![0.0; diagonal.len()];
    for_each(&mut inverse, |row, out| {
        let d = diagonal[row];
        *out = if d > 0.0 { Work::nearest(1.0 / d) } else { 0.0 };
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
            Amg::new(&chain.unwrap()).unwrap().vectors.len()
        };
        assert_eq!((levels(256), levels(257)), (1, 2));
    }
}

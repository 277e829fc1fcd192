//! Cholesky factor of the coarsest operator.

use crate::csr::Csr;
use crate::vector::{Real, Work};

/// A pivot below this fraction of its diagonal entry marks a row that depends on earlier ones (a closed pocket without
/// compressibility). Its unknown is set to zero.
const DEPENDENT: f64 = 1e-11;

/// `A = L L^T`, dense, lower triangle by rows.
pub(super) struct Cholesky {
    n: usize,
    /// Strictly lower part of `L`, row by row.
    lower: Vec<Work>,
    /// `1 / L_ii`, zero for a dependent row.
    inverse_diagonal: Vec<Work>,
}

impl Cholesky {
    pub(super) fn new(matrix: &Csr<f64>) -> Self {
        let n = matrix.n_rows();
        let mut l = vec![0.0f64; n * n];
        let mut inverse_diagonal = vec![0.0f64; n];
        for row in 0..n {
            let (columns, values) = matrix.row(row);
            for (&column, &value) in columns.iter().zip(values) {
                l[row * n + column as usize] = value;
            }
        }
        for i in 0..n {
            let (above, rest) = l.split_at_mut(i * n);
            let row_i = &mut rest[..n];
            for j in 0..i {
                let row_j = &above[j * n..j * n + j];
                let sum: f64 = row_j.iter().zip(&*row_i).map(|(a, b)| a * b).sum();
                row_i[j] = (row_i[j] - sum) * inverse_diagonal[j];
            }
            let diagonal = row_i[i];
            let pivot = diagonal - row_i[..i].iter().map(|v| v * v).sum::<f64>();
            if pivot > DEPENDENT * diagonal {
                inverse_diagonal[i] = 1.0 / pivot.sqrt();
            }
        }
        let lower = (0..n).flat_map(|i| l[i * n..i * n + i].iter().map(|&v| Work::nearest(v)));
        Self {
            n,
            lower: lower.collect(),
            inverse_diagonal: inverse_diagonal.into_iter().map(Work::nearest).collect(),
        }
    }

    /// `x = A^-1 b`.
    pub(super) fn solve(&self, b: &[Work], x: &mut [Work]) {
        let row = |i: usize| &self.lower[i * (i.max(1) - 1) / 2..][..i];
        for i in 0..self.n {
            let sum: Work = row(i).iter().zip(&*x).map(|(l, x)| l * x).sum();
            x[i] = (b[i] - sum) * self.inverse_diagonal[i];
        }
        for i in (0..self.n).rev() {
            x[i] *= self.inverse_diagonal[i];
            let value = x[i];
            for (x, l) in x.iter_mut().zip(row(i)) {
                *x -= l * value;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two coupled cells, one slightly compressible. Below the rounding of the elimination they cannot be distinguished from a
    /// closed pocket, whose last pressure is zero.
    #[test]
    fn what_is_left_of_a_row_by_rounding_is_dependent() {
        let last = |part: f64| {
            let matrix = Csr::assemble(2, 2, |row, entries| {
                entries.add(row, if row == 0 { 1.0 } else { 1.0 + part });
                entries.add(1 - row, -1.0);
            });
            let mut x = [0.0; 2];
            Cholesky::new(&matrix.unwrap()).solve(&[0.0, 1.0], &mut x);
            x[1]
        };
        assert_eq!([0.0, 0.75e-11].map(last), [0.0; 2]);
        assert!((last(1.5e-11) * 1.5e-11 - 1.0).abs() < 1e-3);
    }
}

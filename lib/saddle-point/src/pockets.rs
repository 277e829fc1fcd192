//! Closed pockets: connected cells on which a Poisson operator is singular, or nearly.

use crate::csr::Csr;
use crate::vector::Real;

/// Connected components of a matrix whose row sums vanish, or nearly, so that constants are in the null space, or nearly.
pub(crate) struct ClosedPockets {
    /// Rows of each pocket.
    pub(crate) members: Vec<Vec<u32>>,
}

impl ClosedPockets {
    /// The components of `matrix` for which `closed` holds.
    pub(crate) fn of(matrix: &Csr<f64>, closed: impl Fn(&[u32]) -> bool) -> Self {
        let neighbours = |row: u32| matrix.row(row as usize).0.iter().copied();
        Self {
            members: (components(matrix.n_rows(), neighbours))
                .filter(|pocket| closed(pocket))
                .collect(),
        }
    }

    /// Mean over each pocket.
    pub(crate) fn means<T: Real>(&self, x: &[T]) -> Vec<f64> {
        let mean = |pocket: &Vec<u32>| {
            let sum: f64 = pocket.iter().map(|&row| x[row as usize].into()).sum();
            sum / pocket.len() as f64
        };
        self.members.iter().map(mean).collect()
    }

    /// Subtracts a value on each pocket.
    pub(crate) fn subtract<T: Real>(&self, values: &[f64], x: &mut [T]) {
        for (pocket, &value) in self.members.iter().zip(values) {
            let value = T::nearest(value);
            for &row in pocket {
                x[row as usize] = x[row as usize] - value;
            }
        }
    }

    /// Subtracts the mean over each pocket.
    pub(crate) fn remove_mean<T: Real>(&self, x: &mut [T]) {
        self.subtract(&self.means(x), x);
    }
}

/// Sum and diagonal of a row.
pub(crate) fn sum_and_diagonal(matrix: &Csr<f64>, row: u32) -> (f64, f64) {
    let (columns, values) = matrix.row(row as usize);
    let diagonal = columns.binary_search(&row).map_or(0.0, |at| values[at]);
    (values.iter().sum(), diagonal)
}

/// The connected components of a graph with `n` nodes.
pub(crate) fn components<I: Iterator<Item = u32>>(
    n: usize,
    neighbours: impl Fn(u32) -> I,
) -> impl Iterator<Item = Vec<u32>> {
    let mut reached = vec![false; n];
    (0..n as u32).filter_map(move |first| {
        if std::mem::replace(&mut reached[first as usize], true) {
            return None;
        }
        let (mut found, mut next) = (vec![first], 0);
        while let Some(&row) = found.get(next) {
            next += 1;
            for row in neighbours(row) {
                if !std::mem::replace(&mut reached[row as usize], true) {
                    found.push(row);
                }
            }
        }
        Some(found)
    })
}

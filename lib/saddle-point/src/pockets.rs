//! Closed pockets: connected cells on which a Poisson operator is singular.

use crate::csr::Csr;
use crate::vector::Real;

/// The connected components of the rows of a matrix on which the entries sum to nothing, or next to it, so
/// that a constant is in the null space, or nearly.
pub(crate) struct ClosedPockets {
    members: Vec<Vec<u32>>,
}

impl ClosedPockets {
    /// The components that `closed` finds so.
    pub(crate) fn of(matrix: &Csr<f64>, closed: impl Fn(&[u32]) -> bool) -> Self {
        let n = matrix.n_rows();
        let mut reached = vec![false; n];
        let mut members = Vec::new();
        for first in 0..n as u32 {
            let pocket = flood(matrix, &mut reached, first);
            if !pocket.is_empty() && closed(&pocket) {
                members.push(pocket);
            }
        }
        Self { members }
    }

    /// The rows of each.
    pub(crate) fn members(&self) -> &[Vec<u32>] {
        &self.members
    }

    /// Numbers of their rows.
    pub(crate) fn sizes(&self) -> impl Iterator<Item = f64> {
        self.members.iter().map(|pocket| pocket.len() as f64)
    }

    /// Means over every closed pocket.
    pub(crate) fn means<T: Real>(&self, x: &[T]) -> Vec<f64> {
        let mean = |pocket: &Vec<u32>| {
            let sum: f64 = pocket.iter().map(|&row| x[row as usize].into()).sum();
            sum / pocket.len() as f64
        };
        self.members.iter().map(mean).collect()
    }

    /// Subtracts one value of every closed pocket.
    pub(crate) fn subtract<T: Real>(&self, values: &[f64], x: &mut [T]) {
        for (pocket, &value) in self.members.iter().zip(values) {
            let value = T::nearest(value);
            for &row in pocket {
                x[row as usize] = x[row as usize] - value;
            }
        }
    }

    /// Subtracts the mean over every closed pocket.
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

/// Marks every row connected to `first`, and returns them; none where it was marked before.
fn flood(matrix: &Csr<f64>, reached: &mut [bool], first: u32) -> Vec<u32> {
    if std::mem::replace(&mut reached[first as usize], true) {
        return Vec::new();
    }
    let mut found = vec![first];
    let mut next = 0;
    while let Some(&row) = found.get(next) {
        next += 1;
        for &column in matrix.row(row as usize).0 {
            if !std::mem::replace(&mut reached[column as usize], true) {
                found.push(column);
            }
        }
    }
    found
}

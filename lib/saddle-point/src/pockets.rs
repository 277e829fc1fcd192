//! Closed pockets: connected cells on which a Poisson operator is singular.

use crate::csr::Csr;
use crate::vector::Real;

/// A row sum below this fraction of the diagonal counts as zero.
const ROUNDING: f64 = 1e-12;

/// The connected components of the rows of a matrix on all of which the entries sum to zero, so
/// that a constant is in the null space.
pub(crate) struct ClosedPockets {
    members: Vec<Vec<u32>>,
}

impl ClosedPockets {
    pub(crate) fn find(matrix: &Csr<f64>) -> Self {
        let n = matrix.n_rows();
        let open = |row: usize| {
            let (columns, values) = matrix.row(row);
            let sum: f64 = values.iter().sum();
            let diagonal = columns
                .binary_search(&(row as u32))
                .map_or(0.0, |at| values[at]);
            sum.abs() > ROUNDING * diagonal
        };
        // Flood from the rows that are open, then what is left falls into closed pockets.
        let mut reached: Vec<bool> = (0..n).map(open).collect();
        let mut front: Vec<u32> = (0..n as u32).filter(|&row| reached[row as usize]).collect();
        flood(matrix, &mut reached, &mut front, |_| ());
        let mut members = Vec::new();
        for row in 0..n {
            if !reached[row] {
                reached[row] = true;
                let mut pocket = vec![row as u32];
                flood(matrix, &mut reached, &mut vec![row as u32], |row| {
                    pocket.push(row)
                });
                members.push(pocket);
            }
        }
        Self { members }
    }

    /// Subtracts the mean over every closed pocket.
    pub(crate) fn remove_mean<T: Real>(&self, x: &mut [T]) {
        for pocket in &self.members {
            let sum: f64 = pocket.iter().map(|&row| x[row as usize].into()).sum();
            let mean = T::nearest(sum / pocket.len() as f64);
            for &row in pocket {
                x[row as usize] = x[row as usize] - mean;
            }
        }
    }
}

/// Marks every row connected to `front`, calling `found` on each new one.
fn flood(
    matrix: &Csr<f64>,
    reached: &mut [bool],
    front: &mut Vec<u32>,
    mut found: impl FnMut(u32),
) {
    while let Some(row) = front.pop() {
        for &column in matrix.row(row as usize).0 {
            if !std::mem::replace(&mut reached[column as usize], true) {
                found(column);
                front.push(column);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two cells, and the part of the diagonal by which the sum of the second row is not zero.
    #[test]
    fn a_row_sum_of_rounding_closes_a_pocket() {
        let pockets = |part: f64| {
            let matrix = Csr::assemble(2, 2, |row, entries| {
                entries.add(row, if row == 0 { 1.0 } else { 1.0 + part });
                entries.add(1 - row, -1.0);
            });
            ClosedPockets::find(&matrix.unwrap()).members.len()
        };
        assert_eq!([0.0, 0.75e-12, 1.5e-12].map(pockets), [1, 1, 0]);
    }
}

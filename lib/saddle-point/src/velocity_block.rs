//! The velocity block of a saddle-point system, in the compact form of the solver.

use crate::SolveError;
use crate::csr::{RowEntries, assemble_chunks, value_at};
use crate::packed::PackedMatrix;
use crate::vector::{CHUNK, Real, Work, for_each};

/// A symmetric positive definite matrix `A` with diagonal `D`, stored as `S A S` with `S = D^-1/2`. Entries are accurate to
/// 1e-14 of the root of the two diagonals that they couple, and take two thirds of the memory of plain rows.
pub struct VelocityBlock {
    pub(crate) matrix: PackedMatrix,
    /// `D^-1/2`.
    pub(crate) scale: Vec<Work>,
    /// `D^1/2`.
    root: Vec<f64>,
}

impl VelocityBlock {
    /// Assembles `n` rows as [`Csr::assemble`](crate::Csr::assemble) does.
    ///
    /// # Errors
    /// As [`Csr::assemble`](crate::Csr::assemble); and [`SolveError::Matrix`] for a diagonal that is not positive, or an entry
    /// larger than the diagonals allow.
    pub fn assemble(
        n: usize,
        fill: impl Fn(usize, &mut RowEntries) + Sync,
    ) -> Result<Self, SolveError> {
        let rows = assemble_chunks::<f64>(n, n, fill)?;
        let mut root = vec![0.0; n];
        for_each(&mut root, |row, out| {
            *out = value_at(rows[row / CHUNK].row(row % CHUNK), row);
        });
        if let Some(row) = root.iter().position(|&d| d <= 0.0) {
            return Err(SolveError::Matrix(format!(
                "diagonal {} of velocity row {row}; the velocity block must be positive definite",
                root[row]
            )));
        }
        for_each(&mut root, |_, d| *d = d.sqrt());
        let mut scale = root.clone();
        for_each(&mut scale, |_, d| *d = 1.0 / *d);
        Ok(Self {
            matrix: PackedMatrix::new(rows, &scale)?,
            scale: scale.into_iter().map(Work::nearest).collect(),
            root,
        })
    }

    /// Number of rows.
    pub fn n_rows(&self) -> usize {
        self.root.len()
    }

    /// The largest entry off the diagonal, which is twice the largest viscosity: walls and inertia are on the diagonal. 0 if there
    /// is none.
    pub(crate) fn largest_coupling(&self) -> f64 {
        self.matrix.largest
    }

    /// `D`.
    pub(crate) fn diagonal(&self) -> impl Iterator<Item = f64> {
        self.root.iter().map(|root| root * root)
    }

    /// `out = A x`.
    pub fn multiply<X: Real>(&self, x: &[X], out: &mut [f64]) {
        self.multiply_by(x, &mut Vec::new(), out);
    }

    /// `out = A x`; `scratch` receives the scaled `x`.
    pub(crate) fn multiply_by<X: Real>(&self, x: &[X], scratch: &mut Vec<f64>, out: &mut [f64]) {
        let root = &self.root[..];
        scratch.resize(self.matrix.padded_len(), 0.0);
        for_each(&mut scratch[..x.len()], |i, scaled| {
            *scaled = root[i] * x[i].into()
        });
        self.matrix.multiply_fine(scratch, out);
        let scaled = &scratch[..];
        for_each(out, |i, out| *out = root[i] * (scaled[i] + *out));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Csr;

    /// A chain whose diagonal spans six orders of magnitude; products are accurate to the unit of the fixed-point numbers.
    #[test]
    fn products_are_those_of_the_matrix() {
        let n = 1000;
        let weight = |row: usize| 10f64.powi(row as i32 % 7 - 3);
        let fill = |row: usize, entries: &mut RowEntries| {
            entries.add(row, weight(row));
            for other in [row.wrapping_sub(1), row + 1] {
                if other < n {
                    let part = [0.3, -0.4, -0.4][(row + other) % 3];
                    entries.add(other, part * (weight(row) * weight(other)).sqrt());
                }
            }
        };
        let x: Vec<f64> = (0..n).map(|i| (0.37 * i as f64).sin()).collect();
        let a: Csr<f64> = Csr::assemble(n, n, fill).unwrap();
        let block = VelocityBlock::assemble(n, fill).unwrap();
        let mut found = vec![0.0; n];
        block.multiply(&x, &mut found);
        for (row, found) in found.into_iter().enumerate() {
            let largest = weight(row).sqrt() * 1e3f64.sqrt();
            let error = (found - a.row_times_wide(row, &x)).abs() / largest;
            assert!(error < 2.0 * 7.2e-15, "row {row}: {error:e}");
        }
    }
}

//! The velocity block scaled by its diagonal, which the polynomial and the outer iteration share.

use crate::SolveError;
use crate::csr::Csr;
use crate::packed::PackedMatrix;
use crate::vector::{Real, Work, for_chunks};

/// `S A S` of a symmetric positive definite `A` with diagonal `D` and `S = D^-1/2`.
pub(crate) struct Scaled {
    pub(crate) matrix: PackedMatrix,
    /// `D^-1/2`.
    pub(crate) scale: Vec<Work>,
    /// `D^1/2`.
    root: Vec<f64>,
}

impl Scaled {
    /// Refuses a diagonal that is not positive, or an entry above it.
    pub(crate) fn new(a: &Csr<f64>) -> Result<Self, SolveError> {
        let mut root = a.diagonal();
        if let Some(row) = root.iter().position(|&d| d <= 0.0) {
            return Err(SolveError::Matrix(format!(
                "diagonal {} of velocity row {row}; the velocity block must be positive definite",
                root[row]
            )));
        }
        let mut scale = root.clone();
        for_chunks(&mut scale, |_, part| {
            part.iter_mut().for_each(|d| *d = 1.0 / d.sqrt());
        });
        for_chunks(&mut root, |_, part| {
            part.iter_mut().for_each(|d| *d = d.sqrt());
        });
        Ok(Self {
            matrix: PackedMatrix::new(a, &scale)?,
            scale: scale.into_iter().map(Work::nearest).collect(),
            root,
        })
    }

    /// `out = A x` to 2e-10 of the diagonal; `scratch` takes the scaled `x`.
    pub(crate) fn multiply(&self, x: &[Work], scratch: &mut Vec<f64>, out: &mut [f64]) {
        let root = &self.root;
        scratch.resize(self.matrix.padded_len(), 0.0);
        for_chunks(&mut scratch[..x.len()], |start, part| {
            for (i, scaled) in part.iter_mut().enumerate() {
                *scaled = root[start + i] * f64::from(x[start + i]);
            }
        });
        self.matrix.multiply_fine(scratch, out);
        let scaled = &*scratch;
        for_chunks(out, |start, part| {
            for (i, out) in part.iter_mut().enumerate() {
                *out = root[start + i] * (scaled[start + i] + *out);
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A chain whose diagonal spans six orders: products to the unit of the fixed-point numbers.
    #[test]
    fn products_are_those_of_the_matrix() {
        let n = 1000;
        let weight = |row: usize| 10f64.powi(row as i32 % 7 - 3);
        let a = Csr::assemble(n, n, |row, entries| {
            entries.add(row, weight(row));
            for other in [row.wrapping_sub(1), row + 1] {
                if other < n {
                    let sign = if (row + other) % 3 == 0 { 0.3 } else { -0.4 };
                    entries.add(other, sign * (weight(row) * weight(other)).sqrt());
                }
            }
        })
        .unwrap();
        let scaled = Scaled::new(&a).unwrap();
        let x: Vec<Work> = (0..n).map(|i| (0.37 * i as Work).sin()).collect();
        let (mut exact, mut found) = (vec![0.0; n], vec![0.0; n]);
        a.multiply(&x, &mut exact);
        scaled.multiply(&x, &mut Vec::new(), &mut found);
        for row in 0..n {
            let largest = weight(row).sqrt() * 1e3f64.sqrt();
            let error = (found[row] - exact[row]).abs() / largest;
            assert!(error < 2.0 * 4.7e-10, "row {row}: {error:e}");
        }
    }
}

//! Orthogonalisation of a vector against the Krylov basis, in double precision.

use rayon::prelude::*;

use crate::simd::{Kernel, dispatch};
use crate::vector::{CHUNK, Work, dot_each, for_chunks_sum};

/// A vector is orthogonalised again if less than this fraction of its norm remains. Half or twice the value only changes the
/// rounding.
const CANCELLED: f64 = 0.1;

/// Removes from `vector` its components along `basis` by classical Gram-Schmidt, twice if little remains. Returns the
/// components and the norm of the remainder.
pub(crate) fn orthogonalise(basis: &[Vec<Work>], vector: &mut [f64]) -> (Vec<f64>, f64) {
    let mut column = components(basis, vector);
    let mut remaining = subtract(basis, &column, vector);
    let removed: f64 = column.iter().map(|h| h * h).sum();
    if remaining < CANCELLED * removed.sqrt().hypot(remaining) {
        let again = components(basis, vector);
        remaining = subtract(basis, &again, vector);
        for (total, more) in column.iter_mut().zip(again) {
            *total += more;
        }
    }
    (column, remaining)
}

/// `(v_j, vector)` for every basis vector.
fn components(basis: &[Vec<Work>], vector: &[f64]) -> Vec<f64> {
    let parts: Vec<Vec<f64>> = (vector.par_chunks(CHUNK).enumerate())
        .map(|(chunk, vector)| {
            let start = chunk * CHUNK;
            dispatch(Components {
                basis,
                start,
                vector,
            })
        })
        .collect();
    let mut sums = vec![0.0; basis.len()];
    for part in parts {
        for (sum, value) in sums.iter_mut().zip(part) {
            *sum += value;
        }
    }
    sums
}

/// `vector -= sum_j column_j v_j`; returns the norm of the result.
fn subtract(basis: &[Vec<Work>], column: &[f64], vector: &mut [f64]) -> f64 {
    let square = for_chunks_sum(vector, |start, vector| {
        dispatch(Subtraction {
            basis,
            column,
            start,
            vector,
        })
    });
    square.sqrt()
}

/// Basis vectors in one pass over a chunk; does not affect results.
const TOGETHER: usize = 4;

/// Products with the basis vectors of one chunk, which begins at row `start`.
struct Components<'a> {
    basis: &'a [Vec<Work>],
    start: usize,
    vector: &'a [f64],
}

impl Kernel for Components<'_> {
    type Output = Vec<f64>;

    #[inline(always)]
    fn run(self) -> Vec<f64> {
        let rows = self.start..self.start + self.vector.len();
        let mut sums = Vec::with_capacity(self.basis.len());
        let (groups, single) = self.basis.as_chunks::<TOGETHER>();
        for group in groups {
            sums.extend(dot_each(
                group.each_ref().map(|v| &v[rows.clone()]),
                self.vector,
            ));
        }
        for v in single {
            sums.extend(dot_each([&v[rows.clone()]], self.vector));
        }
        sums
    }
}

/// Removes the components in one chunk, which begins at row `start`; returns its squared norm.
struct Subtraction<'a> {
    basis: &'a [Vec<Work>],
    column: &'a [f64],
    start: usize,
    vector: &'a mut [f64],
}

impl Kernel for Subtraction<'_> {
    type Output = f64;

    #[inline(always)]
    fn run(self) -> f64 {
        let rows = self.start..self.start + self.vector.len();
        let (groups, single) = self.basis.as_chunks::<TOGETHER>();
        let (columns, single_columns) = self.column.as_chunks::<TOGETHER>();
        for (group, column) in groups.iter().zip(columns) {
            let group = group.each_ref().map(|v| &v[rows.clone()]);
            subtract_each(group, column, self.vector);
        }
        for (v, column) in single.iter().zip(single_columns) {
            subtract_each([&v[rows.clone()]], &[*column], self.vector);
        }
        let [square] = dot_each([&*self.vector], self.vector);
        square
    }
}

#[inline(always)]
fn subtract_each<const N: usize>(basis: [&[Work]; N], column: &[f64; N], vector: &mut [f64]) {
    let basis = basis.map(|v| &v[..vector.len()]);
    for (i, out) in vector.iter_mut().enumerate() {
        for (v, h) in basis.iter().zip(column) {
            *out -= h * f64::from(v[i]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::vector::dot_chunk;

    /// A basis that is a thousandth off orthogonal. If a fourteenth of a vector remains, a second pass removes its components; if
    /// a seventh remains, one pass is enough.
    #[test]
    fn a_cancelled_vector_is_orthogonalised_twice() {
        let basis: [Vec<Work>; 2] = [vec![1.0, 0.0, 0.0], vec![1e-3, 1.0, 0.0]];
        let along = |rest: f64| {
            let mut vector = vec![0.0, 1.0, rest];
            orthogonalise(&basis, &mut vector);
            dot_chunk(&basis[0], &vector).abs()
        };
        let (twice, once) = (along(0.07), along(0.14));
        assert!(twice < 1e-5 && once > 5e-4, "{twice:e} and {once:e}");
    }
}

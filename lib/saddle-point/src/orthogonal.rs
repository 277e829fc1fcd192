//! Orthogonalisation of a vector against the Krylov basis, in double precision.

use rayon::prelude::*;

use crate::compact::{BLOCK, Compact};
use crate::simd::{Kernel, dispatch};
use crate::vector::{CHUNK, dot_each, for_chunks_sum};

/// A vector is orthogonalised again when less than this fraction of its norm remains.
const CANCELLED: f64 = 0.1;

/// Removes from `vector` its components along `basis` by classical Gram-Schmidt, twice where
/// little is left; returns the components and the norm of the remainder.
pub(crate) fn orthogonalise(basis: &[Compact], vector: &mut [f64]) -> (Vec<f64>, f64) {
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
fn components(basis: &[Compact], vector: &[f64]) -> Vec<f64> {
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
fn subtract(basis: &[Compact], column: &[f64], vector: &mut [f64]) -> f64 {
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

/// Basis vectors that one pass over a chunk takes at once.
const TOGETHER: usize = 4;
/// Sums that do not wait for one another.
const LANES: usize = 8;

/// Products of one chunk, that begins at row `start`, with basis vectors.
struct Components<'a> {
    basis: &'a [Compact],
    start: usize,
    vector: &'a [f64],
}

impl Kernel for Components<'_> {
    type Output = Vec<f64>;

    #[inline(always)]
    fn run(self) -> Vec<f64> {
        let mut sums = Vec::with_capacity(self.basis.len());
        let (groups, single) = self.basis.as_chunks::<TOGETHER>();
        for group in groups {
            sums.extend(compact_dots(group.each_ref(), self.start, self.vector));
        }
        for v in single {
            sums.extend(compact_dots([v], self.start, self.vector));
        }
        sums
    }
}

/// Scalar products of several basis vectors with one chunk, that begins at row `start`: eight sums each,
/// in units of a block first.
#[inline(always)]
fn compact_dots<const N: usize>(basis: [&Compact; N], start: usize, vector: &[f64]) -> [f64; N] {
    let mut sums = [[0.0; LANES]; N];
    for (block, vector) in vector.chunks(BLOCK).enumerate() {
        for (sums, v) in sums.iter_mut().zip(basis) {
            let (values, unit) = v.block(start / BLOCK + block);
            let mut lanes = [0.0; LANES];
            let ((values, rest), (vector, tail)) =
                (values.as_chunks::<LANES>(), vector.as_chunks::<LANES>());
            for (values, vector) in values.iter().zip(vector) {
                add_products(&mut lanes, values, vector);
            }
            add_products(&mut lanes, rest, tail);
            for (sum, lane) in sums.iter_mut().zip(lanes) {
                *sum += f64::from(unit) * lane;
            }
        }
    }
    sums.map(|lanes| lanes.iter().sum())
}

#[inline(always)]
fn add_products(lanes: &mut [f64; LANES], values: &[i16], vector: &[f64]) {
    for (lane, (&value, x)) in lanes.iter_mut().zip(values.iter().zip(vector)) {
        *lane += f64::from(value) * x;
    }
}

/// Removes the components of one chunk, that begins at row `start`; yields its square.
struct Subtraction<'a> {
    basis: &'a [Compact],
    column: &'a [f64],
    start: usize,
    vector: &'a mut [f64],
}

impl Kernel for Subtraction<'_> {
    type Output = f64;

    #[inline(always)]
    fn run(self) -> f64 {
        let (groups, single) = self.basis.as_chunks::<TOGETHER>();
        let (columns, single_columns) = self.column.as_chunks::<TOGETHER>();
        for (group, column) in groups.iter().zip(columns) {
            subtract_each(group.each_ref(), column, self.start, self.vector);
        }
        for (v, column) in single.iter().zip(single_columns) {
            subtract_each([v], &[*column], self.start, self.vector);
        }
        let [square] = dot_each([&*self.vector], self.vector);
        square
    }
}

#[inline(always)]
fn subtract_each<const N: usize>(
    basis: [&Compact; N],
    column: &[f64; N],
    start: usize,
    vector: &mut [f64],
) {
    for (block, vector) in vector.chunks_mut(BLOCK).enumerate() {
        let blocks = basis.map(|v| v.block(start / BLOCK + block));
        for ((values, unit), h) in blocks.into_iter().zip(column) {
            let factor = h * f64::from(unit);
            for (out, &value) in vector.iter_mut().zip(values) {
                *out -= factor * f64::from(value);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is left of a vector along a basis that is a thousandth off orthogonal: nothing after a
    /// second pass, where a fourteenth of it remains; where a seventh does, one pass is enough.
    #[test]
    fn a_cancelled_vector_is_orthogonalised_twice() {
        let basis = [[1.0, 0.0, 0.0], [1e-3, 1.0, 0.0]].map(|mut vector| {
            let mut kept = Compact::default();
            kept.keep(&mut vector);
            kept
        });
        let along = |rest: f64| {
            let mut vector = vec![0.0, 1.0, rest];
            orthogonalise(&basis, &mut vector);
            vector[0].abs()
        };
        let (twice, once) = (along(0.07), along(0.14));
        assert!(twice < 1e-5 && once > 5e-4, "{twice:e} and {once:e}");
    }
}

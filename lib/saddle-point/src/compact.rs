//! Vectors kept in 16 bits a value, for those of the Krylov space: its memory and its memory traffic.

use rayon::prelude::*;

use crate::simd::{Kernel, dispatch};
use crate::vector::{CHUNK, Work, for_chunks};

/// Consecutive values that share a scale: the largest of them is 32767 units.
pub(crate) const BLOCK: usize = 64;
/// Units of the largest value of a block.
const UNITS: Work = 32767.0;
/// 1.5 x 2^23: a number below 2^22 that is added to it is rounded to a whole one in its lowest bits.
const ROUNDING: Work = 12_582_912.0;

/// Fixed-point values in blocks, each to 1.6e-5 of the largest in its block.
#[derive(Clone, Debug, Default)]
pub(crate) struct Compact {
    values: Vec<i16>,
    /// Unit of every block.
    units: Vec<Work>,
}

impl Compact {
    /// Keeps `from`, which takes the values as they are kept.
    pub(crate) fn keep(&mut self, from: &mut [Work]) {
        fit(&mut self.values, from.len());
        fit(&mut self.units, from.len().div_ceil(BLOCK));
        (from.par_chunks_mut(CHUNK))
            .zip(self.values.par_chunks_mut(CHUNK))
            .zip(self.units.par_chunks_mut(CHUNK / BLOCK))
            .for_each(|((from, values), units)| {
                dispatch(Rounding {
                    from,
                    values,
                    units,
                });
            });
    }

    /// `y += alpha self`.
    pub(crate) fn add_to(&self, y: &mut [f64], alpha: f64) {
        for_chunks(y, |start, part| {
            for (block, y) in part.chunks_mut(BLOCK).enumerate() {
                let (values, unit) = self.block(start / BLOCK + block);
                let factor = alpha * f64::from(unit);
                for (y, &value) in y.iter_mut().zip(values) {
                    *y += factor * f64::from(value);
                }
            }
        });
    }

    /// Values of one block, and their unit.
    #[inline(always)]
    pub(crate) fn block(&self, block: usize) -> (&[i16], Work) {
        let end = self.values.len().min((block + 1) * BLOCK);
        (&self.values[block * BLOCK..end], self.units[block])
    }
}

/// Gives `values` the length `len` without memory to spare: systems grow by little from step to step.
pub(crate) fn fit<T: Clone + Default>(values: &mut Vec<T>, len: usize) {
    values.truncate(len);
    values.reserve_exact(len - values.len());
    values.resize(len, T::default());
}

struct Rounding<'a> {
    from: &'a mut [Work],
    values: &'a mut [i16],
    units: &'a mut [Work],
}

impl Kernel for Rounding<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let blocks = self
            .from
            .chunks_mut(BLOCK)
            .zip(self.values.chunks_mut(BLOCK));
        for ((from, values), unit) in blocks.zip(self.units) {
            let largest = from.iter().fold(0.0, |most: Work, x| most.max(x.abs()));
            *unit = largest / UNITS;
            let inverse = if *unit >= Work::MIN_POSITIVE {
                1.0 / *unit
            } else {
                0.0
            };
            for (x, value) in from.iter_mut().zip(values) {
                let rounded = *x * inverse + ROUNDING;
                *value = rounded.to_bits() as i16;
                *x = (rounded - ROUNDING) * *unit;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Values over nine orders of magnitude, more than a chunk of them: kept to half a unit of their
    /// block, the same as they are given back, and added as they are kept.
    #[test]
    fn values_are_kept_to_half_a_unit_of_their_block() {
        let n = CHUNK + 3 * BLOCK + 5;
        let value = |i: usize| (0.7 * i as Work).sin() * 10f32.powi((i / BLOCK % 10) as i32 - 5);
        let mut given: Vec<Work> = (0..n).map(value).collect();
        let mut compact = Compact::default();
        compact.keep(&mut given);
        let mut sum = vec![1.0; n];
        compact.add_to(&mut sum, 3.0);
        for i in 0..n {
            let block = i / BLOCK * BLOCK..n.min((i / BLOCK + 1) * BLOCK);
            let largest = block.map(|j| value(j).abs()).fold(0.0, Work::max);
            let error = (given[i] - value(i)).abs();
            assert!(error <= 0.505 * largest / UNITS, "value {i}: {error:e}");
            let added = 1.0 + 3.0 * f64::from(given[i]);
            assert!((sum[i] - added).abs() < 1e-6 * f64::from(largest), "{i}");
        }
        compact.keep(&mut [0.0; 70]);
        let mut sum = [2.0; 70];
        compact.add_to(&mut sum, 1.0);
        assert_eq!(sum, [2.0; 70], "zeros stay zeros");
    }
}

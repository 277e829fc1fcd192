//! Products of packed rows.

use super::{FINE, LANES, Lanes, PackedRows, UNIT, WINDOW, entry};
use crate::simd::Kernel;
use crate::vector::{CHUNK, Work};

/// Use of the product of a block of eight rows.
pub(crate) trait Finish: Sync {
    /// Transforms an entry before the product.
    #[inline(always)]
    fn entry(value: i16) -> i16 {
        value
    }

    /// Combines the product of block `block` with the vector, whose values in that block are `here`, into `out`. Must be
    /// `#[inline(always)]`.
    fn finish(&self, block: usize, here: &Lanes, product: Lanes, out: &mut Lanes);
}

/// `(I + |M|) x`, with `M` the off-diagonal part.
pub(crate) struct Absolute;

impl Finish for Absolute {
    #[inline(always)]
    fn entry(value: i16) -> i16 {
        value.abs()
    }

    #[inline(always)]
    fn finish(&self, _: usize, here: &Lanes, product: Lanes, out: &mut Lanes) {
        *out = std::array::from_fn(|i| here[i] + product[i]);
    }
}

/// The product of consecutive rows of a chunk.
pub(super) struct Product<'a, F> {
    pub(super) rows: &'a PackedRows,
    /// Part of the vector within reach of the rows, from row `x_start` on.
    pub(super) x: &'a [Work],
    pub(super) x_start: usize,
    /// First block.
    pub(super) first: usize,
    pub(super) out: &'a mut [Lanes],
    pub(super) finish: &'a F,
}

impl<F: Finish> Kernel for Product<'_, F> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { rows, x, .. } = self;
        let (here, _) = x[self.first * LANES - self.x_start..].as_chunks::<LANES>();
        let of_chunk = self.first % (CHUNK / LANES);
        let (mut run, mut scattered) = rows.starts(of_chunk);
        let ends = (rows.run_end.iter().zip(&rows.scattered_end)).skip(of_chunk);
        for (block, (((&run_end, &scattered_end), out), here)) in
            ends.zip(self.out).zip(here).enumerate()
        {
            let mut sum = [0.0; LANES];
            for (base, values) in &rows.runs[run..run_end as usize] {
                let at = (*base as usize).wrapping_sub(self.x_start);
                let Some(x) = window::<_, LANES>(x, at) else {
                    continue;
                };
                for lane in 0..LANES {
                    sum[lane] += Work::from(F::entry(values[lane])) * x[lane];
                }
            }
            for (base, offsets, values) in &rows.scattered[scattered..scattered_end as usize] {
                // Masked offsets need no check per entry.
                let at = (*base as usize).wrapping_sub(self.x_start);
                let Some(x) = window::<_, WINDOW>(x, at) else {
                    continue;
                };
                for lane in 0..LANES {
                    sum[lane] +=
                        Work::from(F::entry(values[lane])) * x[offsets[lane] as usize % WINDOW];
                }
            }
            (run, scattered) = (run_end as usize, scattered_end as usize);
            let product = sum.map(|sum| sum * (1.0 / UNIT) as Work);
            self.finish.finish(self.first + block, here, product, out);
        }
    }
}

/// `N` values from index `at` on, if they exist.
#[inline(always)]
fn window<T, const N: usize>(x: &[T], at: usize) -> Option<&[T; N]> {
    let last = x.len().checked_sub(N)?;
    debug_assert!(at <= last, "{at} reaches beyond {last}");
    if at > last {
        return None;
    }
    x[at..at + N].first_chunk()
}

/// The off-diagonal part of one chunk of rows times `x`, with both numbers of the entries.
pub(super) struct FineProduct<'a> {
    pub(super) rows: &'a PackedRows,
    pub(super) x: &'a [f64],
    pub(super) out: &'a mut [f64],
}

impl Kernel for FineProduct<'_> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { rows, x, .. } = self;
        let (mut run, mut scattered) = (0, 0);
        let ends = rows.run_end.iter().zip(&rows.scattered_end);
        for ((&run_end, &scattered_end), out) in ends.zip(self.out.chunks_mut(LANES)) {
            let mut sum = [0.0; LANES];
            let here = run..run_end as usize;
            for ((base, high), rest) in rows.runs[here.clone()].iter().zip(&rows.runs_rest[here]) {
                let Some(x) = window::<_, LANES>(x, *base as usize) else {
                    continue;
                };
                for lane in 0..LANES {
                    sum[lane] += entry(high[lane], rest[lane]) * x[lane];
                }
            }
            let here = scattered..scattered_end as usize;
            let rests = &rows.scattered_rest[here.clone()];
            for ((base, offsets, high), rest) in rows.scattered[here].iter().zip(rests) {
                let Some(x) = window::<_, WINDOW>(x, *base as usize) else {
                    continue;
                };
                for lane in 0..LANES {
                    sum[lane] += entry(high[lane], rest[lane]) * x[offsets[lane] as usize % WINDOW];
                }
            }
            (run, scattered) = (run_end as usize, scattered_end as usize);
            for (out, sum) in out.iter_mut().zip(sum) {
                *out = sum * (1.0 / (UNIT * FINE));
            }
        }
    }
}

//! Products of packed rows.

use super::{FINE, LANES, PackedRows, UNIT, WINDOW, entry};
use crate::simd::Kernel;
use crate::vector::Work;

/// What is made of the product of a block of eight rows.
pub(crate) trait Finish: Sync {
    /// An entry as it counts.
    #[inline(always)]
    fn entry(value: i16) -> i16 {
        value
    }

    /// Takes the product of block `block`; must be `#[inline(always)]`.
    fn finish(&self, block: usize, product: [Work; LANES], out: &mut [Work; LANES]);
}

/// `(I + |M|) x` of a vector, with `M` the off-diagonal part.
pub(crate) struct Absolute<'a>(pub(crate) &'a [Work]);

impl Finish for Absolute<'_> {
    #[inline(always)]
    fn entry(value: i16) -> i16 {
        value.abs()
    }

    #[inline(always)]
    fn finish(&self, block: usize, product: [Work; LANES], out: &mut [Work; LANES]) {
        let here = &self.0.as_chunks::<LANES>().0[block];
        *out = std::array::from_fn(|i| here[i] + product[i]);
    }
}

/// The product of one chunk of rows.
pub(super) struct Product<'a, F> {
    pub(super) rows: &'a PackedRows,
    pub(super) x: &'a [Work],
    /// Block of the first row.
    pub(super) first: usize,
    pub(super) out: &'a mut [[Work; LANES]],
    pub(super) finish: &'a F,
}

impl<F: Finish> Kernel for Product<'_, F> {
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { rows, x, .. } = self;
        let (mut run, mut scattered) = (0, 0);
        let ends = rows.run_end.iter().zip(&rows.scattered_end);
        for (block, ((&run_end, &scattered_end), out)) in ends.zip(self.out).enumerate() {
            let mut sum = [0.0; LANES];
            for (base, values) in &rows.runs[run..run_end as usize] {
                let Some(x) = x[*base as usize..].first_chunk::<LANES>() else {
                    continue;
                };
                for lane in 0..LANES {
                    sum[lane] += Work::from(F::entry(values[lane])) * x[lane];
                }
            }
            for (base, offsets, values) in &rows.scattered[scattered..scattered_end as usize] {
                // A window as long as offsets reach needs no check per entry.
                let Some(x) = x[*base as usize..].first_chunk::<WINDOW>() else {
                    continue;
                };
                for lane in 0..LANES {
                    sum[lane] += Work::from(F::entry(values[lane])) * x[offsets[lane] as usize];
                }
            }
            (run, scattered) = (run_end as usize, scattered_end as usize);
            let product = sum.map(|sum| sum * (1.0 / UNIT) as Work);
            self.finish.finish(self.first + block, product, out);
        }
    }
}

/// The off-diagonal part times `x` of one chunk of rows, of both halves of the entries.
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
                let Some(x) = x[*base as usize..].first_chunk::<LANES>() else {
                    continue;
                };
                for lane in 0..LANES {
                    sum[lane] += entry(high[lane], rest[lane]) * x[lane];
                }
            }
            let here = scattered..scattered_end as usize;
            let rests = &rows.scattered_rest[here.clone()];
            for ((base, offsets, high), rest) in rows.scattered[here].iter().zip(rests) {
                let Some(x) = x[*base as usize..].first_chunk::<WINDOW>() else {
                    continue;
                };
                for lane in 0..LANES {
                    sum[lane] += entry(high[lane], rest[lane]) * x[offsets[lane] as usize];
                }
            }
            (run, scattered) = (run_end as usize, scattered_end as usize);
            for (out, sum) in out.iter_mut().zip(sum) {
                *out = sum * (1.0 / (UNIT * FINE));
            }
        }
    }
}

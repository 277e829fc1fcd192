//! A compact form of a scaled matrix, for products that are bound by memory.
//!
//! Entries of `D^-1/2 A D^-1/2` lie in [-1, 1] and are stored as two fixed-point numbers, of 16 and 32 bits. The first one
//! alone serves the preconditioner; both give products to 1e-14. Rows are stored in blocks of eight. Where several of the
//! eight couple at the same distance (the same neighbour along a grid line), one base column serves all eight, and their
//! values of `x` are contiguous. The rest share a base column and have 16-bit offsets. This takes 2.3 to 4.5 bytes per entry
//! (4 more for the second number) instead of 12 in plain rows, without a bounds check per entry. Successive products run in
//! waves ([`sweeps`]), so that rows are loaded from memory once for several of them.

mod packer;
mod product;
mod sweeps;

use rayon::prelude::*;

use crate::SolveError;
use crate::csr::Rows;
use crate::simd::dispatch;
use crate::vector::{CHUNK, Work};
use packer::Packer;
use product::FineProduct;

pub(crate) use product::{Absolute, Finish};

/// Rows of a block.
pub(crate) const LANES: usize = 8;
/// Rows multiplied by one task.
const PIECE: usize = 1 << 11;
/// Reach of an offset; vectors are padded with this many zeros.
const WINDOW: usize = 1 << 11;
/// Fixed-point unit, of 16 bits.
const UNIT: f64 = 32767.0;
/// Parts of a unit counted by the second number, of 32 bits.
const FINE: f64 = 4_294_967_296.0;

/// One value per row of a block.
pub(crate) type Lanes<T = Work> = [T; LANES];

/// First and second fixed-point numbers of eight values.
type Values = Lanes<i16>;
type Rests = Lanes<i32>;

/// A square matrix with unit diagonal, which is not stored.
pub(crate) struct PackedMatrix {
    n: usize,
    chunks: Vec<PackedRows>,
    /// Largest distance that a block of rows reads before its first or after its last row, zeros of its runs included.
    reach: usize,
    /// Largest entry of `A` off the diagonal.
    pub(crate) largest: f64,
}

/// The rows of one chunk in blocks of eight.
#[derive(Default)]
struct PackedRows {
    /// As in [`PackedMatrix`], for this chunk.
    reach: usize,
    largest: f64,
    /// End of every block in `runs` and in `scattered`.
    run_end: Vec<u32>,
    scattered_end: Vec<u32>,
    /// Couplings at equal distance: row `i` of the block to column `base + i`.
    runs: Vec<(u32, Values)>,
    /// Couplings anywhere: row `i` to column `base + offset_i`.
    scattered: Vec<(u32, [u16; LANES], Values)>,
    /// Second numbers of the values in both lists, in units of 1 / [`FINE`].
    runs_rest: Vec<Rests>,
    scattered_rest: Vec<Rests>,
}

impl PackedRows {
    /// Begin of block `block` in the two lists.
    fn starts(&self, block: usize) -> (usize, usize) {
        let of = |ends: &[u32]| {
            block
                .checked_sub(1)
                .map_or(0, |before| ends[before] as usize)
        };
        (of(&self.run_end), of(&self.scattered_end))
    }
}

/// The value of both numbers.
#[inline(always)]
fn entry(high: i16, rest: i32) -> f64 {
    f64::from(high) * FINE + f64::from(rest)
}

impl PackedMatrix {
    /// Packs `S A S` for the symmetric `a`, with `S = D^-1/2` in `scale`. Chunks of `a` are freed as they are packed.
    ///
    /// Fails if an entry exceeds one: `a` is then not positive definite.
    pub(crate) fn new(a: Vec<Rows<f64>>, scale: &[f64]) -> Result<Self, SolveError> {
        let pack = |(chunk, rows): (usize, Rows<f64>)| {
            let start = chunk * CHUNK;
            let mut packer = Packer::new(&rows, start, scale);
            for first in (start..start + rows.len()).step_by(LANES) {
                packer.pack_block(first)?;
            }
            Ok(packer.finish())
        };
        let packed = a.into_par_iter().enumerate().map(pack);
        let chunks: Vec<PackedRows> = packed.collect::<Result<_, _>>()?;
        Ok(Self {
            n: scale.len(),
            reach: chunks.iter().map(|rows| rows.reach).max().unwrap_or(0),
            largest: chunks.iter().map(|rows| rows.largest).fold(0.0, f64::max),
            chunks,
        })
    }

    /// Length of its vectors: number of rows and padding.
    pub(crate) fn padded_len(&self) -> usize {
        self.n.next_multiple_of(LANES) + WINDOW
    }

    /// `out = M x` in double precision, with `M` the off-diagonal part; `x` has the padded length.
    pub(crate) fn multiply_fine(&self, x: &[f64], out: &mut [f64]) {
        (self.chunks.par_iter())
            .zip(out.par_chunks_mut(CHUNK))
            .for_each(|(rows, out)| dispatch(FineProduct { rows, x, out }));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::csr::{Csr, RowEntries, assemble_chunks};

    struct Plain;

    impl Finish for Plain {
        fn finish(&self, _: usize, _: &Lanes, product: Lanes, out: &mut Lanes) {
            *out = product;
        }
    }

    /// Couplings at distance 1 and 300, and one to the mirrored row.
    fn fill(n: usize, row: usize, entries: &mut RowEntries) {
        entries.add(row, 5.0 + (row % 7) as f64);
        for distance in [1, 300] {
            if row >= distance {
                entries.add(row - distance, -1.0 - (row % 3) as f64);
            }
            if row + distance < n {
                entries.add(row + distance, 0.3 - (row % 5) as f64);
            }
        }
        entries.add(n - 1 - row, 0.7);
    }

    #[test]
    fn products_agree_with_plain_rows() {
        // More rows than a chunk and than the reach of an offset, and no multiple of eight.
        let n = 4 * CHUNK + 4467;
        let a: Csr<f64> = Csr::assemble(n, n, |row, entries| fill(n, row, entries)).unwrap();
        let rows = assemble_chunks(n, n, |row, entries| fill(n, row, entries));
        let scale: Vec<f64> = a.diagonal().iter().map(|d| 1.0 / d.sqrt()).collect();
        let packed = PackedMatrix::new(rows.unwrap(), &scale).unwrap();
        let mut x = vec![0.0; packed.padded_len()];
        for (i, x) in x[..n].iter_mut().enumerate() {
            *x = (0.1 * i as Work).sin();
        }
        let once = |sweep: &dyn Fn(&mut Vec<Work>, &mut Vec<Work>)| {
            let (mut now, mut out) = (x.clone(), vec![0.0; x.len()]);
            sweep(&mut now, &mut out);
            now
        };
        let plain = once(&|now, out| packed.sweep(now, out, &[Plain]));
        let absolute = once(&|now, out| packed.sweep(now, out, &[Absolute]));
        let wide: Vec<f64> = x.iter().map(|&x| x.into()).collect();
        let mut fine = vec![0.0; n];
        packed.multiply_fine(&wide, &mut fine);
        for row in 0..n {
            let (columns, values) = a.row(row);
            let (mut sum, mut absolute_sum) = (0.0, f64::from(x[row]));
            for (&column, &value) in columns.iter().zip(values) {
                let column = column as usize;
                if column != row {
                    let entry = value * scale[row] * scale[column];
                    sum += entry * f64::from(x[column]);
                    absolute_sum += entry.abs() * f64::from(x[column]);
                }
            }
            // Half a fixed-point unit per entry.
            assert!(
                (sum - f64::from(plain[row])).abs() < 6.0 * 0.5 / UNIT,
                "row {row}"
            );
            // Half a unit of the second number, or a whole one if it cannot be rounded up; and rounding.
            assert!(
                (sum - fine[row]).abs() < 6.0 / (UNIT * FINE) + 1e-15,
                "row {row}"
            );
            assert!((absolute_sum - f64::from(absolute[row])).abs() < 6.0 * 0.5 / UNIT);
        }
    }

    #[test]
    fn an_entry_above_the_diagonal_is_refused() {
        let rows = assemble_chunks(2, 2, |row, entries| {
            entries.add(row, 1.0);
            entries.add(1 - row, 1.5);
        });
        let error = PackedMatrix::new(rows.unwrap(), &[1.0, 1.0]).err();
        assert!(error.is_some_and(|e| e.to_string().contains("positive definite")));
    }
}

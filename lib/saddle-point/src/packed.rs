//! A compact copy of a scaled matrix for the preconditioner, whose products are memory-bound.
//!
//! Entries of `D^-1/2 A D^-1/2` lie in [-1, 1] and are kept as 16-bit fixed-point numbers. Rows
//! are taken eight at a time. Where several of the eight couple to the same distance (the same
//! neighbour along a grid line), one base column serves all eight and their values of `x` are
//! contiguous; the rest share a base column and keep 16-bit offsets. That is 2.3 to 4.5 bytes
//! per entry instead of 8 in plain rows, and no bounds check per entry.

use rayon::prelude::*;

use crate::SolveError;
use crate::csr::Csr;
use crate::vector::{CHUNK, Work};

/// Rows handled together.
pub(crate) const LANES: usize = 8;
/// Reach of a 16-bit offset; vectors carry this many zeros behind their last value.
const WINDOW: usize = 1 << 16;
/// Fixed-point unit.
const UNIT: f64 = 32767.0;
/// Couplings at one distance among eight rows from which a common base pays.
const MIN_RUN: usize = 4;

/// Eight fixed-point values.
type Values = [i16; LANES];

/// A square matrix with unit diagonal, which is not stored.
pub(crate) struct PackedMatrix {
    n: usize,
    chunks: Vec<PackedRows>,
}

/// The rows of one chunk in blocks of eight.
#[derive(Default)]
struct PackedRows {
    /// End of every block in the two lists below.
    run_end: Vec<u32>,
    scattered_end: Vec<u32>,
    /// Couplings at equal distance: row `i` of the block to column `base + i`.
    runs: Vec<(u32, Values)>,
    /// Couplings anywhere: row `i` to column `base + offset_i`.
    scattered: Vec<(u32, [u16; LANES], Values)>,
}

impl PackedMatrix {
    /// Packs `S A S` for the symmetric `a` and `S = D^-1/2` given in `scale`.
    ///
    /// Fails when an entry exceeds one: then `a` is not positive definite.
    pub(crate) fn new(a: &Csr<f64>, scale: &[f64]) -> Result<Self, SolveError> {
        let n = a.n_rows();
        let chunks = (0..n.div_ceil(CHUNK))
            .into_par_iter()
            .map(|chunk| {
                let mut packer = Packer::new(a, scale);
                for first in (chunk * CHUNK..n.min((chunk + 1) * CHUNK)).step_by(LANES) {
                    packer.pack_block(first)?;
                }
                Ok(packer.rows)
            })
            .collect::<Result<_, _>>()?;
        Ok(Self { n, chunks })
    }

    /// Length of the vectors it multiplies: rows, then zeros.
    pub(crate) fn padded_len(&self) -> usize {
        self.n.next_multiple_of(LANES) + WINDOW
    }

    /// Calls `update(first row, off-diagonal part times x, out)` for every block of eight rows;
    /// `x` and `out` have the padded length.
    pub(crate) fn for_blocks(
        &self,
        x: &[Work],
        out: &mut [Work],
        update: impl Fn(usize, [Work; LANES], &mut [Work; LANES]) + Sync,
    ) {
        self.for_chunks(out, |rows, start, blocks| {
            rows.multiply(
                x,
                |value| value,
                |block, product| {
                    update(start + block * LANES, product, &mut blocks[block]);
                },
            );
        });
    }

    /// `out = (I + |M|) x` with `M` the off-diagonal part; both of the padded length.
    pub(crate) fn multiply_absolute(&self, x: &[Work], out: &mut [Work]) {
        self.for_chunks(out, |rows, start, blocks| {
            rows.multiply(x, i16::abs, |block, product| {
                let here = &x[start + block * LANES..];
                for (i, out) in blocks[block].iter_mut().enumerate() {
                    *out = here[i] + product[i];
                }
            });
        });
    }

    fn for_chunks(
        &self,
        out: &mut [Work],
        work: impl Fn(&PackedRows, usize, &mut [[Work; LANES]]) + Sync,
    ) {
        let rows = &mut out[..self.n.next_multiple_of(LANES)];
        let (blocks, _) = rows.as_chunks_mut::<LANES>();
        (self.chunks.par_iter())
            .zip(blocks.par_chunks_mut(CHUNK / LANES))
            .enumerate()
            .for_each(|(chunk, (packed, blocks))| work(packed, chunk * CHUNK, blocks));
    }
}

impl PackedRows {
    /// Calls `store(block, product)` with every block's rows times `x`, entries passed through
    /// `value`.
    #[inline(always)]
    fn multiply(
        &self,
        x: &[Work],
        value: impl Fn(i16) -> i16,
        mut store: impl FnMut(usize, [Work; LANES]),
    ) {
        let (mut run, mut scattered) = (0, 0);
        let ends = self.run_end.iter().zip(&self.scattered_end);
        for (block, (&run_end, &scattered_end)) in ends.enumerate() {
            let mut sum = [0.0; LANES];
            for (base, values) in &self.runs[run..run_end as usize] {
                let Some(x) = x[*base as usize..].first_chunk::<LANES>() else {
                    continue;
                };
                for lane in 0..LANES {
                    sum[lane] += Work::from(value(values[lane])) * x[lane];
                }
            }
            for (base, offsets, values) in &self.scattered[scattered..scattered_end as usize] {
                // A window as long as offsets reach needs no check per entry.
                let Some(x) = x[*base as usize..].first_chunk::<WINDOW>() else {
                    continue;
                };
                for lane in 0..LANES {
                    sum[lane] += Work::from(value(values[lane])) * x[offsets[lane] as usize];
                }
            }
            (run, scattered) = (run_end as usize, scattered_end as usize);
            store(block, sum.map(|sum| sum * (1.0 / UNIT) as Work));
        }
    }
}

/// Packs one block of rows after the other.
struct Packer<'a> {
    a: &'a Csr<f64>,
    scale: &'a [f64],
    rows: PackedRows,
    /// Entries of every lane that found no run, columns ascending.
    left: [Vec<(u32, i16)>; LANES],
}

impl<'a> Packer<'a> {
    fn new(a: &'a Csr<f64>, scale: &'a [f64]) -> Self {
        Self {
            a,
            scale,
            rows: PackedRows::default(),
            left: Default::default(),
        }
    }

    fn pack_block(&mut self, first: usize) -> Result<(), SolveError> {
        self.left.iter_mut().for_each(Vec::clear);
        let mut lanes: [(&[u32], &[f64]); LANES] = Default::default();
        for (row, lane) in (first..self.a.n_rows()).zip(&mut lanes) {
            *lane = self.a.row(row);
        }
        while let Some(distance) = nearest(first, &lanes) {
            let mut values = [0; LANES];
            let mut members = [None; LANES];
            for (i, lane) in lanes.iter_mut().enumerate() {
                let row = first + i;
                if next_distance(row, lane) == Some(distance) {
                    let column = lane.0[0];
                    values[i] = self.fixed_point(row, column as usize, lane.1[0])?;
                    members[i] = Some(column);
                    *lane = (&lane.0[1..], &lane.1[1..]);
                }
            }
            if distance == 0 {
                continue;
            }
            let base = u32::try_from(first as i64 + distance);
            match base {
                Ok(base) if members.iter().flatten().count() >= MIN_RUN => {
                    self.rows.runs.push((base, values));
                }
                _ => {
                    for (i, column) in members.into_iter().enumerate() {
                        self.left[i].extend(column.map(|column| (column, values[i])));
                    }
                }
            }
        }
        self.scatter();
        self.rows.run_end.push(self.rows.runs.len() as u32);
        self.rows
            .scattered_end
            .push(self.rows.scattered.len() as u32);
        Ok(())
    }

    /// Packs the entries left without a run: per slot one entry of every lane within reach of the
    /// lowest column.
    fn scatter(&mut self) {
        let mut next = [0; LANES];
        loop {
            let heads = self.left.iter().zip(next).map(|(left, at)| left.get(at));
            let Some(base) = heads.flatten().map(|entry| entry.0).min() else {
                return;
            };
            let mut offsets = [0; LANES];
            let mut values = [0; LANES];
            for (i, left) in self.left.iter().enumerate() {
                if let Some(&(column, value)) = left.get(next[i])
                    && let Ok(offset) = u16::try_from(column - base)
                {
                    offsets[i] = offset;
                    values[i] = value;
                    next[i] += 1;
                }
            }
            self.rows.scattered.push((base, offsets, values));
        }
    }

    fn fixed_point(&self, row: usize, column: usize, value: f64) -> Result<i16, SolveError> {
        let scaled = value * self.scale[row] * self.scale[column];
        if scaled.abs() > 1.0 + 1e-9 {
            return Err(SolveError::Matrix(format!(
                "entry {value} at row {row}, column {column} exceeds the diagonal; the velocity \
                 block must be positive definite"
            )));
        }
        Ok((scaled * UNIT).round() as i16)
    }
}

/// Column minus row of a lane's next entry.
fn next_distance(row: usize, lane: &(&[u32], &[f64])) -> Option<i64> {
    lane.0.first().map(|&column| i64::from(column) - row as i64)
}

/// The least distance among the next entries of all lanes.
fn nearest(first: usize, lanes: &[(&[u32], &[f64]); LANES]) -> Option<i64> {
    let distances = lanes.iter().enumerate();
    distances
        .filter_map(|(i, lane)| next_distance(first + i, lane))
        .min()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Neighbours at distance 1 and 300, and one far away in the mirrored row.
    fn matrix(n: usize) -> Csr<f64> {
        let matrix = Csr::assemble(n, n, |row, entries| {
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
        });
        matrix.unwrap()
    }

    #[test]
    fn products_agree_with_plain_rows() {
        // More rows than an offset reaches, and not a multiple of eight.
        let n = WINDOW + 4467;
        let a = matrix(n);
        let scale: Vec<f64> = a.diagonal().iter().map(|d| 1.0 / d.sqrt()).collect();
        let packed = PackedMatrix::new(&a, &scale).unwrap();
        let mut x = vec![0.0; packed.padded_len()];
        for (i, x) in x[..n].iter_mut().enumerate() {
            *x = (0.1 * i as Work).sin();
        }
        let (mut plain, mut absolute) = (vec![0.0; x.len()], vec![0.0; x.len()]);
        packed.for_blocks(&x, &mut plain, |_, product, out| *out = product);
        packed.multiply_absolute(&x, &mut absolute);
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
            assert!((absolute_sum - f64::from(absolute[row])).abs() < 6.0 * 0.5 / UNIT);
        }
    }

    #[test]
    fn an_entry_above_the_diagonal_is_refused() {
        let a = Csr::assemble(2, 2, |row, entries| {
            entries.add(row, 1.0);
            entries.add(1 - row, 1.5);
        });
        let error = PackedMatrix::new(&a.unwrap(), &[1.0, 1.0]).err();
        assert!(error.is_some_and(|e| e.to_string().contains("positive definite")));
    }
}

//! Packing of the rows of a matrix in blocks of eight.

use super::{FINE, LANES, PackedRows, UNIT, WINDOW};
use crate::SolveError;
use crate::csr::Rows;

/// Least number of couplings at one distance among eight rows for which a run is faster.
const MIN_RUN: usize = 4;

/// A fixed-point entry: `high + rest / FINE` units.
#[derive(Clone, Copy, Default)]
struct Fixed {
    high: i16,
    rest: i32,
}

/// Packs the blocks of a chunk in order.
pub(super) struct Packer<'a> {
    chunk: &'a Rows<f64>,
    /// Its first row.
    start: usize,
    scale: &'a [f64],
    rows: PackedRows,
    /// Entries of every lane that are in no run, columns ascending.
    scattered: [Vec<(u32, Fixed)>; LANES],
}

impl<'a> Packer<'a> {
    pub(super) fn new(chunk: &'a Rows<f64>, start: usize, scale: &'a [f64]) -> Self {
        Self {
            chunk,
            start,
            scale,
            rows: PackedRows::default(),
            scattered: Default::default(),
        }
    }

    pub(super) fn pack_block(&mut self, first: usize) -> Result<(), SolveError> {
        self.scattered.iter_mut().for_each(Vec::clear);
        let mut lanes: [(&[u32], &[f64]); LANES] = Default::default();
        for (row, lane) in (first - self.start..self.chunk.len()).zip(&mut lanes) {
            *lane = self.chunk.row(row);
        }
        let mut next: [i64; LANES] = std::array::from_fn(|i| next_distance(first + i, lanes[i].0));
        loop {
            let distance = next.into_iter().fold(i64::MAX, i64::min);
            if distance == i64::MAX {
                break;
            }
            let mut values = [Fixed::default(); LANES];
            let mut members = [None; LANES];
            for (i, lane) in lanes.iter_mut().enumerate() {
                if next[i] == distance {
                    let row = first + i;
                    let column = lane.0[0];
                    values[i] = self.fixed_point(row, column as usize, lane.1[0])?;
                    members[i] = Some(column);
                    if distance != 0 {
                        self.rows.largest = self.rows.largest.max(lane.1[0].abs());
                    }
                    *lane = (&lane.0[1..], &lane.1[1..]);
                    next[i] = next_distance(row, lane.0);
                }
            }
            if distance == 0 {
                continue;
            }
            let base = u32::try_from(first as i64 + distance);
            match base {
                Ok(base) if members.iter().flatten().count() >= MIN_RUN => {
                    self.rows.runs.push((base, values.map(|value| value.high)));
                    (self.rows.runs_rest).push(values.map(|value| value.rest));
                }
                _ => {
                    for (i, column) in members.into_iter().enumerate() {
                        self.scattered[i].extend(column.map(|column| (column, values[i])));
                    }
                }
            }
        }
        self.scatter();
        self.extend_reach(first);
        self.rows.run_end.push(self.rows.runs.len() as u32);
        self.rows
            .scattered_end
            .push(self.rows.scattered.len() as u32);
        Ok(())
    }

    /// The packed rows, without spare memory.
    pub(super) fn finish(self) -> PackedRows {
        let mut rows = self.rows;
        rows.runs.shrink_to_fit();
        rows.scattered.shrink_to_fit();
        rows.runs_rest.shrink_to_fit();
        rows.scattered_rest.shrink_to_fit();
        rows
    }

    /// Packs the entries that are in no run: each slot takes one entry per lane within reach of the lowest column.
    fn scatter(&mut self) {
        let mut next = [0; LANES];
        loop {
            let heads = self
                .scattered
                .iter()
                .zip(next)
                .map(|(scattered, at)| scattered.get(at));
            let Some(base) = heads.flatten().map(|entry| entry.0).min() else {
                return;
            };
            let mut offsets = [0; LANES];
            let mut values = [Fixed::default(); LANES];
            for (i, scattered) in self.scattered.iter().enumerate() {
                if let Some(&(column, value)) = scattered.get(next[i])
                    && ((column - base) as usize) < WINDOW
                {
                    offsets[i] = (column - base) as u16;
                    values[i] = value;
                    next[i] += 1;
                }
            }
            let high = values.map(|value| value.high);
            self.rows.scattered.push((base, offsets, high));
            (self.rows.scattered_rest).push(values.map(|value| value.rest));
        }
    }

    /// Extends the reach by that of the last block, which begins at row `first`.
    fn extend_reach(&mut self, first: usize) {
        let (run, place) = (self.rows.run_end.last(), self.rows.scattered_end.last());
        let of = |end: Option<&u32>| end.map_or(0, |&end| end as usize);
        let runs = self.rows.runs[of(run)..].iter().map(|run| (run.0, LANES));
        let scattered = (self.rows.scattered[of(place)..].iter()).map(|run| (run.0, WINDOW));
        for (base, length) in runs.chain(scattered) {
            let base = base as usize;
            let reach = first
                .saturating_sub(base)
                .max((base + length).saturating_sub(first + LANES));
            self.rows.reach = self.rows.reach.max(reach);
        }
    }

    fn fixed_point(&self, row: usize, column: usize, value: f64) -> Result<Fixed, SolveError> {
        let scaled = value * self.scale[row] * self.scale[column];
        if scaled.abs() > 1.0 + 1e-9 {
            return Err(SolveError::Matrix(format!(
                "entry {value} at row {row}, column {column} exceeds the diagonal; the velocity \
                 block must be positive definite"
            )));
        }
        let units = scaled * UNIT;
        let high = nearest_integer(units) as i16;
        Ok(Fixed {
            high,
            rest: nearest_integer((units - f64::from(high)) * FINE) as i32,
        })
    }
}

/// Rounds half away from zero. A cast then saturates instead of overflowing.
fn nearest_integer(value: f64) -> f64 {
    value + 0.5f64.copysign(value)
}

/// Column minus row of a lane's next entry; the largest number if there is none.
fn next_distance(row: usize, columns: &[u32]) -> i64 {
    (columns.first()).map_or(i64::MAX, |&column| i64::from(column) - row as i64)
}

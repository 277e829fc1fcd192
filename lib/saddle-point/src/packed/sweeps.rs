//! Successive products in waves.
//!
//! A sweep reads the last iterate and overwrites the one before it. A row needs the last iterate only as far as its
//! couplings reach, so the next sweep can follow at that distance while the rows are still in the cache. A wave therefore
//! runs several sweeps, each a little behind the one before. It reads and writes separate parts of the two vectors, and
//! every row is computed as in a plain sweep: the same bits in any order.

use std::mem::{swap, take};

use rayon::prelude::*;

use super::product::{Finish, Product};
use super::{LANES, PIECE, PackedMatrix};
use crate::simd::dispatch;
use crate::vector::{CHUNK, Work};

/// Sweeps in one wave. This is the fastest: a product of 1.5 million rows takes 6.4 to 7.2 ms without waves, 5.1 ms in waves
/// of 4, 4.8 of 8, 4.9 of 12 and 7.1 of 23.
const DEPTH: usize = 8;
/// Tiles in the reach of a row. Smaller tiles let sweeps follow more closely, but leave less work for the threads to share.
const TILES_IN_REACH: usize = 5;

impl PackedMatrix {
    /// For each of `sweeps`: multiplies `now` by the off-diagonal part, lets the sweep combine the product of every block into
    /// `before`, and swaps the two. Both have the padded length.
    pub(crate) fn sweep<F: Finish>(
        &self,
        now: &mut Vec<Work>,
        before: &mut Vec<Work>,
        sweeps: &[F],
    ) {
        for sweeps in sweeps.chunks(DEPTH) {
            let waves = Waves::new(self, sweeps);
            for wave in 0..waves.len() {
                waves.run(wave, now, before);
            }
            if sweeps.len() % 2 == 1 {
                swap(now, before);
            }
        }
    }
}

/// Sweeps over tiles of rows, each a fixed number of tiles behind the one before.
struct Waves<'a, F> {
    matrix: &'a PackedMatrix,
    sweeps: &'a [F],
    /// Rows of a tile, and number of tiles that it reads before and after its own.
    rows: usize,
    tiles_reached: usize,
}

/// A tile of one sweep: it reads `x`, from row `x_start` on, and writes `out`, from row `first` on.
struct Tile<'a, F> {
    sweep: &'a F,
    x: &'a [Work],
    x_start: usize,
    out: &'a mut [Work],
    first: usize,
}

impl<'a, F: Finish> Waves<'a, F> {
    fn new(matrix: &'a PackedMatrix, sweeps: &'a [F]) -> Self {
        // A single sweep needs no waves: one tile, shared by all threads.
        let rows = match sweeps {
            [_] => matrix.n,
            _ => matrix.reach.div_ceil(TILES_IN_REACH),
        };
        let rows = rows.next_multiple_of(PIECE).max(PIECE);
        Self {
            matrix,
            sweeps,
            rows,
            tiles_reached: matrix.reach.div_ceil(rows),
        }
    }

    /// Distance between successive sweeps, tiles.
    fn lag(&self) -> usize {
        self.tiles_reached + 1
    }

    fn len(&self) -> usize {
        self.matrix.n.div_ceil(self.rows) + (self.sweeps.len() - 1) * self.lag()
    }

    /// Runs one tile of each active sweep.
    fn run(&self, wave: usize, now: &mut [Work], before: &mut [Work]) {
        let tiles = self.tiles(wave, now, before);
        let pieces = tiles.into_iter().flat_map(|tile| {
            let rows = (tile.first..).step_by(PIECE);
            rows.zip(tile.out.chunks_mut(PIECE))
                .map(move |(row, out)| Product {
                    rows: &self.matrix.chunks[row / CHUNK],
                    first: row / LANES,
                    x: tile.x,
                    x_start: tile.x_start,
                    out: out.as_chunks_mut::<LANES>().0,
                    finish: tile.sweep,
                })
        });
        let pieces: Vec<_> = pieces.collect();
        pieces.into_par_iter().for_each(dispatch);
    }

    /// The tiles of a wave. Their parts of both vectors are cut off from the end on.
    fn tiles<'v>(
        &self,
        wave: usize,
        now: &'v mut [Work],
        before: &'v mut [Work],
    ) -> Vec<Tile<'v, F>>
    where
        'a: 'v,
    {
        let rows = self.matrix.n.next_multiple_of(LANES);
        let mut rest = [now, before];
        let mut tiles = Vec::with_capacity(self.sweeps.len());
        for (j, sweep) in self.sweeps.iter().enumerate() {
            let first = (wave.checked_sub(j * self.lag())).map_or(rows, |tile| tile * self.rows);
            if first >= rows {
                continue;
            }
            let end = (first + self.rows).min(rows);
            let reach = self.tiles_reached * self.rows;
            let x_start = first.saturating_sub(reach);
            let x = cut_off(&mut rest[j % 2], x_start, end + reach);
            let out = cut_off(&mut rest[(j + 1) % 2], first, end);
            tiles.push(Tile {
                sweep,
                x,
                x_start,
                out,
                first,
            });
        }
        tiles
    }
}

/// Cuts `start..end`, as far as it exists, off the end of `rest`.
fn cut_off<'v>(rest: &mut &'v mut [Work], start: usize, end: usize) -> &'v mut [Work] {
    let (before, part) = take(rest).split_at_mut(start);
    *rest = before;
    let end = part.len().min(end - start);
    &mut part[..end]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::csr::assemble_chunks;
    use crate::packed::Lanes;

    /// A step that depends on the row, its last iterate and the one before.
    struct Mix(Work);

    impl Finish for Mix {
        fn finish(&self, block: usize, here: &Lanes, product: Lanes, out: &mut Lanes) {
            for (i, out) in out.iter_mut().enumerate() {
                *out = 0.3 * here[i] - 0.2 * *out + self.0 * product[i] + (block % 5) as Work;
            }
        }
    }

    /// Sweeps in waves give the same bits as plain sweeps, for rows that reach part of a tile, several tiles, unevenly,
    /// irregularly, and from one end to the other; for fewer sweeps than a wave and for more.
    #[test]
    fn sweeps_in_waves_are_sweeps_one_by_one() {
        const N: usize = 3 * CHUNK + 5 * PIECE + 21;
        let reaches: [fn(usize) -> usize; 5] = [
            |row| row ^ 1,
            |row| row + 11_000,
            |row| row + (row % 2) * (2 * PIECE + 1),
            |row| row + row * row % 1_999,
            |row| N - 1 - row,
        ];
        for reach in reaches {
            let rows = assemble_chunks(N, N, |row, entries| {
                entries.add(row, 1.0);
                for (column, value) in [
                    (reach(row), 0.4),
                    (row + 1, 0.3),
                    (row.wrapping_sub(1), 0.3),
                ] {
                    if column < N && column != row {
                        entries.add(
                            column,
                            value * (1.0 + (row + column) as f64 / N as f64) / 3.0,
                        );
                    }
                }
            });
            let matrix = PackedMatrix::new(rows.unwrap(), &vec![1.0; N]).unwrap();
            for count in [1, 2, DEPTH, 2 * DEPTH + 3] {
                let sweeps: Vec<_> = (0..count).map(|i| Mix(0.1 + 0.05 * i as Work)).collect();
                let start: Vec<Work> = (0..matrix.padded_len())
                    .map(|i| if i < N { (0.01 * i as Work).sin() } else { 0.0 })
                    .collect();
                let (mut now, mut before) = (start.clone(), start.clone());
                matrix.sweep(&mut now, &mut before, &sweeps);
                let (mut one, mut last) = (start.clone(), start);
                for sweep in sweeps.chunks(1) {
                    matrix.sweep(&mut one, &mut last, sweep);
                }
                assert!(now[..N] == one[..N] && before[..N] == last[..N]);
            }
        }
    }
}

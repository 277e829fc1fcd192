//! The grid in tiles of 4 x 4 x 4 nodes, so that threads share no sum.
//!
//! Points lie in the tile of their nearest node. They sum into the tile's *halo*, its nodes and one
//! more on each side; a block of nodes then adds the halos around it in the order of the tiles, which
//! makes every sum the same for any number of threads.

use std::ops::Range;

use physics::Failure;

use super::points::{Point, Points};
use super::{EDGE, HALO};
use crate::lanes::Lanes8;

/// Velocities or sums of the 4 x 4 x 4 nodes of a tile.
pub(super) type Block = [Lanes8; EDGE * EDGE * EDGE];

/// Points, and the nodes that they reach.
#[derive(Clone, Debug, Default)]
pub(super) struct Tile {
    pub(super) points: Points,
    /// Sums over the points, later velocities, of 6 x 6 x 6 nodes; empty before the first point.
    pub(super) halo: Vec<Lanes8>,
    /// Points that leave the tile, with their nearest nodes from its lowest one.
    pub(super) leaving: Vec<([i32; 3], Point)>,
}

/// The tiles of the domain; the outer ones stay empty.
pub(super) struct Tiles {
    /// Tiles along x, y, z.
    counts: [usize; 3],
}

impl Tiles {
    pub(super) fn new(cells: [usize; 3]) -> Self {
        Self {
            counts: cells.map(|n| n / EDGE + 1),
        }
    }

    pub(super) fn count(&self) -> usize {
        self.counts.iter().product()
    }

    /// Steps in the list of tiles to the next along x, y, z.
    fn steps(&self) -> [usize; 3] {
        [1, self.counts[0], self.counts[0] * self.counts[1]]
    }

    /// The tiles that can hold points, and some more; all have 26 neighbours.
    pub(super) fn inner(&self) -> Range<usize> {
        let reach: usize = self.steps().iter().sum();
        reach..(self.count() - reach).max(reach)
    }

    /// The lowest node of tile `t`.
    pub(super) fn origin(&self, t: usize) -> [i32; 3] {
        let [_, y, z] = self.steps();
        [t % y, t % z / y, t / z].map(|tile| (tile * EDGE) as i32)
    }

    /// Puts a point into the tile of its nearest node.
    ///
    /// # Errors
    /// When that tile is an outer one.
    pub(super) fn insert(
        &self,
        tiles: &mut [Tile],
        node: [i32; 3],
        point: Point,
    ) -> Result<(), Failure> {
        let along = node.map(|n| n as usize / EDGE);
        if (0..3).any(|a| along[a] < 1 || along[a] + 1 >= self.counts[a]) {
            let id = point.id;
            return Err(Failure(format!(
                "liquid point {id} is at a side of the domain"
            )));
        }
        let steps = self.steps();
        let tile = &mut tiles[(0..3).map(|a| along[a] * steps[a]).sum::<usize>()];
        tile.halo.resize(HALO * HALO * HALO, Lanes8::ZERO);
        tile.points.push(node.map(|n| n % EDGE as i32), point);
        Ok(())
    }

    /// Tile `t` and its 26 neighbours in order, with where they lie: 0, 1 or 2 along each axis.
    fn around(&self, t: usize) -> impl Iterator<Item = (usize, [usize; 3])> {
        let steps = self.steps();
        let first = t - steps.iter().sum::<usize>();
        (0..27).map(move |i| {
            let d = [i % 3, i / 3 % 3, i / 9];
            (first + (0..3).map(|a| d[a] * steps[a]).sum::<usize>(), d)
        })
    }

    /// Sums of all points at the nodes of block `b`.
    pub(super) fn sums(&self, b: usize, tiles: &[Tile]) -> Block {
        let mut sums = [Lanes8::ZERO; EDGE * EDGE * EDGE];
        for (t, d) in self.around(b) {
            let Tile { points, halo, .. } = &tiles[t];
            if !points.id.is_empty() {
                each_row(d, |nodes, entries| {
                    for (sum, more) in sums[nodes].iter_mut().zip(&halo[entries]) {
                        *sum = sum.plus::<false>(*more);
                    }
                });
            }
        }
        sums
    }

    /// Copies the velocities of the nodes around to the halo of tile `t`.
    pub(super) fn gather(&self, t: usize, tile: &mut Tile, blocks: &[Block]) {
        if !tile.points.id.is_empty() {
            for (b, d) in self.around(t) {
                // Seen from the block, the tile lies on the other side.
                each_row(d.map(|d| 2 - d), |nodes, entries| {
                    tile.halo[entries].copy_from_slice(&blocks[b][nodes]);
                });
            }
        }
    }
}

/// Rows of nodes along x that a block shares with the halo of a tile at `d` (0 below, 1 at the block
/// itself, 2 above, along each axis): the nodes in the block, and the entries of the halo.
#[inline(always)]
fn each_row(d: [usize; 3], mut see: impl FnMut(Range<usize>, Range<usize>)) {
    // First node in the block, first entry in the halo, how many.
    let shared = [[0, EDGE + 1, 1], [0, 1, EDGE], [EDGE - 1, 0, 1]];
    let [x, y, z] = d.map(|d| shared[d]);
    for k in 0..z[2] {
        for j in 0..y[2] {
            let node = ((z[0] + k) * EDGE + y[0] + j) * EDGE + x[0];
            let entry = ((z[1] + k) * HALO + y[1] + j) * HALO + x[1];
            see(node..node + x[2], entry..entry + x[2]);
        }
    }
}

//! Re-entrant edges of voxels: along them solid fills one quadrant and three are open.

use std::ops::Deref;

use super::block::for_each;
use super::placed::Placed;
use super::rows::Rows;
use super::{Boundary, Solids};

/// Blocks of finer voxels (cells) have no edges here: their steps lie within a cell.
const FINEST: f64 = 0.45;
/// Walls are followed for so many cells.
pub(crate) const LONG: f64 = 3.0;
/// Distance (cells) at which the quadrants around an edge are probed for other blocks.
const PROBE: f64 = 1e-3;

/// A re-entrant edge, in the plane across it; the two directions in this plane in ascending order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Reentrant {
    /// Where it is, cells.
    pub(crate) at: [f64; 2],
    /// Whether its solid is above it.
    pub(crate) above: [bool; 2],
    /// Length of the shorter of its two walls up to their next step, cells, at most [`LONG`].
    pub(crate) straight: f64,
}

/// How far a wall of an edge runs in its block.
#[derive(Clone, Copy, Debug)]
struct Run {
    /// Cells; from [`LONG`] on it does not matter.
    length: f64,
    /// Whether the block ends there.
    to_end: bool,
}

/// A rectangle in the plane across an axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Across {
    pub(crate) axis: usize,
    /// Where it lies along the axis, cells.
    pub(crate) along: f64,
    pub(crate) low: [f64; 2],
    pub(crate) high: [f64; 2],
}

impl Solids {
    /// Adds the re-entrant edges that cross a rectangle, and the images of those whose images beyond symmetry planes do.
    pub(crate) fn reentrant(&self, across: &Across, found: &mut Vec<Reentrant>) {
        let [firsts, seconds] = [0, 1].map(|n| self.planes(across, n));
        for first in firsts {
            for second in seconds.clone() {
                let planes = [first, second];
                let mut image = *across;
                for (n, plane) in planes.into_iter().enumerate() {
                    if let Some(plane) = plane {
                        let [low, high] = [across.low[n], across.high[n]];
                        (image.low[n], image.high[n]) = (2.0 * plane - high, 2.0 * plane - low);
                    }
                }
                self.inside(&image, |mut edge| {
                    for (n, plane) in planes.into_iter().enumerate() {
                        if let Some(plane) = plane {
                            edge.at[n] = 2.0 * plane - edge.at[n];
                            edge.above[n] = !edge.above[n];
                        }
                    }
                    found.push(edge);
                });
            }
        }
    }

    /// None, and the symmetry planes across the `n`-th direction of a rectangle that it reaches beyond.
    fn planes(
        &self,
        across: &Across,
        n: usize,
    ) -> impl Iterator<Item = Option<f64>> + Clone + use<> {
        let axis = ACROSS[across.axis][n];
        let [low, high] = [across.low[n], across.high[n]];
        let mirrors = self.domain.boundary[axis] == Boundary::Symmetry;
        let crossed = move |plane: &f64| mirrors && low < *plane && *plane < high;
        let planes = [0.0, self.domain.cells[axis] as f64].into_iter();
        std::iter::once(None).chain(planes.filter(crossed).map(Some))
    }

    /// The re-entrant edges in the domain that cross a rectangle.
    fn inside(&self, across: &Across, mut found: impl FnMut(Reentrant)) {
        let [low, high] = across.corners();
        for_each!(block in &self.periods, &self.blocks, low, high => {
            block.reentrant(across, |mut edge, runs| {
                if self.is_free(block, across, &edge) {
                    let straight = [0, 1].map(|n| self.run(block, across, &edge, n, runs[n]));
                    edge.straight = straight[0].min(straight[1]);
                    found(edge);
                }
            });
        });
    }

    /// How far the wall of an edge of `block` runs along the `n`-th direction across without a step, if `run` is how far it does in
    /// the block: on in the next block, and beyond a symmetry plane.
    fn run(
        &self,
        block: &Placed<impl Deref<Target = Rows>>,
        across: &Across,
        edge: &Reentrant,
        n: usize,
        run: Run,
    ) -> f64 {
        let axes = ACROSS[across.axis];
        let (axis, end) = (axes[n], self.domain.cells[axes[n]] as f64);
        let to_plane = match (self.domain.boundary[axis], edge.above[n]) {
            (Boundary::Symmetry, true) => end - edge.at[n],
            (Boundary::Symmetry, false) => edge.at[n],
            _ => f64::INFINITY,
        };
        let mut length = run.length.min(to_plane);
        if length == run.length && !run.to_end {
            return length.min(LONG);
        }
        let sign = |above: bool| if above { 1.0 } else { -1.0 };
        let solid = |along: f64, into: f64| {
            let mut point = [across.along; 3];
            point[axis] = edge.at[n] + sign(edge.above[n]) * along;
            point[axes[1 - n]] = edge.at[1 - n] + sign(edge.above[1 - n]) * into;
            if self.domain.boundary[axis] == Boundary::Symmetry {
                let x = point[axis].abs();
                point[axis] = if x > end { 2.0 * end - x } else { x };
            }
            self.at(point).is_some()
        };
        let step = block.edge[axis].min(0.5);
        let middle = |length: f64| length + 0.5 * step;
        while length < LONG && solid(middle(length), PROBE) && !solid(middle(length), -PROBE) {
            length += step;
        }
        length.min(LONG)
    }

    /// Whether an edge of a block is on no symmetry plane and no other block is in its open quadrants.
    fn is_free(
        &self,
        own: &Placed<impl Deref<Target = Rows>>,
        across: &Across,
        edge: &Reentrant,
    ) -> bool {
        let axes = ACROSS[across.axis];
        let inside = (axes.iter().zip(edge.at)).all(|(&t, x)| {
            let end = self.domain.cells[t] as f64;
            self.domain.boundary[t] != Boundary::Symmetry || PROBE < x && x < end - PROBE
        });
        let point = |quadrant: [bool; 2]| {
            let mut probe = [across.along; 3];
            for (n, &t) in axes.iter().enumerate() {
                probe[t] = edge.at[n] + if quadrant[n] { PROBE } else { -PROBE };
            }
            probe
        };
        let quadrants = [[false, false], [false, true], [true, false], [true, true]];
        let open = || (quadrants.into_iter()).filter(|&quadrant| quadrant != edge.above);
        let [low, high] = [point([false; 2]), point([true; 2])];
        for_each!(block in &self.periods, &self.blocks, low, high => {
            let reaches = (axes.iter().zip(edge.at)).all(|(&t, x)| block.reaches(t, [x; 2], PROBE));
            if reaches && !block.is(own) && open().any(|q| block.contains(point(q))) {
                return false;
            }
        });
        inside
    }
}

/// The directions across an axis.
const ACROSS: [[usize; 2]; 3] = [[1, 2], [0, 2], [0, 1]];

impl Across {
    /// Low and high corner.
    fn corners(&self) -> [[f64; 3]; 2] {
        [self.low, self.high].map(|corner| {
            let mut place = [self.along; 3];
            for (n, &t) in ACROSS[self.axis].iter().enumerate() {
                place[t] = corner[n];
            }
            place
        })
    }
}

impl<R: Deref<Target = Rows>> Placed<R> {
    /// Whether the block reaches an interval along `axis`, give or take `more`.
    fn reaches(&self, axis: usize, [low, high]: [f64; 2], more: f64) -> bool {
        let end = self.origin[axis] + self.rows.block.dims()[axis] as f64 * self.edge[axis];
        self.origin[axis] - more <= high && low <= end + more
    }

    fn reentrant(&self, across: &Across, mut found: impl FnMut(Reentrant, [Run; 2])) {
        let axis = across.axis;
        let [s, t] = ACROSS[axis];
        if self.edge[s].min(self.edge[t]) < FINEST
            || !self.reaches(s, [across.low[0], across.high[0]], 0.0)
            || !self.reaches(t, [across.low[1], across.high[1]], 0.0)
        {
            return;
        }
        let Some(along) = self.index(axis, across.along) else {
            return;
        };
        // Corners of voxels in reach, counted by the voxel above them.
        let corners = |n: usize, a: usize| {
            let corner = |x: f64| (x - self.origin[a]) / self.edge[a];
            let low = corner(across.low[n]).ceil().max(0.0);
            let high = corner(across.high[n]).floor();
            (
                low as i64,
                high.min(self.rows.block.dims()[a] as f64) as i64,
            )
        };
        let ((low, high), (first, last)) = (corners(0, s), corners(1, t));
        if low > high || first > last {
            return;
        }
        // Bit b of a row is the voxel below corner low + b.
        let row = |k: i64| match usize::try_from(k) {
            Ok(k) if k < self.rows.block.dims()[t] => {
                let mut voxel = [0; 3];
                (voxel[axis], voxel[t]) = (along, k);
                word(self.rows.along(s, voxel), low - 1)
            }
            _ => 0,
        };
        let count = (high - low + 1).min(63);
        let mut below = row(first - 1);
        for k in first..=last {
            let above = row(k);
            let (a, b, c, d) = (below, below >> 1, above, above >> 1);
            let pairs = a & b | c & d | (a | b) & (c | d);
            let mut single = (a ^ b ^ c ^ d) & !pairs & ((1 << count) - 1);
            while single != 0 {
                let bit = single.trailing_zeros();
                single &= single - 1;
                let solid = [(b | d) >> bit & 1 == 1, (c | d) >> bit & 1 == 1];
                let corner = [low + i64::from(bit), k];
                let place = |n: usize, a: usize| self.origin[a] + corner[n] as f64 * self.edge[a];
                let edge = Reentrant {
                    at: [place(0, s), place(1, t)],
                    above: solid,
                    straight: 0.0,
                };
                let turned = ([corner[1], corner[0]], [solid[1], solid[0]]);
                let runs = [
                    self.straight([axis, s, t], along, corner, solid),
                    self.straight([axis, t, s], along, turned.0, turned.1),
                ];
                found(edge, runs);
            }
            below = above;
        }
    }

    /// How far a wall runs along `s` from a corner without a step.
    fn straight(
        &self,
        [axis, s, t]: [usize; 3],
        along: usize,
        corner: [i64; 2],
        above: [bool; 2],
    ) -> Run {
        let dims = self.rows.block.dims();
        let solid = |at_s: i64, at_t: i64| {
            let mut voxel = [along; 3];
            for (a, at) in [(s, at_s), (t, at_t)] {
                match usize::try_from(at) {
                    Ok(at) if at < dims[a] => voxel[a] = at,
                    _ => return false,
                }
            }
            voxel[axis] = along;
            self.rows.block.solid(voxel[0], voxel[1], voxel[2])
        };
        let [inside, outside] = match above[1] {
            true => [corner[1], corner[1] - 1],
            false => [corner[1] - 1, corner[1]],
        };
        let mut length = 0.0;
        let mut at = if above[0] { corner[0] } else { corner[0] - 1 };
        while length < LONG && solid(at, inside) && !solid(at, outside) {
            length += self.edge[s];
            at += if above[0] { 1 } else { -1 };
        }
        Run {
            length,
            to_end: length < LONG && !(0..dims[s] as i64).contains(&at),
        }
    }
}

/// 64 bits of a row from bit `from` on; beyond its ends there are none.
fn word(row: &[u64], from: i64) -> u64 {
    let at = |word: i64| {
        let word = usize::try_from(word).ok().and_then(|word| row.get(word));
        word.copied().unwrap_or(0)
    };
    let (first, shift) = (from.div_euclid(64), from.rem_euclid(64));
    match shift {
        0 => at(first),
        _ => at(first) >> shift | at(first + 1) << (64 - shift),
    }
}

#[cfg(test)]
mod tests;

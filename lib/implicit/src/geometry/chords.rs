//! Chord lengths: the run of open voxels along x, y or z through a voxel, which is the channel width H of docs/methods.md
//! section 3.5.

use physics::Boundary;

use super::lattice::{Lattice, OPEN};
use super::rows::RowKind;

/// Cap on chord lengths, voxels, which also stands for infinity: walls farther apart do not affect each other's friction.
pub(super) const LONGEST_CHORD: f64 = 1000.0;

/// The open voxels of lines of `n` voxels, a bit each.
struct Lines {
    n: usize,
    /// Words of a line.
    words: usize,
    bits: Vec<u64>,
}

impl Lines {
    fn new(lines: usize, n: usize, open: impl Fn(usize, usize) -> bool) -> Self {
        let words = n.div_ceil(64);
        let mut bits = vec![0; lines * words];
        for line in 0..lines {
            for i in (0..n).filter(|&i| open(line, i)) {
                bits[line * words + i / 64] |= 1 << (i % 64);
            }
        }
        Self { n, words, bits }
    }

    /// Closed voxels of a word of a line; those beyond its end count as closed.
    fn closed(&self, line: usize, word: usize) -> u64 {
        !self.bits[line * self.words + word]
    }

    /// Start of the open run that ends before voxel `end`.
    fn start(&self, line: usize, end: usize) -> usize {
        let wall = (0..end.div_ceil(64)).rev().find_map(|word| {
            let ahead = (64 * (word + 1)).saturating_sub(end);
            let closed = self.closed(line, word) & (u64::MAX >> ahead);
            (closed != 0).then(|| 64 * (word + 1) - closed.leading_zeros() as usize)
        });
        wall.unwrap_or(0)
    }

    /// End of the open run that starts at voxel `start`.
    fn end(&self, line: usize, start: usize) -> usize {
        let wall = (start / 64..self.words).find_map(|word| {
            let behind = start.saturating_sub(64 * word);
            let closed = self.closed(line, word) & (u64::MAX << behind);
            (closed != 0).then(|| 64 * word + closed.trailing_zeros() as usize)
        });
        wall.map_or(self.n, |wall| wall.min(self.n))
    }

    /// Chord length through voxel `i` of a line: doubled at a mirror, joined across periodic sides.
    fn chord_length(&self, line: usize, boundary: Boundary, i: usize) -> f64 {
        let (from, to) = (self.start(line, i), self.end(line, i));
        let (first, last, length) = (from == 0, to == self.n, to - from);
        let length = match boundary {
            _ if !first && !last => length,
            Boundary::Symmetry if first != last => 2 * length,
            Boundary::Periodic if first && !last => length + (self.n - self.start(line, self.n)),
            Boundary::Periodic if last && !first => length + self.end(line, 0),
            _ => return LONGEST_CHORD,
        };
        (length as f64).min(LONGEST_CHORD)
    }
}

/// A part of the lattice as lines along x (layer by layer), y and z.
struct Part([Lines; 3]);

impl Part {
    fn new(layers: &[Vec<u8>], [nx, nz]: [usize; 2]) -> Self {
        let n = layers.len();
        Self([
            Lines::new(n * nz, nx, |line, x| {
                layers[line / nz][line % nz * nx + x] == OPEN
            }),
            Lines::new(nx * nz, n, |at, layer| layers[layer][at] == OPEN),
            Lines::new(n * nx, nz, |line, z| {
                layers[line / nx][z * nx + line % nx] == OPEN
            }),
        ])
    }

    /// Voxels of the open run along y that continues the gap at index `at` of the layers.
    fn column(&self, at: usize) -> usize {
        self.0[1].end(at, 0)
    }
}

/// Chord lengths of all voxels, found in lines of bits, for the three parts of the lattice.
pub(crate) struct Chords([Part; 3]);

/// Address of a voxel: part of the lattice, layer counted from the gap, index in the layer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct VoxelAddress {
    pub(super) part: RowKind,
    pub(super) layer: usize,
    pub(super) at: usize,
}

impl Chords {
    pub(crate) fn new(lattice: &Lattice) -> Self {
        let size = lattice.layer_size();
        Self((lattice.layers.each_ref()).map(|layers| Part::new(layers, size)))
    }

    /// Chord length along an axis through an open voxel, voxels; the gap is `gap` voxels high.
    pub(crate) fn length(
        &self,
        lattice: &Lattice,
        VoxelAddress { part, layer, at }: VoxelAddress,
        axis: usize,
        gap: f64,
    ) -> f64 {
        let [nx, nz] = lattice.layer_size();
        let (line, i) = match axis {
            0 => (layer * nz + at / nx, at % nx),
            1 => (at, layer),
            _ => (layer * nx + at % nx, at / nx),
        };
        let lines = &self.0[part as usize].0[axis];
        if axis == 1 && lattice.moving.is_some() && lines.start(line, i) == 0 {
            return self.length_through_gap(lattice, at, gap);
        }
        lines.chord_length(line, lattice.boundary[axis], i)
    }

    /// Whether the chord along y through a voxel goes through the gap.
    pub(crate) fn through_gap(&self, lattice: &Lattice, address: VoxelAddress) -> bool {
        let part = &self.0[address.part as usize];
        lattice.moving.is_some() && address.layer < part.column(address.at)
    }

    /// Chord length along y through the gap at index `at` of the layers: doubled by a mirror at one end, else unbounded.
    fn length_through_gap(&self, lattice: &Lattice, at: usize, gap: f64) -> f64 {
        let [below, _, above] = &self.0;
        let [low, high] = [below, above].map(|part| {
            let voxels = part.column(at);
            (voxels, usize::from(voxels == part.0[1].n))
        });
        let voxels = low.0 as f64 + gap + high.0 as f64;
        let length = match (low.1 + high.1, lattice.boundary[1]) {
            (0, _) => voxels,
            (1, Boundary::Symmetry) => 2.0 * voxels,
            _ => LONGEST_CHORD,
        };
        length.min(LONGEST_CHORD)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against walls counted voxel by voxel, in lines of one to several words.
    #[test]
    fn runs_end_at_the_nearest_walls() {
        for n in [1, 63, 64, 65, 128, 200] {
            for wall in [2, 7, 61, 64, 127, 1000] {
                let open = |_, i: usize| i % wall != wall - 1;
                let lines = Lines::new(2, n, open);
                for i in (0..n).filter(|&i| open(1, i)) {
                    let from = (0..i).rev().find(|&i| !open(1, i)).map_or(0, |at| at + 1);
                    let to = (i..n).find(|&i| !open(1, i)).unwrap_or(n);
                    assert_eq!((lines.start(1, i), lines.end(1, i)), (from, to));
                    assert!(to < n || lines.start(1, n) == from);
                }
            }
        }
    }
}

//! Nodes of the background grid and what the sides of the domain do to them.

use physics::{Boundary, Scene};

use crate::lanes::Lanes4;
use crate::real::Real;
use crate::stages::Present;

/// Nodes along the edge of a tile or block.
pub(crate) const EDGE: usize = 4;
/// Nodes along the edge of a tile with the one around it that its points reach.
pub(crate) const HALO: usize = EDGE + 2;
/// Tile coordinate of the tile that holds node 0; node -1 needs one more below.
const FIRST: i32 = 1;

/// The lattice of nodes -1 ..= cells + 1 along each axis.
#[derive(Clone, Debug)]
pub(crate) struct Lattice {
    pub(crate) cells: [i32; 3],
    pub(crate) boundary: [Boundary; 3],
    pub(crate) three: bool,
}

/// A node after the sides have been applied.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Folded {
    pub(crate) node: [i32; 3],
    /// Bit a set: mirrored along axis a, so that component a changes sign.
    pub(crate) flip: u8,
}

impl Lattice {
    pub(crate) fn new(scene: &Scene, present: Present) -> Self {
        Self {
            cells: scene.grid.cells.map(|n| n as i32),
            boundary: scene.boundary,
            three: present.three,
        }
    }

    /// A cube of `n` cells an edge, all sides alike.
    #[cfg(test)]
    pub(crate) fn cube(n: i32, side: Boundary) -> Self {
        Self {
            cells: [n; 3],
            boundary: [side; 3],
            three: true,
        }
    }

    /// Axes that are computed.
    pub(crate) fn axes(&self) -> usize {
        if self.three { 3 } else { 2 }
    }

    /// Nodes of a block.
    pub(crate) fn block_len(&self) -> usize {
        EDGE * EDGE * if self.three { EDGE } else { 1 }
    }

    /// Nodes that the points of a tile reach.
    pub(crate) fn halo_len(&self) -> usize {
        HALO * HALO * if self.three { HALO } else { 1 }
    }

    /// Where the values of `node` live: itself, its mirror image or its periodic image;
    /// `None` where no point's weight can be.
    pub(crate) fn fold(&self, node: [i32; 3]) -> Option<Folded> {
        let mut folded = Folded { node, flip: 0 };
        for a in 0..self.axes() {
            let (n, g) = (self.cells[a], node[a]);
            if g < -1 || g > n + 1 {
                return None;
            }
            match self.boundary[a] {
                Boundary::Periodic => folded.node[a] = g.rem_euclid(n),
                Boundary::Symmetry if g < 0 => {
                    folded.node[a] = -g;
                    folded.flip |= 1 << a;
                }
                Boundary::Symmetry if g > n => {
                    folded.node[a] = 2 * n - g;
                    folded.flip |= 1 << a;
                }
                Boundary::Symmetry | Boundary::Open => {}
            }
        }
        Some(folded)
    }

    /// Bit a set: `node` lies on a mirror plane normal to axis a.
    pub(crate) fn planes(&self, node: [i32; 3]) -> u8 {
        let mut mask = 0;
        for a in 0..self.axes() {
            if self.boundary[a] == Boundary::Symmetry && (node[a] == 0 || node[a] == self.cells[a])
            {
                mask |= 1 << a;
            }
        }
        mask
    }

    /// Key of the tile or block that holds `node`; ordered by z, then y, then x.
    pub(crate) fn tile_key(&self, node: [i32; 3]) -> u64 {
        let t = |a: usize| ((node[a] + FIRST * EDGE as i32) as u64) / EDGE as u64;
        let z = if self.three { t(2) } else { 0 };
        z << 42 | t(1) << 21 | t(0)
    }

    /// The lowest node of the tile with this key.
    pub(crate) fn tile_origin(&self, key: u64) -> [i32; 3] {
        let g = |t: u64| (t as i32 - FIRST) * EDGE as i32;
        let mask = (1 << 21) - 1;
        let z = if self.three { g(key >> 42) } else { 0 };
        [g(key & mask), g(key >> 21 & mask), z]
    }
}

/// Halo entries from the first to the last node of a window.
pub(crate) const fn window(dimensions: usize) -> usize {
    let plane = 2 * HALO + 3;
    if dimensions == 3 {
        2 * HALO * HALO + plane
    } else {
        plane
    }
}

/// Within what the place of a point stays with its node; volume, and an axis that is not computed, may be
/// anything. Not infinite: the compiler would drop that comparison and take the vector apart for the others.
pub(crate) const fn nearest(dimensions: usize) -> Lanes4 {
    let z = if dimensions == 3 { 0.5 } else { Real::MAX };
    Lanes4([0.5, 0.5, z, Real::MAX])
}

/// Window layers along z.
pub(crate) const fn layers(dimensions: usize) -> usize {
    if dimensions == 3 { 3 } else { 1 }
}

/// Index within a block of node (x, y, z) counted from the block's lowest.
#[inline]
pub(crate) fn block_index(local: [i32; 3]) -> usize {
    ((local[2] * EDGE as i32 + local[1]) * EDGE as i32 + local[0]) as usize
}

/// Node offset (x, y, z) from the block's lowest of index `i`.
#[inline]
pub(crate) fn block_node(i: usize) -> [i32; 3] {
    [
        (i % EDGE) as i32,
        (i / EDGE % EDGE) as i32,
        (i / (EDGE * EDGE)) as i32,
    ]
}

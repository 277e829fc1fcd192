//! Voids of a body that no liquid can reach.

use physics::{Boundary, VoxelBlock};

use crate::geometry::Domain;

/// `block` with the voids filled in that open voxels do not connect with any side of the
/// block through which liquid could come; and how many voxels these are.
///
/// Voxels are connected through their faces, so a wall of one voxel closes. Liquid comes
/// through the sides of the block that lie inside the domain or on a periodic or open side of
/// it, but not through those on symmetry planes. `low` is the block's low corner and `edge`
/// its voxel, both in cells of the domain. Filled in before a run, such voids can hold no
/// liquid at any time, whatever the offset of the body on the lattice.
pub(crate) fn fill_sealed(
    block: &VoxelBlock,
    domain: &Domain,
    low: [f64; 3],
    edge: [f64; 3],
) -> (VoxelBlock, u64) {
    let dims = block.dims();
    let closed: [[bool; 2]; 3] = std::array::from_fn(|a| {
        let high = low[a] + dims[a] as f64 * edge[a];
        let symmetric = a >= domain.axes || domain.boundary[a] == Boundary::Symmetry;
        let n = domain.cells[a] as f64;
        [symmetric && low[a] < 1e-6, symmetric && high > n - 1e-6]
    });
    let mut reached = Reached::new(dims);
    for k in 0..dims[2] {
        for j in 0..dims[1] {
            let side_row = entrance(&closed[1], j, dims[1]) || entrance(&closed[2], k, dims[2]);
            for i in 0..dims[0] {
                if side_row || entrance(&closed[0], i, dims[0]) {
                    reached.visit(block, [i, j, k]);
                }
            }
        }
    }
    reached.spread(block);
    let mut sealed = 0;
    let filled = VoxelBlock::from_fn(block.origin(), block.voxel(), dims, |i, j, k| {
        let void = !block.solid(i, j, k) && !reached.holds([i, j, k]);
        sealed += u64::from(void);
        void || block.solid(i, j, k)
    });
    (filled, sealed)
}

fn entrance(closed: &[bool; 2], i: usize, n: usize) -> bool {
    i == 0 && !closed[0] || i + 1 == n && !closed[1]
}

/// Open voxels reached so far, one bit each, and those whose neighbours are still to be seen.
struct Reached {
    dims: [usize; 3],
    bits: Vec<u64>,
    front: Vec<[u32; 3]>,
}

impl Reached {
    fn new(dims: [usize; 3]) -> Self {
        let n = dims[0] * dims[1] * dims[2];
        Self {
            dims,
            bits: vec![0; n.div_ceil(64)],
            front: Vec::new(),
        }
    }

    fn index(&self, [i, j, k]: [usize; 3]) -> usize {
        (k * self.dims[1] + j) * self.dims[0] + i
    }

    fn holds(&self, at: [usize; 3]) -> bool {
        let n = self.index(at);
        self.bits[n / 64] >> (n % 64) & 1 == 1
    }

    fn visit(&mut self, block: &VoxelBlock, at: [usize; 3]) {
        if !block.solid(at[0], at[1], at[2]) && !self.holds(at) {
            let n = self.index(at);
            self.bits[n / 64] |= 1 << (n % 64);
            self.front.push(at.map(|x| x as u32));
        }
    }

    fn spread(&mut self, block: &VoxelBlock) {
        while let Some(at) = self.front.pop() {
            let at = at.map(|x| x as usize);
            for axis in 0..3 {
                let mut next = at;
                if at[axis] > 0 {
                    next[axis] = at[axis] - 1;
                    self.visit(block, next);
                }
                if at[axis] + 1 < self.dims[axis] {
                    next[axis] = at[axis] + 1;
                    self.visit(block, next);
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cup open to the top, with a lumen in its wall that opens only to the symmetry plane
    /// at its low x side, and a bubble inside its floor.
    #[test]
    fn only_what_opens_to_the_domain_is_reached() {
        let solid = |i: usize, j: usize, k: usize| {
            let cup = j >= 4 && (3..9).contains(&i) && (2..6).contains(&k);
            let lumen = j == 6 && i < 2 && k == 4;
            let bubble = j == 2 && (4..6).contains(&i) && k == 4;
            !(cup || lumen || bubble)
        };
        let block = VoxelBlock::from_fn([0.0; 3], [0.5; 3], [12, 10, 8], solid);
        let domain = Domain {
            cells: [6, 20, 4],
            boundary: [Boundary::Symmetry; 3],
            axes: 3,
        };
        let (filled, sealed) = fill_sealed(&block, &domain, [0.0; 3], [0.5; 3]);
        assert_eq!(sealed, 2 + 2);
        assert_eq!(filled.count(), block.count() + 4);
        assert!(filled.solid(0, 6, 4) && filled.solid(4, 2, 4) && !filled.solid(3, 4, 2));
        // Away from the symmetry plane the lumen is open.
        let (_, sealed) = fill_sealed(&block, &domain, [1.0, 0.0, 0.0], [0.5; 3]);
        assert_eq!(sealed, 2);
    }

    /// A slot along x through a block of 12 x 3 voxels of half a cell, open to both of its ends.
    #[test]
    fn a_slot_is_sealed_where_symmetry_planes_close_both_ends() {
        let block = VoxelBlock::from_fn([0.0; 3], [0.5, 0.5, 1.0], [12, 3, 1], |_, j, _| j != 1);
        let sealed = |cells: usize, low: f64, boundary: Boundary| {
            let domain = Domain {
                cells: [cells, 4, 1],
                boundary: [boundary, Boundary::Symmetry, Boundary::Symmetry],
                axes: 2,
            };
            fill_sealed(&block, &domain, [low, 1.0, 0.0], [0.5, 0.5, 1.0]).1
        };
        assert_eq!(sealed(6, 0.0, Boundary::Symmetry), 12);
        assert_eq!(sealed(8, 0.0, Boundary::Symmetry), 0, "open at x = 6 of 8");
        assert_eq!(sealed(8, 2.0, Boundary::Symmetry), 0, "open at x = 2 of 8");
        assert_eq!(sealed(6, 0.0, Boundary::Open), 0);
        assert_eq!(sealed(6, 0.0, Boundary::Periodic), 0);
    }
}

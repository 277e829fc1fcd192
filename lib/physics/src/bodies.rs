//! Rigid bodies of voxels and how they move.

use std::sync::Arc;

/// How a rigid body moves. Bodies only translate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Motion {
    /// At rest.
    Fixed,
    /// Constant velocity, m/s.
    Constant([f64; 3]),
    /// Driven by the clamp: moves along -y at the clamp's closing speed.
    Clamped,
}

/// A rigid body: voxel blocks that share one motion. Blocks of a body do not overlap.
#[derive(Clone, Debug)]
pub struct RigidBody {
    /// Name for messages and outputs, e.g. "wood-bottom".
    pub name: String,
    /// Blocks of the body; a box is a block of one voxel.
    pub blocks: Vec<VoxelBlock>,
    /// Motion of the body.
    pub motion: Motion,
}

impl RigidBody {
    /// Whether `point` (m), in the body's own frame (displacement subtracted), lies in the body. Lower faces belong to it,
    /// upper faces do not.
    pub fn contains(&self, point: [f64; 3]) -> bool {
        self.blocks.iter().any(|block| block.contains(point))
    }
}

/// A block of equal voxels, some of them solid, at its place before any displacement.
///
/// Voxel (i, j, k) fills `origin + [i, j, k] * voxel` to `origin + [i+1, j+1, k+1] * voxel`.
/// One bit per voxel, x fastest; each row (fixed y and z) starts at a word boundary.
#[derive(Clone, Debug)]
pub struct VoxelBlock {
    origin: [f64; 3],
    voxel: [f64; 3],
    dims: [usize; 3],
    words_per_row: usize,
    /// Shared by the several clones of a block in a run.
    bits: Arc<[u64]>,
}

impl VoxelBlock {
    /// A block from its bits: `dims[1] * dims[2]` rows of `ceil(dims[0] / 64)` words.
    ///
    /// # Panics
    /// If `bits` has another length; readers of files check it before.
    pub fn new(origin: [f64; 3], voxel: [f64; 3], dims: [usize; 3], bits: Vec<u64>) -> Self {
        let words_per_row = dims[0].div_ceil(64);
        assert_eq!(
            bits.len(),
            words_per_row * dims[1] * dims[2],
            "bits do not fit the block"
        );
        Self {
            origin,
            voxel,
            dims,
            words_per_row,
            bits: bits.into(),
        }
    }

    /// A solid box, which is a block of one voxel.
    pub fn solid_box(min: [f64; 3], max: [f64; 3]) -> Self {
        let edges = [max[0] - min[0], max[1] - min[1], max[2] - min[2]];
        Self::new(min, edges, [1, 1, 1], vec![1])
    }

    /// A block from a predicate on voxel indices.
    pub fn from_fn(
        origin: [f64; 3],
        voxel: [f64; 3],
        dims: [usize; 3],
        mut solid: impl FnMut(usize, usize, usize) -> bool,
    ) -> Self {
        let words_per_row = dims[0].div_ceil(64);
        let mut bits = vec![0_u64; words_per_row * dims[1] * dims[2]];
        for k in 0..dims[2] {
            for j in 0..dims[1] {
                for i in (0..dims[0]).filter(|&i| solid(i, j, k)) {
                    bits[(k * dims[1] + j) * words_per_row + i / 64] |= 1 << (i % 64);
                }
            }
        }
        Self::new(origin, voxel, dims, bits)
    }

    /// Low corner, m.
    pub fn origin(&self) -> [f64; 3] {
        self.origin
    }

    /// Edges of a voxel along x, y, z, m.
    pub fn voxel(&self) -> [f64; 3] {
        self.voxel
    }

    /// Number of voxels along x, y, z.
    #[inline]
    pub fn dims(&self) -> [usize; 3] {
        self.dims
    }

    /// High corner, m.
    pub fn max(&self) -> [f64; 3] {
        std::array::from_fn(|a| self.origin[a] + self.dims[a] as f64 * self.voxel[a])
    }

    /// Whether voxel (i, j, k) is solid; false outside the block.
    #[inline]
    pub fn solid(&self, i: usize, j: usize, k: usize) -> bool {
        i < self.dims[0]
            && j < self.dims[1]
            && k < self.dims[2]
            && self.bits[(k * self.dims[1] + j) * self.words_per_row + i / 64] >> (i % 64) & 1 == 1
    }

    /// The bits of row (j, k), x fastest.
    #[inline]
    pub fn row(&self, j: usize, k: usize) -> &[u64] {
        let start = (k * self.dims[1] + j) * self.words_per_row;
        &self.bits[start..start + self.words_per_row]
    }

    /// All bits, rows (j, k) with j fastest.
    pub fn bits(&self) -> &[u64] {
        &self.bits
    }

    /// Number of solid voxels.
    pub fn count(&self) -> u64 {
        self.bits.iter().map(|w| u64::from(w.count_ones())).sum()
    }

    /// The voxel that contains `point` (m, in the block's frame).
    pub fn voxel_at(&self, point: [f64; 3]) -> Option<[usize; 3]> {
        let place = |a: usize| (point[a] - self.origin[a]) / self.voxel[a];
        let inside = |a: usize| place(a) >= 0.0 && place(a) < self.dims[a] as f64;
        (0..3)
            .all(inside)
            .then(|| [0, 1, 2].map(|a| place(a) as usize))
    }

    /// Whether `point` (m, in the block's frame) is in a solid voxel.
    pub fn contains(&self, point: [f64; 3]) -> bool {
        (self.voxel_at(point)).is_some_and(|[i, j, k]| self.solid(i, j, k))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bits_and_points_agree() {
        let block = VoxelBlock::from_fn([1.0, 0.0, 0.0], [0.5, 1.0, 2.0], [70, 3, 2], |i, j, k| {
            (i * 7 + j * 3 + k).is_multiple_of(5)
        });
        let mut count = 0;
        for n in 0..420 {
            let [i, j, k] = [n % 70, n / 70 % 3, n / 210];
            let solid = (i * 7 + j * 3 + k) % 5 == 0;
            count += u64::from(solid);
            let [x, y, z] = [i, j, k].map(|index| index as f64 + 0.5);
            assert_eq!(block.contains([1.0 + 0.5 * x, y, 2.0 * z]), solid);
            assert_eq!(block.row(j, k)[i / 64] >> (i % 64) & 1 == 1, solid);
        }
        assert_eq!(block.count(), count);
        assert!(!block.contains([0.99, 0.5, 0.5]) && !block.contains([f64::NAN, 0.5, 0.5]));
    }

    #[test]
    fn a_box_is_one_voxel() {
        let b = VoxelBlock::solid_box([0.0; 3], [1.0, 2.0, 3.0]);
        assert!(b.contains([0.5, 1.9, 2.9]) && !b.contains([0.5, 2.0, 2.9]));
        assert_eq!(b.max(), [1.0, 2.0, 3.0]);
    }
}

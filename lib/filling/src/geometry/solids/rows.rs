//! The bits of a block of voxels in rows along each axis, so that a ray is a scan of words.

use physics::VoxelBlock;

/// A block, and its bits turned so that rows run along y and along z.
#[derive(Debug)]
pub(super) struct Rows {
    pub(super) block: VoxelBlock,
    /// Rows along y, then along z; empty where no ray runs along the axis.
    turned: [Vec<u64>; 2],
}

impl Rows {
    /// The rows of `block` along the first `axes` axes.
    pub(super) fn new(block: VoxelBlock, axes: usize) -> Self {
        let turned = [1, 2].map(|axis| {
            if axis < axes {
                turn(&block, axis)
            } else {
                Vec::new()
            }
        });
        Self { block, turned }
    }

    /// The bits along `axis` of the row that holds `voxel`.
    #[inline]
    pub(super) fn along(&self, axis: usize, voxel: [usize; 3]) -> &[u64] {
        if axis == 0 {
            return self.block.row(voxel[1], voxel[2]);
        }
        let dims = self.block.dims();
        let words = dims[axis].div_ceil(64);
        let start = (voxel[3 - axis] * dims[0] + voxel[0]) * words;
        &self.turned[axis - 1][start..start + words]
    }
}

/// The bits of `block` in rows along y or z: one row per place along x, these one after the other
/// along the third axis; each row starts at a word boundary.
fn turn(block: &VoxelBlock, axis: usize) -> Vec<u64> {
    let dims = block.dims();
    let (across, words) = (dims[3 - axis], dims[axis].div_ceil(64));
    let mut turned = vec![0; words * dims[0] * across];
    let mut square = [0; 64];
    for other in 0..across {
        for word in 0..words {
            for x in 0..dims[0].div_ceil(64) {
                for (n, bits) in square.iter_mut().enumerate() {
                    let at = word * 64 + n;
                    let (j, k) = if axis == 1 { (at, other) } else { (other, at) };
                    *bits = if at < dims[axis] {
                        block.row(j, k)[x]
                    } else {
                        0
                    };
                }
                transpose(&mut square);
                let first = other * dims[0] + 64 * x;
                for (n, &bits) in square.iter().take(dims[0] - 64 * x).enumerate() {
                    turned[(first + n) * words + word] = bits;
                }
            }
        }
    }
    turned
}

/// Transposes 64 x 64 bits in place, by exchanging ever smaller quarters (Warren, Hacker's
/// Delight, section 7-3).
fn transpose(square: &mut [u64; 64]) {
    let mut half = 32;
    let mut low = u64::MAX >> 32;
    while half != 0 {
        for row in (0..64).filter(|row| row & half == 0) {
            let swapped = (square[row] >> half ^ square[row + half]) & low;
            square[row] ^= swapped << half;
            square[row + half] ^= swapped;
        }
        half >>= 1;
        low ^= low << half;
    }
}

/// The first bit of `row` from `from` on, before `end`, that is `solid`; `end` where none is.
#[inline]
pub(super) fn next(row: &[u64], from: usize, end: usize, solid: bool) -> usize {
    let flip = if solid { 0 } else { u64::MAX };
    let mut at = from;
    while at < end {
        let bits = (row[at / 64] ^ flip) >> (at % 64);
        if bits != 0 {
            return end.min(at + bits.trailing_zeros() as usize);
        }
        at = (at / 64 + 1) * 64;
    }
    end
}

/// One more than the last bit of `row` before `from`, not before `end`, that is `solid`; `end` where
/// none is.
#[inline]
pub(super) fn previous(row: &[u64], from: usize, end: usize, solid: bool) -> usize {
    let flip = if solid { 0 } else { u64::MAX };
    let mut at = from;
    while at > end {
        let last = at - 1;
        let bits = (row[last / 64] ^ flip) << (63 - last % 64);
        if bits != 0 {
            return end.max(at - bits.leading_zeros() as usize);
        }
        at = last / 64 * 64;
    }
    end
}

#[cfg(test)]
mod tests {
    use super::*;

    fn block() -> VoxelBlock {
        let solid = |i, j, k| (i * i + 3 * j * k + j + 5 * k) % 7 < 3;
        VoxelBlock::from_fn([0.0; 3], [1.0; 3], [70, 131, 65], solid)
    }

    #[test]
    fn rows_along_every_axis_hold_the_same_bits() {
        let rows = Rows::new(block(), 3);
        let [nx, ny, nz] = rows.block.dims();
        for k in 0..nz {
            for j in 0..ny {
                for i in 0..nx {
                    let at = [i, j, k];
                    for (axis, &n) in at.iter().enumerate() {
                        let bit = rows.along(axis, at)[n / 64] >> (n % 64) & 1 == 1;
                        assert_eq!(bit, rows.block.solid(i, j, k), "{at:?} {axis}");
                    }
                }
            }
        }
    }

    #[test]
    fn scans_find_the_nearest_bit_within_their_ends() {
        let rows = Rows::new(block(), 3);
        for voxel in [[0, 0, 0], [3, 0, 7], [69, 0, 64]] {
            let row = rows.along(1, voxel);
            let is = |at: usize, solid| (row[at / 64] >> (at % 64) & 1 == 1) == solid;
            for (low, high) in (0..=131).flat_map(|low| (low..=131).map(move |high| (low, high))) {
                for solid in [true, false] {
                    let up = (low..high).find(|&at| is(at, solid));
                    assert_eq!(next(row, low, high, solid), up.unwrap_or(high));
                    let down = (low..high).rfind(|&at| is(at, solid));
                    assert_eq!(
                        previous(row, high, low, solid),
                        down.map_or(low, |at| at + 1)
                    );
                }
            }
        }
    }
}

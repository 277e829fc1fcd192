//! Voxels of a material at their place, and specimens made of two materials.

use std::ops::Range;

use particle_file::{BitGrid, BitsRef, Block};

use crate::Error;

/// Voxels of one material at their place: voxel (i, j, k) fills `origin + [i, j, k] * voxel` to
/// `origin + [i+1, j+1, k+1] * voxel`.
#[derive(Clone, Copy, Debug)]
pub struct PlacedVoxels<'a> {
    /// Low corner, m.
    pub origin_m: [f64; 3],
    /// Edge of a voxel, m.
    pub voxel_m: f64,
    /// Which voxels.
    pub bits: BitsRef<'a>,
}

impl<'a> PlacedVoxels<'a> {
    /// The voxels of a block of a particle file.
    pub fn of_block((block, bits): (&Block, BitsRef<'a>)) -> Self {
        Self {
            origin_m: block.origin_m,
            voxel_m: block.voxel_m,
            bits,
        }
    }

    /// Voxels of this edge (m) with their low corner at the origin.
    pub fn at_origin(bits: BitsRef<'a>, voxel_m: f64) -> Self {
        Self {
            origin_m: [0.0; 3],
            voxel_m,
            bits,
        }
    }

    /// High corner, m.
    pub fn max_m(&self) -> [f64; 3] {
        let dims = self.bits.dims();
        std::array::from_fn(|a| self.origin_m[a] + dims[a] as f64 * self.voxel_m)
    }

    /// Centre of a voxel, m.
    pub fn centre_m(&self, index: [usize; 3]) -> [f64; 3] {
        std::array::from_fn(|a| self.origin_m[a] + (index[a] as f64 + 0.5) * self.voxel_m)
    }
}

/// A bonded specimen: wood and adhesive of one stack.
#[derive(Clone, Copy, Debug)]
pub struct Specimen<'a> {
    wood: PlacedVoxels<'a>,
    adhesive: PlacedVoxels<'a>,
}

impl<'a> Specimen<'a> {
    /// A specimen from its two materials.
    pub fn new(wood: PlacedVoxels<'a>, adhesive: PlacedVoxels<'a>) -> Result<Self, Error> {
        let same = wood.bits.dims() == adhesive.bits.dims()
            && wood.origin_m == adhesive.origin_m
            && wood.voxel_m == adhesive.voxel_m;
        same.then_some(Self { wood, adhesive }).ok_or_else(|| {
            Error::unfit(
                "the wood and the adhesive of the specimen are not voxels of the same stack",
            )
        })
    }

    /// The wood.
    pub fn wood(&self) -> PlacedVoxels<'a> {
        self.wood
    }

    /// The adhesive.
    pub fn adhesive(&self) -> PlacedVoxels<'a> {
        self.adhesive
    }
}

pub(crate) fn layers(bits: BitsRef, axis: usize, layers: Range<usize>) -> BitGrid {
    let mut ranges = bits.dims().map(|d| 0..d);
    ranges[axis] = layers;
    crop(bits, &ranges)
}

/// The low corner of `bits` with dimensions `dims`.
pub(crate) fn corner(bits: BitsRef, dims: [usize; 3]) -> BitGrid {
    crop(bits, &dims.map(|d| 0..d))
}

/// The voxels inside `ranges` (along x, y, z, within the grid).
fn crop(bits: BitsRef, ranges: &[Range<usize>; 3]) -> BitGrid {
    let (shift, first) = (ranges[0].start % 64, ranges[0].start / 64);
    let dims = ranges.clone().map(|r| r.len());
    BitGrid::from_rows(dims, |y, z, row| {
        let source = bits.row(ranges[1].start + y, ranges[2].start + z);
        let word = |w: usize| source.get(first + w).copied().unwrap_or(0);
        for (w, out) in row.iter_mut().enumerate() {
            *out = word(w) >> shift;
            if shift > 0 {
                *out |= word(w + 1) << (64 - shift);
            }
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pattern(x: usize, y: usize, z: usize) -> bool {
        (x * 7 + y * 3 + z * 11) % 5 < 2
    }

    #[test]
    fn a_crop_holds_the_same_voxels() {
        let grid = BitGrid::from_fn([200, 6, 5], pattern);
        for x in [0..200, 3..70, 64..128, 65..66, 130..199, 7..7] {
            let part = crop(grid.view(), &[x.clone(), 1..5, 2..4]);
            let expected = BitGrid::from_fn([x.len(), 4, 2], |i, j, k| {
                pattern(i + x.start, j + 1, k + 2)
            });
            assert_eq!(part, expected, "{x:?}");
        }
    }
}

//! A voxel block of a body, and what of it a point can hit.

use physics::{Boundary, RigidBody, VoxelBlock};

use crate::lanes::Lanes4;
use crate::lattice::Lattice;
use crate::real::Real;

/// Distance (cells) from a face at which a stopped point is left: above the resolution of
/// positions, far below anything physical.
const STAND_OFF: f64 = 1e-5;

/// A voxel block in cells, counted from the low corner of the grid.
#[derive(Clone, Debug)]
pub(crate) struct BlockShape {
    pub(crate) origin: [f64; 3],
    pub(crate) voxel: [f64; 3],
    pub(crate) solid: VoxelBlock,
}

impl BlockShape {
    /// The blocks of a body.
    pub(crate) fn of(body: &RigidBody, min_m: [f64; 3], cell_m: f64) -> Vec<Self> {
        body.blocks
            .iter()
            .map(|block| Self {
                origin: std::array::from_fn(|a| (block.origin()[a] - min_m[a]) / cell_m),
                voxel: block.voxel().map(|v| v / cell_m),
                solid: block.clone(),
            })
            .collect()
    }

    /// Position of a point in voxels of this block displaced by `shift`.
    fn voxels(&self, node: [i32; 3], d: &Lanes4, shift: &[f64; 3], lattice: &Lattice) -> [f64; 3] {
        std::array::from_fn(|a| {
            let mut x = f64::from(node[a]) + f64::from(d.0[a]) - shift[a] - self.origin[a];
            if lattice.boundary[a] == Boundary::Periodic && a < lattice.axes() {
                x = x.rem_euclid(f64::from(lattice.cells[a]));
            }
            x / self.voxel[a]
        })
    }

    fn solid_at(&self, x: [f64; 3]) -> bool {
        x.iter().all(|&x| x >= 0.0) && {
            let [i, j, k] = x.map(|x| x as usize);
            self.solid.solid(i, j, k)
        }
    }

    /// Whether a point is in a solid voxel of this block displaced by `shift`.
    pub(crate) fn contains(
        &self,
        node: [i32; 3],
        d: &Lanes4,
        shift: &[f64; 3],
        lattice: &Lattice,
    ) -> bool {
        self.solid_at(self.voxels(node, d, shift, lattice))
    }

    /// Follows a point from `start` to `end` axis by axis and stops it before solid voxels.
    /// Gives the directions (-1, 0, 1) in which it was stopped, `None` if it was not.
    pub(crate) fn sweep(
        &self,
        node: [i32; 3],
        start: &Lanes4,
        end: &mut Lanes4,
        (from, to): (&[f64; 3], &[f64; 3]),
        lattice: &Lattice,
    ) -> Option<[i8; 3]> {
        let mut at = self.voxels(node, start, from, lattice);
        let target = self.voxels(node, end, to, lattice);
        if at.map(f64::floor) == target.map(f64::floor) || self.solid_at(at) {
            return None;
        }
        let mut stops = [0_i8; 3];
        for a in 0..3 {
            let free = at[a];
            at[a] = target[a];
            if !self.solid_at(at) {
                continue;
            }
            let up = target[a] > free;
            stops[a] = if up { 1 } else { -1 };
            let stand_off = STAND_OFF / self.voxel[a];
            let stopped = if up {
                target[a].floor() - stand_off
            } else {
                target[a].floor() + 1.0 + stand_off
            };
            at[a] = stopped;
            end.0[a] += ((stopped - target[a]) * self.voxel[a]) as Real;
        }
        (stops != [0; 3]).then_some(stops)
    }
}

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

#[cfg(test)]
mod tests {
    use super::*;

    /// A floor up to y = 3 and a ceiling from y = 7 on, of voxels of half a cell.
    fn gap() -> BlockShape {
        BlockShape {
            origin: [0.0; 3],
            voxel: [0.5; 3],
            solid: VoxelBlock::from_fn([0.0; 3], [1.0; 3], [20, 20, 20], |_, j, _| {
                !(6..14).contains(&j)
            }),
        }
    }

    /// Where a point that goes from `start` to `end` (x, y) while the body rises by `rise` comes to, and in
    /// which directions it was stopped.
    fn swept(start: [f64; 2], end: [f64; 2], rise: f64) -> ([f64; 2], Option<[i8; 3]>) {
        let lattice = Lattice {
            cells: [10; 3],
            boundary: [Boundary::Open; 3],
            three: true,
        };
        let node = [5; 3];
        let from_node =
            |x: [f64; 2]| Lanes4([(x[0] - 5.0) as Real, (x[1] - 5.0) as Real, 0.0, 0.0]);
        let (start, mut d) = (from_node(start), from_node(end));
        let shifts = (&[0.0; 3], &[0.0, rise, 0.0]);
        let stops = gap().sweep(node, &start, &mut d, shifts, &lattice);
        ([0, 1].map(|a| 5.0 + f64::from(d.0[a])), stops)
    }

    #[test]
    fn a_point_is_stopped_before_the_face_it_comes_to() {
        for (start, end, rise, at, stops) in [
            ([5.2, 4.0], [5.4, 3.2], 0.0, [5.4, 3.2], None),
            ([5.2, 3.6], [5.4, 2.8], 0.0, [5.4, 3.0], Some([0, -1, 0])),
            ([5.2, 6.7], [4.9, 7.3], 0.0, [4.9, 7.0], Some([0, 1, 0])),
            // The floor comes up to a point at rest, and the ceiling up and away.
            ([5.2, 3.2], [5.2, 3.2], 0.5, [5.2, 3.5], Some([0, -1, 0])),
            ([5.2, 6.7], [5.2, 7.3], 0.5, [5.2, 7.3], None),
            // A point in wood is left there.
            ([5.2, 2.8], [5.2, 2.2], 0.0, [5.2, 2.2], None),
        ] {
            let (found, stopped) = swept(start, end, rise);
            assert_eq!(stopped, stops, "{start:?} to {end:?}");
            // Beside the face by 1e-5 cells, above the rounding of f32 and below anything physical.
            let way = f64::from(stops.map_or(0, |[_, way, _]| way));
            let off = [found[0] - at[0], found[1] - at[1] + 1e-5 * way];
            assert!(off.iter().all(|x| x.abs() < 1e-6), "{found:?}, not {at:?}");
        }
    }
}

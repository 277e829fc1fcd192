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
        let shape = |block: &VoxelBlock| Self {
            origin: std::array::from_fn(|a| (block.origin()[a] - min_m[a]) / cell_m),
            voxel: block.voxel().map(|v| v / cell_m),
            solid: block.clone(),
        };
        body.blocks.iter().map(shape).collect()
    }

    /// Position of a point in voxels of this block displaced by `shift`.
    fn voxels(&self, node: [i32; 3], d: &Lanes4, shift: &[f64; 3]) -> [f64; 3] {
        std::array::from_fn(|a| {
            let x = f64::from(node[a]) + f64::from(d.0[a]) - shift[a] - self.origin[a];
            x / self.voxel[a]
        })
    }

    /// The place (voxels) in the block itself of one in its images beyond periodic sides.
    fn folded(&self, x: [f64; 3], lattice: &Lattice) -> [f64; 3] {
        std::array::from_fn(|a| {
            match lattice.boundary[a] == Boundary::Periodic && a < lattice.axes() {
                true => x[a].rem_euclid(f64::from(lattice.cells[a]) / self.voxel[a]),
                false => x[a],
            }
        })
    }

    fn solid_at(&self, folded: [f64; 3]) -> bool {
        folded.iter().all(|&x| x >= 0.0) && {
            let [i, j, k] = folded.map(|x| x as usize);
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
        self.solid_at(self.folded(self.voxels(node, d, shift), lattice))
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
        let mut at = self.voxels(node, start, from);
        let target = self.voxels(node, end, to);
        let [here, there] = [at, target].map(|x| self.folded(x, lattice));
        if here.map(f64::floor) == there.map(f64::floor) || self.solid_at(here) {
            return None;
        }
        let mut stops = [0_i8; 3];
        for a in 0..3 {
            let free = at[a];
            at[a] = target[a];
            let folded = self.folded(at, lattice);
            if !self.solid_at(folded) {
                continue;
            }
            let up = target[a] > free;
            stops[a] = if up { 1 } else { -1 };
            let stand_off = STAND_OFF / self.voxel[a];
            // Faces are whole numbers in the block, but not in its images.
            let face = target[a] - folded[a] + folded[a].floor();
            let stopped = if up {
                face - stand_off
            } else {
                face + 1.0 + stand_off
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
        let lattice = Lattice::cube(10, Boundary::Open);
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

    /// A point that came to the low face of a body was put behind its high face.
    #[test]
    fn a_point_is_stopped_before_the_faces_of_images() {
        let post = BlockShape {
            origin: [3.0, 0.0, 0.0],
            voxel: [4.0, 10.0, 10.0],
            solid: VoxelBlock::solid_box([0.0; 3], [1.0; 3]),
        };
        let lattice = Lattice::cube(10, Boundary::Periodic);
        for (from, by, to) in [(2.8, 0.5, 3.0), (7.2, -0.5, 7.0)] {
            for periods in [-3.0, -1.0, 0.0, 1.0, 2.0, 7.0] {
                let shift = [10.0 * periods + 0.5, 0.0, 0.0];
                let place = |x: f64| Lanes4([(x + 0.5 - 5.0) as Real, 0.2, 0.2, 0.0]);
                let (start, mut d) = (place(from), place(from + by));
                let stops = post.sweep([5; 3], &start, &mut d, (&shift, &shift), &lattice);
                assert_eq!(stops, Some([if by > 0.0 { 1 } else { -1 }, 0, 0]));
                let found = f64::from(d.0[0]) + 4.5;
                assert!((found - to).abs() < 3e-5, "{periods}: {found} for {to}");
                assert!(!post.contains([5; 3], &d, &shift, &lattice));
            }
        }
    }
}

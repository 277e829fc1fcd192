//! Rigid bodies at their current place, and the depth of points in them.

use physics::Scene;

/// The bodies of a scene at their current place.
pub(crate) struct MovedBodies<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) displacements: &'a [[f64; 3]],
}

impl MovedBodies<'_> {
    /// Low and high corner of the solid voxel that contains `point`.
    pub(crate) fn voxel(&self, point: [f64; 3]) -> Option<[[f64; 3]; 2]> {
        (self.scene.bodies.iter().zip(self.displacements)).find_map(|(body, shift)| {
            let own: [f64; 3] = std::array::from_fn(|a| point[a] - shift[a]);
            body.blocks.iter().find_map(|block| {
                let (origin, voxel) = (block.origin(), block.voxel());
                // The point may lie in a periodic image of the block: shift it into the block itself.
                let at: [f64; 3] = std::array::from_fn(|a| match self.scene.period(a) {
                    Some(period) => origin[a] + (own[a] - origin[a]).rem_euclid(period),
                    None => own[a],
                });
                let low: [f64; 3] = std::array::from_fn(|a| {
                    let below = (at[a] - origin[a]) / voxel[a];
                    point[a] - (below - below.floor()) * voxel[a]
                });
                let high = std::array::from_fn(|a| low[a] + voxel[a]);
                block.contains(at).then_some([low, high])
            })
        })
    }

    /// Distance along an axis from `point` in a body to the nearest place outside all bodies and inside the domain; periodic
    /// sides may be crossed. At most `far`.
    pub(crate) fn depth(&self, point: [f64; 3], far: f64) -> f64 {
        let (min, max) = (self.scene.grid.min_m, self.scene.grid.max_m());
        // Step that leads into the next voxel.
        let hair = 1e-6 * self.scene.grid.cell_m;
        let mut nearest = far;
        for a in 0..self.scene.dimensions.axes() {
            for up in [false, true] {
                let (mut at, mut face) = (point, point[a]);
                while let Some([low, high]) = self.voxel(at) {
                    face = if up { high[a] } else { low[a] };
                    let beyond = if up { face + hair } else { face - hair };
                    if (face - point[a]).abs() >= nearest || beyond == at[a] {
                        break;
                    }
                    at[a] = beyond;
                }
                let periodic = self.scene.period(a).is_some();
                let inside = periodic || at[a] >= min[a] && at[a] <= max[a];
                if inside && self.voxel(at).is_none() {
                    nearest = nearest.min((face - point[a]).abs());
                }
            }
        }
        nearest
    }
}

#[cfg(test)]
mod tests {
    use physics::{Boundary, VoxelBlock};

    use super::*;
    use crate::invariants::check;
    use crate::invariants::tests::{at, block, scene};

    fn depth(scene: &Scene, point: [f64; 3]) -> f64 {
        let placed = MovedBodies {
            scene,
            displacements: &vec![[0.0; 3]; scene.bodies.len()],
        };
        placed.depth(point, 4.0)
    }

    #[test]
    fn depth_is_measured_to_the_nearest_open_face() {
        let scene = scene(vec![block()]);
        assert!((depth(&scene, [5.0 - 0.25, 2.5, 1.5]) - 0.25).abs() < 1e-12);
        // Places outside the domain do not count.
        assert!((depth(&scene, [2.5, 2.5, 0.4]) - 0.6).abs() < 1e-12);
        assert!((depth(&scene, [0.4, 2.5, 0.4]) - 2.5).abs() < 1e-12);
    }

    /// Faces at which another body begins are not open: liquid under a clamp that has gone through the floor is deep in wood.
    #[test]
    fn another_body_beyond_a_face_is_no_way_out() {
        let floor = VoxelBlock::solid_box([0.0; 3], [8.0, 3.0, 3.0]);
        let plate = VoxelBlock::solid_box([0.0, 1.0, 0.0], [8.0, 5.0, 3.0]);
        let scene = scene(vec![floor, plate]);
        assert!((depth(&scene, [4.0, 2.5, 1.5]) - 2.5).abs() < 1e-12);
        let found = check(&scene, 1.0, &at([[4.0, 2.5, 1.5]]), &[[0.0; 3]; 2]);
        assert_eq!((found.points_in_wood, found.points_deep_in_wood), (1, 1));
    }

    /// The periodic images of a displaced body are wood too.
    #[test]
    fn a_body_is_where_its_images_are() {
        let post = VoxelBlock::solid_box([5.0, 0.0, 0.0], [7.0, 6.0, 3.0]);
        let mut scene = scene(vec![post]);
        scene.boundary = [Boundary::Periodic, Boundary::Symmetry, Boundary::Symmetry];
        let at = at([[0.75, 3.0, 1.5], [7.5, 3.0, 1.5], [4.0, 3.0, 1.5]]);
        // From 7 to 9 of 8.
        for periods in [-3.0, 0.0, 1.0, 40.0] {
            let found = check(&scene, 3.0, &at, &[[2.0 + 8.0 * periods, 0.0, 0.0]]);
            assert_eq!((found.points_in_wood, found.points_deep_in_wood), (2, 0));
            assert!((found.deepest_m - 0.5).abs() < 1e-6, "{}", found.deepest_m);
        }
    }
}

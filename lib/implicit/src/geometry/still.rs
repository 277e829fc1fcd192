//! The lattice of voxels at rest.

use physics::{Boundary, VoxelBlock};

use super::lattice::{Lattice, OPEN};

impl Lattice {
    /// The lattice of one body at rest, in `size` cells of `k` voxels an edge from its low corner on, and of its mirror image
    /// behind it along `axis`: periodic along that, with these sides else.
    pub(crate) fn of_voxels(
        solid: &VoxelBlock,
        k: usize,
        mut size: [usize; 3],
        axis: usize,
        sides: Boundary,
    ) -> Self {
        let single = size[axis] * k;
        size[axis] *= 2;
        let mut boundary = [sides; 3];
        boundary[axis] = Boundary::Periodic;
        let [nx, ny, nz] = size.map(|n| n * k);
        let code = |mut at: [usize; 3]| {
            at[axis] = at[axis].min(2 * single - 1 - at[axis]);
            match solid.solid(at[0], at[1], at[2]) {
                true => 1,
                false => OPEN,
            }
        };
        let layer = |y: usize| {
            let places = (0..nz).flat_map(|z| (0..nx).map(move |x| [x, y, z]));
            places.map(code).collect()
        };
        Self {
            k,
            cells: [size[0], size[2]],
            boundary,
            flat: false,
            below: Vec::new(),
            gap: vec![OPEN; nx * nz],
            above: (0..ny).map(layer).collect(),
            gap_low_m: 0.0,
            gap_height: 0.0,
            moving: None,
            mover: None,
            slide: vec![[0.0; 3]],
        }
    }
}

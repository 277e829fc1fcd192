//! Volume of a box that bodies cover.

use physics::Boundary;

use crate::collide::Obstacle;
use crate::lattice::Lattice;
use crate::walls::BlockShape;

/// Volume (cells) of the box from `low` to `high` that bodies cover. In plane strain bodies
/// fill the depth, as their cells do.
pub(super) fn covered(
    low: [f64; 3],
    high: [f64; 3],
    bodies: &[Obstacle],
    lattice: &Lattice,
) -> f64 {
    let whole: f64 = (0..3).map(|a| high[a] - low[a]).product();
    let parts = bodies
        .iter()
        .flat_map(|body| body.parts.iter().map(move |part| (body, part)));
    let overlaps = parts.map(|(body, part)| overlap(low, high, part, &body.to, lattice));
    overlaps.sum::<f64>().min(whole)
}

/// Volume of the solid voxels of a block and its images beyond periodic sides in the box.
fn overlap(
    low: [f64; 3],
    high: [f64; 3],
    part: &BlockShape,
    shift: &[f64; 3],
    lattice: &Lattice,
) -> f64 {
    let size: [f64; 3] = std::array::from_fn(|a| high[a] - low[a]);
    let mut from: [f64; 3] = std::array::from_fn(|a| low[a] - shift[a] - part.origin[a]);
    // Axes along which the box reaches into the next image, too.
    let mut beyond = [None; 3];
    for a in 0..lattice.axes() {
        if lattice.boundary[a] == Boundary::Periodic {
            let period = f64::from(lattice.cells[a]);
            from[a] = from[a].rem_euclid(period);
            beyond[a] = (from[a] + size[a] > period).then_some(period);
        }
    }
    let images = (0..8).filter(|image| (0..3).all(|a| image >> a & 1 == 0 || beyond[a].is_some()));
    images
        .map(|image| {
            let by = |a: usize| beyond[a].filter(|_| image >> a & 1 == 1).unwrap_or(0.0);
            solid_in(part, std::array::from_fn(|a| from[a] - by(a)), size)
        })
        .sum()
}

/// Volume of the solid voxels of a block in the box of `size` whose low corner lies `from` off that of the block.
fn solid_in(part: &BlockShape, from: [f64; 3], size: [f64; 3]) -> f64 {
    let dims = part.solid.dims();
    let voxels = |a: usize, x: f64| x / part.voxel[a];
    let ends: [[f64; 2]; 3] =
        std::array::from_fn(|a| [voxels(a, from[a]), voxels(a, from[a] + size[a])]);
    let range = |a: usize| {
        let [first, end] = ends[a];
        first.floor().max(0.0) as usize..(end.ceil().max(0.0) as usize).min(dims[a])
    };
    let length = |a: usize, i: usize| {
        let [first, end] = ends[a];
        (end.min((i + 1) as f64) - first.max(i as f64)).max(0.0) * part.voxel[a]
    };
    let mut sum = 0.0;
    for k in range(2) {
        for j in range(1) {
            for i in range(0) {
                if part.solid.solid(i, j, k) {
                    sum += length(0, i) * length(1, j) * length(2, k);
                }
            }
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use physics::VoxelBlock;

    use super::*;

    /// A cell that begins before a body and ends in it was open beside periodic sides.
    #[test]
    fn a_box_is_covered_by_all_images() {
        let post = BlockShape {
            origin: [3.25, 0.0, 0.0],
            voxel: [4.0, 10.0, 10.0],
            solid: VoxelBlock::solid_box([0.0; 3], [1.0; 3]),
        };
        let lattice = Lattice::cube(10, Boundary::Periodic);
        for periods in [-2.0, 0.0, 5.0] {
            let shift = [10.0 * periods, 0.0, 0.0];
            let of = |x: f64| overlap([x, 1.0, 1.0], [x + 1.0, 2.0, 2.0], &post, &shift, &lattice);
            for (x, covered) in [(2.0, 0.0), (3.0, 0.75), (4.0, 1.0), (7.0, 0.25), (8.0, 0.0)] {
                assert!((of(x) - covered).abs() < 1e-12, "{x}: {}", of(x));
            }
        }
    }
}

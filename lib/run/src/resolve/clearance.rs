//! Clearance between two blocks of voxels along y.

use physics::VoxelBlock;

/// Distance by which `upper` can move down until two solid voxels touch, m; `None` if they never do.
pub(super) fn clearance(upper: &VoxelBlock, lower: &VoxelBlock, slack: f64) -> Option<f64> {
    let [nx, _, nz] = upper.dims();
    let mut least = f64::INFINITY;
    for (k, i) in (0..nz).flat_map(|k| (0..nx).map(move |i| (k, i))) {
        let Some(bottom) = lowest(upper, i, k) else {
            continue;
        };
        for c in columns(upper, i, lower, 0, slack) {
            for d in columns(upper, k, lower, 2, slack) {
                if let Some(top) = highest_below(lower, c, d, bottom + slack) {
                    least = least.min(bottom - top);
                }
            }
        }
    }
    least.is_finite().then_some(least)
}

/// Indices along `axis` of the voxels of `other` that overlap voxel `index` of `block`.
fn columns(
    block: &VoxelBlock,
    index: usize,
    other: &VoxelBlock,
    axis: usize,
    slack: f64,
) -> std::ops::Range<usize> {
    let low = block.origin()[axis] + index as f64 * block.voxel()[axis] + slack;
    let high = low + block.voxel()[axis] - 2.0 * slack;
    let place = |x: f64| (x - other.origin()[axis]) / other.voxel()[axis];
    // A cast takes negative places to 0.
    place(low) as usize..(place(high).ceil().max(0.0) as usize).min(other.dims()[axis])
}

/// Lower face of the lowest solid voxel of a column, m.
fn lowest(block: &VoxelBlock, i: usize, k: usize) -> Option<f64> {
    let j = (0..block.dims()[1]).find(|&j| block.solid(i, j, k))?;
    Some(block.origin()[1] + j as f64 * block.voxel()[1])
}

/// Upper face of the highest solid voxel of a column that ends at or below `limit`, m.
fn highest_below(block: &VoxelBlock, i: usize, k: usize, limit: f64) -> Option<f64> {
    let top = |j: usize| block.origin()[1] + (j + 1) as f64 * block.voxel()[1];
    let j = (0..block.dims()[1])
        .rev()
        .find(|&j| top(j) <= limit && block.solid(i, j, k))?;
    Some(top(j))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn voxels_meet_where_one_stands_over_the_other() {
        // The lower block has a groove at i = 1; the upper a tooth of two voxels above it.
        let lower = VoxelBlock::from_fn([0.0; 3], [1.0; 3], [3, 3, 1], |i, j, _| i != 1 || j < 1);
        let tooth = VoxelBlock::from_fn([0.0, 5.0, 0.0], [1.0; 3], [3, 3, 1], |i, j, _| {
            i == 1 || j > 1
        });
        assert_eq!(clearance(&tooth, &lower, 1e-9), Some(4.0));
        let plate = VoxelBlock::solid_box([0.0, 5.0, 0.0], [3.0, 6.0, 1.0]);
        assert_eq!(clearance(&plate, &lower, 1e-9), Some(2.0));
    }
}

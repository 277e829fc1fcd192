//! How much of a box the bodies leave open.

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
    parts
        .map(|(body, part)| overlap(low, high, part, &body.to, lattice))
        .sum::<f64>()
        .min(whole)
}

/// Volume of a block's solid voxels in the box.
fn overlap(
    low: [f64; 3],
    high: [f64; 3],
    part: &BlockShape,
    shift: &[f64; 3],
    lattice: &Lattice,
) -> f64 {
    let dims = part.solid.dims();
    let mut from = [0.0; 3];
    let mut range = [(0, 0); 3];
    for a in 0..3 {
        let mut x = low[a] - shift[a] - part.origin[a];
        if lattice.boundary[a] == Boundary::Periodic && a < lattice.axes() {
            x = x.rem_euclid(f64::from(lattice.cells[a]));
        }
        let end = (x + high[a] - low[a]) / part.voxel[a];
        from[a] = x / part.voxel[a];
        range[a] = (
            from[a].floor().max(0.0) as usize,
            (end.ceil().max(0.0) as usize).min(dims[a]),
        );
    }
    let length = |a: usize, i: usize| {
        let end = from[a] + (high[a] - low[a]) / part.voxel[a];
        (end.min((i + 1) as f64) - from[a].max(i as f64)).max(0.0) * part.voxel[a]
    };
    let mut sum = 0.0;
    for k in range[2].0..range[2].1 {
        for j in range[1].0..range[1].1 {
            for i in range[0].0..range[0].1 {
                if part.solid.solid(i, j, k) {
                    sum += length(0, i) * length(1, j) * length(2, k);
                }
            }
        }
    }
    sum
}

//! Rigid bodies that would run into each other: they would overlap, and the liquid between them
//! would have no place left.

use physics::{Boundary, Dimensions, Motion, RigidBody, Scene, VoxelBlock};

/// Part of a cell by which bodies may overlap by rounding.
const ROUNDING: f64 = 1e-6;

/// A box that moves.
type Corners = ([f64; 3], [f64; 3]);

/// Time (s) after which bodies `a` and `b` of `scene` first overlap at their full speeds, and
/// nothing where they never do. Bodies that overlap from the start on purpose, as walls do, are not
/// met; those that have only begun to run into each other are, at a time before the start.
fn meeting_time(scene: &Scene, a: &RigidBody, b: &RigidBody) -> Option<f64> {
    let (va, vb) = (scene.velocity(a.motion), scene.velocity(b.motion));
    let v: [f64; 3] = std::array::from_fn(|i| va[i] - vb[i]);
    let slack = ROUNDING * scene.grid.cell_m;
    let pairs = (a.blocks.iter()).flat_map(|x| b.blocks.iter().map(move |y| (x, y)));
    pairs
        .filter_map(|(x, y)| {
            let voxels = |block: &VoxelBlock| block.dims() != [1; 3];
            if !voxels(x) && !voxels(y) {
                return (images(scene, corners(y)).into_iter())
                    .filter_map(|image| box_time(corners(x), image, v, slack, axes(scene)))
                    .reduce(f64::min);
            }
            box_time(corners(x), corners(y), v, slack, axes(scene))?;
            // Of voxels only the paths of a clamp are followed: along y.
            match v {
                [0.0, down, 0.0] if down < 0.0 => Some(room(x, y, slack)? / -down),
                [0.0, up, 0.0] => Some(room(y, x, slack)? / up),
                _ => None,
            }
        })
        .reduce(f64::min)
}

fn corners(block: &VoxelBlock) -> Corners {
    (block.origin(), block.max())
}

/// Axes along which bodies have an extent that means something.
fn axes(scene: &Scene) -> usize {
    match scene.dimensions {
        Dimensions::Two => 2,
        Dimensions::Three => 3,
    }
}

/// A box and its images through periodic sides.
fn images(scene: &Scene, of: Corners) -> Vec<Corners> {
    let (min, max) = (scene.grid.min_m, scene.grid.max_m());
    let mut found = vec![of];
    for a in (0..3).filter(|&a| scene.boundary[a] == Boundary::Periodic) {
        for (mut low, mut high) in found.clone() {
            let length = max[a] - min[a];
            (low[a], high[a]) = (low[a] - length, high[a] - length);
            found.push((low, high));
            (low[a], high[a]) = (low[a] + 2.0 * length, high[a] + 2.0 * length);
            found.push((low, high));
        }
    }
    found
}

/// When two boxes begin to share more than `slack` along every axis, the first moving at `v`
/// against the second. Where they do from the start, that is before it, and counts only if they are
/// less deep in each other along their way than along any other of the `axes`.
fn box_time(a: Corners, b: Corners, v: [f64; 3], slack: f64, axes: usize) -> Option<f64> {
    let (mut begin, mut end) = (f64::NEG_INFINITY, f64::INFINITY);
    let mut way = 0;
    for (i, v) in v.into_iter().enumerate() {
        let (below, above) = (b.0[i] + slack - a.1[i], b.1[i] - slack - a.0[i]);
        if v == 0.0 {
            if !(below < 0.0 && above > 0.0) {
                return None;
            }
        } else {
            let (t, u) = (below / v, above / v);
            if t.min(u) > begin {
                (begin, way) = (t.min(u), i);
            }
            end = end.min(t.max(u));
        }
    }
    let depth = -begin * v[way].abs();
    let overlap = |i: usize| a.1[i].min(b.1[i]) - a.0[i].max(b.0[i]);
    let entering = || -begin <= end && (0..axes).all(|i| i == way || depth <= overlap(i));
    (begin.is_finite() && begin < end && (begin >= 0.0 || entering())).then_some(begin)
}

/// How far `upper` can come down before a solid voxel of it meets one of `lower`, m.
fn room(upper: &VoxelBlock, lower: &VoxelBlock, slack: f64) -> Option<f64> {
    let [nx, _, nz] = upper.dims();
    let mut least: Option<f64> = None;
    for k in 0..nz {
        for i in 0..nx {
            let Some(bottom) = lowest(upper, i, k) else {
                continue;
            };
            let (columns_x, columns_z) = (
                columns(upper, i, lower, 0, slack),
                columns(upper, k, lower, 2, slack),
            );
            for (c, d) in columns_x.flat_map(|c| columns_z.clone().map(move |d| (c, d))) {
                if let Some(top) = highest_below(lower, c, d, bottom + slack) {
                    let here = bottom - top;
                    least = Some(least.map_or(here, |room| room.min(here)));
                }
            }
        }
    }
    least
}

/// Indices along `axis` of the voxels of `other` that voxel `index` of `block` shares a place with.
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

/// A body of given velocity that the clamp's may run into until `end_s`, however a pressure limit
/// slows the clamp down: by their blocks' corners.
pub(super) fn possible(scene: &Scene, end_s: f64, travel_m: f64, slack: f64) -> Option<&RigidBody> {
    let closing = scene.clamp?.closing_speed;
    let clamped = |body: &&RigidBody| body.motion == Motion::Clamped;
    let moving = |body: &&RigidBody| {
        matches!(body.motion, Motion::Constant(_)) && scene.velocity(body.motion) != [0.0; 3]
    };
    scene.bodies.iter().filter(moving).find(|body| {
        let v = scene.velocity(body.motion);
        (scene.bodies.iter().filter(clamped))
            .flat_map(|clamp| &clamp.blocks)
            .flat_map(|x| body.blocks.iter().map(move |y| (corners(x), corners(y))))
            .flat_map(|(x, y)| images(scene, y).into_iter().map(move |y| (x, y)))
            .any(|(x, y)| {
                // Times at which gap + rate t > 0 holds for all of these.
                let mut sides = vec![(y.1[1] - x.0[1] + travel_m - slack, v[1])];
                for (i, v) in v.into_iter().enumerate() {
                    let lowers = if i == 1 { closing } else { 0.0 };
                    sides.push((y.1[i] - x.0[i] - slack, v + lowers));
                    sides.push((x.1[i] - y.0[i] - slack, -v));
                }
                let (mut begin, mut end) = (0.0_f64, end_s);
                for (gap, rate) in sides {
                    if rate > 0.0 {
                        begin = begin.max(-gap / rate);
                    } else if rate < 0.0 {
                        end = end.min(-gap / rate);
                    } else if gap <= 0.0 {
                        return false;
                    }
                }
                begin < end
            })
    })
}

/// Two bodies that meet.
pub(super) struct Meeting<'a> {
    /// They.
    pub(super) bodies: [&'a RigidBody; 2],
    /// When, at full speed, s.
    pub(super) time_s: f64,
}

/// The first meeting of two bodies one of which, and not more, the clamp drives (`clamped`), or
/// of two that it does not.
pub(super) fn first(scene: &Scene, clamped: bool) -> Option<Meeting<'_>> {
    let bodies = &scene.bodies;
    let mut found: Option<Meeting> = None;
    for (i, a) in bodies.iter().enumerate() {
        for b in bodies.iter().skip(i + 1) {
            let driven = [a, b].map(|body| body.motion == Motion::Clamped);
            if a.motion == b.motion || (driven[0] != driven[1]) != clamped {
                continue;
            }
            if let Some(time_s) = meeting_time(scene, a, b)
                && found.as_ref().is_none_or(|first| time_s < first.time_s)
            {
                found = Some(Meeting {
                    bodies: [a, b],
                    time_s,
                });
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_meet_when_their_gap_is_used_up_and_not_when_they_pass() {
        let floor = ([0.0; 3], [4.0, 1.0, 1.0]);
        let plate = ([0.0, 3.0, 0.0], [4.0, 4.0, 1.0]);
        let at = |v| box_time(plate, floor, v, 1e-9, 2);
        assert!((at([0.0, -2.0, 0.0]).unwrap() - 1.0).abs() < 1e-6);
        assert_eq!(at([0.0, 2.0, 0.0]), None, "it moves away");
        assert_eq!(at([8.0, -2.0, 0.0]), None, "it has passed by then");
        let far = ([-10.0, 3.0, 0.0], [-6.0, 4.0, 1.0]);
        assert_eq!(
            box_time(far, floor, [2.0, -2.0, 0.0], 1e-9, 2),
            None,
            "it has fallen past the floor before it comes over it"
        );
        let beside = ([4.0, 0.0, 0.0], [5.0, 4.0, 1.0]);
        assert_eq!(box_time(plate, beside, [0.0, -2.0, 0.0], 1e-9, 2), None);
        let within = ([0.0; 3], [4.0, 3.1, 1.0]);
        let early = box_time(plate, within, [0.0, -2.0, 0.0], 1e-9, 2).unwrap();
        assert!((early + 0.05).abs() < 1e-6, "{early}");
        assert_eq!(box_time(plate, within, [0.0, 2.0, 0.0], 1e-9, 2), None);
        assert_eq!(
            box_time(plate, within, [1.0, 0.0, 0.0], 1e-9, 2),
            None,
            "a wall along it"
        );
    }

    #[test]
    fn voxels_meet_where_one_stands_over_the_other() {
        // The lower block has a groove at i = 1; the upper a tooth of two voxels above it.
        let lower = VoxelBlock::from_fn([0.0; 3], [1.0; 3], [3, 3, 1], |i, j, _| i != 1 || j < 1);
        let tooth = VoxelBlock::from_fn([0.0, 5.0, 0.0], [1.0; 3], [3, 3, 1], |i, j, _| {
            i == 1 || j > 1
        });
        assert_eq!(room(&tooth, &lower, 1e-9), Some(4.0));
        let plate = VoxelBlock::solid_box([0.0, 5.0, 0.0], [3.0, 6.0, 1.0]);
        assert_eq!(room(&plate, &lower, 1e-9), Some(2.0));
    }
}

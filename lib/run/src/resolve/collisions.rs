//! Collisions of rigid bodies with one another or with their mirror images; liquid between them would have no place left.

use std::fmt;

use physics::{Boundary, Motion, RigidBody, Scene, VoxelBlock, norm};

use super::clearance::clearance;
use super::intervals::{AxisOverlap, joint_overlaps};

/// AxisOverlap due to rounding, cells.
const ROUNDING: f64 = 1e-6;

/// The obstacle of a colliding body.
#[derive(Clone, Copy, Debug)]
pub(super) enum Obstacle<'a> {
    /// Another body.
    Body(&'a RigidBody),
    /// A symmetry side, from behind which the body's own image approaches: axis, and whether it is the upper side.
    Mirror(usize, bool),
}

impl fmt::Display for Obstacle<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Body(body) => write!(f, "'{}'", body.name),
            Self::Mirror(axis, upper) => write!(
                f,
                "the symmetry side at the {} end of {}",
                if upper { "upper" } else { "lower" },
                ["x", "y", "z"][axis]
            ),
        }
    }
}

/// A collision of a body with an obstacle.
#[derive(Debug)]
pub(super) struct Collision<'a> {
    pub(super) body: &'a RigidBody,
    pub(super) with: Obstacle<'a>,
    /// Time at full speed, s; negative if the two already overlap slightly at the start.
    pub(super) time_s: f64,
    /// Relative speed, m/s.
    pub(super) speed: f64,
}

/// The first collision until `until_s` (s). With `clamped`: of a body that the clamp drives with another one or a symmetry
/// side; else among the bodies that the clamp does not drive, or of one of them with a side.
pub(super) fn first_collision(scene: &Scene, clamped: bool, until_s: f64) -> Option<Collision<'_>> {
    let driven = |body: &RigidBody| body.motion == Motion::Clamped;
    let bodies = &scene.bodies;
    let pairs = (bodies.iter().enumerate())
        .flat_map(|(i, a)| bodies.iter().skip(i + 1).map(move |b| (a, b)))
        .filter(|(a, b)| a.motion != b.motion && (driven(a) != driven(b)) == clamped)
        .filter_map(|(a, b)| with_body(scene, a, b, until_s));
    let mirrored = (bodies.iter().filter(|body| driven(body) == clamped))
        .filter_map(|body| with_mirror(scene, body, until_s));
    (pairs.chain(mirrored)).min_by(|a, b| a.time_s.total_cmp(&b.time_s))
}

/// The first collision of `a` and `b` at full speed. Bodies that overlap from the start, such as walls, do not collide. Bodies
/// that have only just begun to overlap collided before the start.
fn with_body<'a>(
    scene: &Scene,
    a: &'a RigidBody,
    b: &'a RigidBody,
    until_s: f64,
) -> Option<Collision<'a>> {
    let (va, vb) = (scene.velocity(a.motion), scene.velocity(b.motion));
    let v: [f64; 3] = std::array::from_fn(|i| va[i] - vb[i]);
    let voxels = |block: &VoxelBlock| block.dims() != [1; 3];
    let pairs = (a.blocks.iter()).flat_map(|x| b.blocks.iter().map(move |y| (x, y)));
    let time_s = pairs
        .filter_map(|(x, y)| {
            let met = first_overlap_of_boxes(scene, x, y, v, until_s)?;
            if !voxels(x) && !voxels(y) {
                return Some(met);
            }
            // Bodies of voxels come from a bond file and move along y only.
            let slack = ROUNDING * scene.grid.cell_m;
            match v {
                [0.0, down, 0.0] if down < 0.0 => Some(clearance(x, y, slack)? / -down),
                [0.0, up, 0.0] => Some(clearance(y, x, slack)? / up),
                _ => Some(met),
            }
        })
        .reduce(f64::min)?;
    let (body, with) = match b.motion {
        Motion::Clamped => (b, a),
        _ => (a, b),
    };
    Some(Collision {
        body,
        with: Obstacle::Body(with),
        time_s,
        speed: norm(v),
    })
}

/// Time of the first overlap of the boxes around two blocks; the first moves at `v` (m/s) relative to the second.
fn first_overlap_of_boxes(
    scene: &Scene,
    a: &VoxelBlock,
    b: &VoxelBlock,
    v: [f64; 3],
    until_s: f64,
) -> Option<f64> {
    let along = |i| axis_overlap(scene, i, a, b, v[i], ROUNDING * scene.grid.cell_m);
    let axes = [along(0)?, along(1)?, along(2)?];
    joint_overlaps(axes, until_s)
        .find(|found| found.begin >= 0.0 || found.has_just_begun(&axes, scene.dimensions.axes()))
        .map(|found| found.begin)
}

/// Times at which the boxes around two blocks overlap along `axis` by more than `slack` (m); the first moves at `v` (m/s)
/// along it relative to the second.
fn axis_overlap(
    scene: &Scene,
    axis: usize,
    a: &VoxelBlock,
    b: &VoxelBlock,
    v: f64,
    slack: f64,
) -> Option<AxisOverlap> {
    let [a, b] = [a, b].map(|block| [block.origin()[axis], block.max()[axis]]);
    let length = scene.period(axis).unwrap_or(f64::INFINITY);
    AxisOverlap::of(a, b, v, length, slack)
}

/// The first contact of a body within the domain with a symmetry side. A body that crosses the side from the start is a wall
/// or a piston and does not collide.
fn with_mirror<'a>(scene: &Scene, body: &'a RigidBody, until_s: f64) -> Option<Collision<'a>> {
    let v = scene.velocity(body.motion);
    let (low, high) = (scene.grid.min_m, scene.grid.max_m());
    let slack = ROUNDING * scene.grid.cell_m;
    let sides = (0..scene.dimensions.axes())
        .filter(|&a| scene.boundary[a] == Boundary::Symmetry && v[a] != 0.0);
    sides
        .flat_map(|a| body.blocks.iter().map(move |block| (a, block)))
        .filter_map(|(a, block)| {
            let gap = match v[a] > 0.0 {
                true => high[a] - block.max()[a],
                false => block.origin()[a] - low[a],
            };
            let time_s = gap.max(0.0) / v[a].abs();
            (gap > -slack && time_s < until_s).then_some(Collision {
                body,
                with: Obstacle::Mirror(a, v[a] > 0.0),
                time_s,
                speed: v[a].abs(),
            })
        })
        .min_by(|a, b| a.time_s.total_cmp(&b.time_s))
}

/// A body of given velocity that may meet the clamp's body until `until_s` (s). A pressure limit may hold the clamp anywhere
/// within `travel_m` (m), so the whole swept box counts.
pub(super) fn may_meet_clamp(
    scene: &Scene,
    until_s: f64,
    travel_m: f64,
    slack: f64,
) -> Option<&RigidBody> {
    let way = travel_m.min(scene.clamp?.closing_speed * until_s);
    let clamped = |body: &&RigidBody| body.motion == Motion::Clamped;
    let moving = |body: &&RigidBody| {
        matches!(body.motion, Motion::Constant(_)) && scene.velocity(body.motion) != [0.0; 3]
    };
    scene.bodies.iter().filter(moving).find(|body| {
        let v = scene.velocity(body.motion);
        let clamps = scene.bodies.iter().filter(clamped);
        let blocks = clamps.flat_map(|clamp| &clamp.blocks);
        (blocks.flat_map(|x| body.blocks.iter().map(move |y| (x, y)))).any(|(x, y)| {
            let [mut low, high] = [x.origin(), x.max()];
            low[1] -= way;
            let swept = VoxelBlock::solid_box(low, high);
            let along = |axis| axis_overlap(scene, axis, y, &swept, v[axis], slack);
            let axes = along(0).zip(along(1)).zip(along(2));
            axes.is_some_and(|((x, y), z)| joint_overlaps([x, y, z], until_s).next().is_some())
        })
    })
}

#[cfg(test)]
mod tests {
    use physics::{Clamp, Dimensions, GridBox};

    use super::*;
    use crate::verdict::tests::setup;

    const UM: f64 = 1e-6;

    /// A plane domain of 40 x 20 cells of 1 um with periodic sides along x and mirrors along y.
    fn scene(bodies: &[(&str, Motion, [f64; 4])]) -> Scene {
        let body = |&(name, motion, [x, y, to_x, to_y]): &(&str, Motion, [f64; 4])| RigidBody {
            name: name.into(),
            blocks: vec![VoxelBlock::solid_box(
                [x * UM, y * UM, 0.0],
                [to_x * UM, to_y * UM, UM],
            )],
            motion,
        };
        Scene {
            dimensions: Dimensions::Two,
            grid: GridBox {
                cell_m: UM,
                min_m: [0.0; 3],
                cells: [40, 20, 1],
            },
            boundary: [Boundary::Periodic, Boundary::Symmetry, Boundary::Symmetry],
            bodies: bodies.iter().map(body).collect(),
            ..setup().scene
        }
    }

    #[track_caller]
    fn meet(scene: &Scene, until_us: f64, who: &str, time_us: f64) {
        let met = first_collision(scene, false, until_us * UM).unwrap();
        assert_eq!(format!("{} and {}", met.body.name, met.with), who);
        let time = met.time_s / UM;
        assert!((time - time_us).abs() < 1e-4, "{time}");
    }

    const FLOOR: (&str, Motion, [f64; 4]) = ("floor", Motion::Fixed, [0.0, 0.0, 40.0, 2.0]);
    const POST: (&str, Motion, [f64; 4]) = ("post", Motion::Fixed, [30.0, 2.0, 32.0, 8.0]);

    /// Periodic images further than one period away count too.
    #[test]
    fn a_bar_meets_a_post_in_the_period_in_which_it_has_come_down_to_it() {
        let bar = Motion::Constant([1.0, -0.05, 0.0]);
        let bar = ("bar", bar, [2.0, 12.0, 22.0, 14.0]);
        // The bar is as low as the post from 80 us on, in its third period, and passes over the post before.
        let over = scene(&[FLOOR, bar, POST]);
        meet(&over, 300.0, "bar and 'post'", 88.0);
        assert!(first_collision(&over, false, 87.0 * UM).is_none());
        meet(&scene(&[FLOOR, bar]), 300.0, "floor and 'bar'", 200.0);
    }

    #[test]
    fn a_body_meets_its_image_where_it_comes_to_a_mirror() {
        let block = |v: f64, y: f64| {
            let block = Motion::Constant([3.0, v, 0.0]);
            scene(&[("block", block, [2.0, y, 4.0, y + 4.0])])
        };
        for (v, end, time) in [(-1.0, "lower", 5.0), (2.0, "upper", 5.5)] {
            let who = format!("block and the symmetry side at the {end} end of y");
            meet(&block(v, 5.0), 1e6, &who, time);
        }
        // A piston through the side, and one that enters through it.
        assert!(first_collision(&block(-1.0, -1.0), false, 1.0).is_none());
        assert!(first_collision(&block(-1.0, 20.0), false, 19.0 * UM).is_none());
        // A plate slides along the floor for ever.
        let along = Motion::Constant([1.0, 0.0, 0.0]);
        let plate = ("plate", along, [0.0, 2.0, 40.0, 4.0]);
        assert!(first_collision(&scene(&[FLOOR, plate]), false, 1.0).is_none());
    }

    /// A body comes round through periodic sides while the clamp may be anywhere on its way.
    #[test]
    fn a_body_may_come_under_the_clamp_after_many_periods() {
        let top = ("top", Motion::Clamped, [30.0, 14.0, 34.0, 18.0]);
        let bar = |v: [f64; 2], y: f64| {
            let bar = Motion::Constant([v[0], v[1], 0.0]);
            let mut scene = scene(&[top, ("bar", bar, [2.0, y, 4.0, y + 1.0])]);
            scene.clamp = Some(Clamp {
                closing_speed: 0.05,
                max_pressure: Some(1e6),
                pid: None,
            });
            scene
        };
        let within = |scene: &Scene, until: f64, travel: f64| {
            may_meet_clamp(scene, until * UM, travel * UM, 1e-3 * UM).is_some()
        };
        // The bar is under the clamp from 26 to 32 and from 66 to 72 us; the clamp comes down to 12 um after 40 us at the earliest.
        let bar = bar([1.0, 0.0], 11.0);
        assert!(!within(&bar, 39.0, 3.0) && within(&bar, 67.0, 3.0));
        assert!(!within(&bar, 1e3, 1.9), "it does not come so far down");
    }
}

//! Pressure while a lumen fills.

use physics::{Motion, Scene, StepLimit, Stop, VoxelBlock, WallLaw};

use crate::plain;
use crate::runs::{clamp, press, with};

const VOXEL: f64 = 1.45e-6;
/// Voxels along x and z, of each body and of the slab.
const ACROSS: [usize; 2] = [24, 8];
const DEEP: usize = 40;
const SLAB: usize = 6;

/// A slab over two lumens, one of them 7 voxels deep, pressed by 5 of its 6 voxels in cells of two.
fn scene() -> Scene {
    let mut scene = plain::scene(2.0 * VOXEL, [ACROSS[0] / 2, DEEP + SLAB / 2, ACROSS[1] / 2]);
    let block = |low: usize, wood: &dyn Fn(usize, usize) -> bool| {
        let place = [0.0, low as f64 * VOXEL, 0.0];
        let size = [ACROSS[0], DEEP, ACROSS[1]];
        vec![VoxelBlock::from_fn(place, [VOXEL; 3], size, |x, y, _| {
            wood(x, y)
        })]
    };
    let lumens = |x: usize, y: usize| {
        !((2..8).contains(&x) && y >= 4 || (14..20).contains(&x) && y >= DEEP - 7)
    };
    let blocks = [block(0, &lumens), block(DEEP + SLAB, &|_, _| true)];
    press(&mut scene, ["below", "above"], blocks, Motion::Clamped);
    let low = [0.0, DEEP as f64 * VOXEL, 0.0];
    scene.points = plain::fill(low, [VOXEL; 3], [ACROSS[0], SLAB, ACROSS[1]]);
    scene.wall = WallLaw::PartialSlip {
        influence_length_m: 0.02 * VOXEL,
    };
    scene.clamp = clamp(1e-3, 150e6);
    scene.stop = Stop::Closed {
        travel_m: 5.0 * VOXEL,
    };
    scene
}

/// Pressures by the travel in the middle of each step.
fn course(cfl: f64) -> Vec<[f64; 2]> {
    let scene = scene();
    let mut scheme = with(&scene, |settings| settings.cfl = cfl);
    let mut left = 5.0 * VOXEL;
    let mut found = Vec::new();
    while left > 1e-3 * VOXEL {
        let before = left;
        let limit = StepLimit {
            time_s: 1.0,
            travel_m: left,
        };
        let report = physics::Scheme::advance(&mut scheme, limit).unwrap();
        left = 5.0 * VOXEL - report.travel_m;
        found.push([5.0 * VOXEL - 0.5 * (before + left), report.pressure_top]);
    }
    found
}

/// What flows into a lumen in the step in which it fills, beyond its room, has to leave it in the steps after: how much more
/// pressure that takes docs/methods.md section 3.14 tells.
#[test]
fn pressure_after_a_lumen_has_filled_is_known_by_its_order() {
    let fine = course(0.1);
    let at = |travel: f64| {
        let next = fine.partition_point(|point| point[0] < travel);
        let next = next.clamp(1, fine.len() - 1);
        let [low, high] = [fine[next - 1], fine[next]];
        let part = (travel - low[0]) / (high[0] - low[0]);
        low[1] + part * (high[1] - low[1])
    };
    for (cfl, most) in [(1.0, 3.1), (0.2, 1.25)] {
        let ratios = course(cfl).into_iter().map(|[travel, p]| p / at(travel));
        let high = ratios.fold(0.0, f64::max);
        println!("Courant number {cfl}: up to {high:.2} times the pressure of short steps");
        assert!(high < most);
    }
}

//! Steps that are taken again.

use physics::{Motion, Scheme, StepLimit, VoxelBlock, Wetting};

use super::*;

#[path = "../../tests/common/plain.rs"]
pub(super) mod plain;

/// Edge of a cell, m.
const H: f64 = 2.9e-6;

/// A slug in the wider and the narrower part of a slit, whose solves take `iterations` at most.
fn slug(wetting: bool, iterations: usize) -> Implicit {
    let mut scene = plain::scene(H, [24, 10, 1]);
    let block = |low: [f64; 2], high: [f64; 2]| {
        VoxelBlock::solid_box([low[0] * H, low[1] * H, 0.0], [high[0] * H, high[1] * H, H])
    };
    let wood = vec![
        block([-9.0, -9.0], [33.0, 1.5]),
        block([12.0, 7.5], [33.0, 19.0]),
    ];
    scene.bodies = vec![plain::body("wood", wood, Motion::Fixed)];
    scene.points = plain::fill([4.0 * H, 1.5 * H, 0.0], [0.5 * H, 0.5 * H, H], [24, 12, 1]);
    scene.liquid.wetting = wetting.then_some(Wetting {
        tension: 0.05,
        advancing: 1.0,
        receding: 1.0,
    });
    // What drives the slug without menisci.
    scene.gravity = [-1e4, 0.0, 0.0];
    let mut scheme = Implicit::new(scene, Settings::default()).unwrap();
    scheme.workspace.solver = SaddleSolver::new(SaddleOptions {
        max_iterations: iterations,
        ..SaddleOptions::default()
    });
    scheme
}

fn limit(time_s: f64) -> StepLimit {
    StepLimit {
        time_s,
        travel_m: f64::INFINITY,
    }
}

/// A step that is not solved in so many iterations is taken again at a quarter of its length, thrice at most, and leaves what one of that
/// length from the start leaves, to the bit. Without menisci, which are the stiffer the longer a step is, it is refused.
#[test]
fn a_step_that_is_not_solved_is_taken_again_shorter() {
    let dt = 1e-5;
    for (iterations, part) in [
        (10, 1.0),
        (8, 0.25),
        (7, 0.25 * 0.25),
        (4, 0.25 * 0.25 * 0.25),
    ] {
        let mut again = slug(true, iterations);
        let report = again.advance(limit(dt)).unwrap();
        println!("{iterations} iterations: {:e} of {dt:e} s", report.dt_s);
        assert_eq!(report.dt_s, part * dt, "{iterations} iterations");
        let mut short = slug(true, iterations);
        short.advance(limit(part * dt)).unwrap();
        assert_eq!(again.save(), short.save(), "{iterations} iterations");
    }
    assert!(slug(true, 3).advance(limit(dt)).is_err());
    assert!(slug(false, 7).advance(limit(dt)).is_ok());
    assert!(slug(false, 6).advance(limit(dt)).is_err());
}

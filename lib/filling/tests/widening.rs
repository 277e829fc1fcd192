//! A meniscus where its passage widens: Gibbs' condition. Run with `--nocapture` to see the errors.

#![allow(clippy::print_stdout, reason = "prints for developers")]

#[path = "common/plain.rs"]
mod plain;

use filling::{Implicit, Settings};
use physics::{Motion, Scheme, StepLimit, VoxelBlock, Wetting};

/// Width of the slit, m.
const H: f64 = 17.4e-6;
const ETA: f64 = 1.3;
/// Surface tension, N/m.
const SIGMA: f64 = 0.05;

/// How far over H a slug of 3 H in a slit of `n` cells, its walls off by `offset`, has gone, to 2, in which it would go 20
/// alone, and in how many steps: one H ahead of it the slit becomes twice as wide. A body force along it gives `share` of what its pull falls by there.
fn gone(n: usize, offset: [f64; 2], degrees: f64, share: f64) -> (f64, usize) {
    let (h, far) = (H / n as f64, 99.0 * H);
    let [low, start] = [
        (0.5 * n as f64 + 2.0 + offset[1]) * h,
        (n as f64 + offset[0]) * h,
    ];
    let edge = start + 4.0 * H;
    let block = |low: [f64; 2], high: [f64; 2]| {
        VoxelBlock::solid_box([low[0], low[1], 0.0], [high[0], high[1], h])
    };
    let plates = vec![
        block([-far, -far], [edge, low]),
        block([edge, -far], [far, low - 0.5 * H]),
        block([-far, low + H], [edge, far]),
        block([edge, low + 1.5 * H], [far, far]),
    ];
    let mut scene = plain::scene(h, [9 * n, 2 * n + 5, 1]);
    let size = [0.5 * h, 0.5 * h, h];
    scene.points = plain::fill([start, low, 0.0], size, [6 * n, 2 * n, 1]);
    let angle = f64::to_radians(degrees);
    scene.liquid.wetting = Some(Wetting {
        tension: SIGMA,
        advancing: angle,
        receding: angle,
    });
    let force = share * SIGMA * angle.cos().abs() / H / (3.0 * H);
    scene.gravity[0] = force / scene.liquid.density;
    scene.bodies = vec![plain::body("plates", plates, Motion::Fixed)];
    let middle = |scheme: &Implicit| {
        let liquid = scheme.liquid();
        let sum: f64 = liquid.position.iter().map(|x| f64::from(x[0])).sum();
        sum / liquid.position.len() as f64 / H
    };
    let mut scheme = Implicit::new(scene, Settings::default()).unwrap();
    let before = middle(&scheme);
    let end = 20.0 * 12.0 * ETA / (force * H);
    let (mut time, mut steps, mut way) = (0.0, 0, 0.0);
    while time < end * (1.0 - 1e-9) && way < 2.0 {
        let limit = StepLimit {
            time_s: (end - time).min(0.02 * end),
            travel_m: f64::INFINITY,
        };
        time += scheme.advance(limit).unwrap().dt_s;
        way = middle(&scheme) - before;
        steps += 1;
    }
    println!(
        "slit of {n} cells off by {offset:?}, {degrees} degrees, {share} of the fall: {way:.3} H in {steps} steps"
    );
    (way, steps)
}

/// Under less than its pull falls by, a slug goes on to the edge and rests there; a sharp edge holds it at most by
/// 2 (1 + tan theta) of the fall, where it would spread along the wall beyond.
#[test]
fn a_meniscus_rests_where_its_slit_widens() {
    const CELL: f64 = 1.0 / 6.0;
    for (offset, degrees, over) in [
        ([0.0, 0.0], 0.0, 3.0),
        ([0.5, 0.2], 60.0, 8.0),
        ([0.3, 0.5], 60.0, 8.0),
    ] {
        for share in [0.2, 0.5, 0.8] {
            let (way, steps) = gone(6, offset, degrees, share);
            println!("off the edge by {:+.3} cells", (way - 1.0) / CELL);
            assert!((way - 1.0).abs() < CELL);
            // Fifty are asked for; without pins it takes 626 to thousands.
            assert!(steps < 600);
        }
        assert!(gone(6, offset, degrees, over).0 >= 2.0);
    }
}

/// Way, in cells, of a slug of 10 cells in a slit of so many `cells`: menisci pull alike at both its ends.
fn way_of_narrow(cells: f64, tension: f64) -> f64 {
    let (h, far) = (2.9e-6, 1.0);
    let (low, height) = (2.0 * h, cells * h);
    let plates = [[-far, low], [low + height, far]]
        .map(|[from, to]| VoxelBlock::solid_box([-far, from, 0.0], [far, to, h]));
    let mut scene = plain::scene(h, [30, 5, 1]);
    let size = [0.5 * h, 0.5 * height, h];
    scene.points = plain::fill([4.0 * h, low, 0.0], size, [20, 2, 1]);
    scene.liquid.wetting = Some(Wetting {
        tension,
        advancing: f64::to_radians(60.0),
        receding: f64::to_radians(60.0),
    });
    let force = 0.4 * SIGMA / height / (10.0 * h);
    scene.gravity[0] = force / scene.liquid.density;
    scene.bodies = vec![plain::body("plates", plates.to_vec(), Motion::Fixed)];
    let mut scheme = Implicit::new(scene, Settings::default()).unwrap();
    let middle = |scheme: &Implicit| {
        let liquid = scheme.liquid();
        let sum: f64 = liquid.position.iter().map(|x| f64::from(x[0])).sum();
        sum / liquid.position.len() as f64 / h
    };
    let (before, end) = (
        middle(&scheme),
        6.0 * h * 12.0 * ETA / (force * height * height),
    );
    let mut time = 0.0;
    while time < end * (1.0 - 1e-9) {
        let limit = StepLimit {
            time_s: end - time,
            travel_m: f64::INFINITY,
        };
        time += scheme.advance(limit).unwrap().dt_s;
    }
    middle(&scheme) - before
}

/// Walls that are nowhere wider hold nothing, however narrow.
#[test]
fn a_slit_of_a_cell_holds_no_slug() {
    for cells in [1.0, 0.5] {
        let [with, without] = [SIGMA, 1e-9].map(|tension| way_of_narrow(cells, tension));
        println!("slit of {cells} cells: way {with:.3} with menisci, {without:.3} without");
        assert!(without > 4.0 && (with / without - 1.0).abs() < 0.02);
    }
}

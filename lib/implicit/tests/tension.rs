//! Liquid that hangs in a slit closed above, and is torn off where it carries more tension than it can.

#![allow(clippy::print_stdout, reason = "prints for developers")]

#[path = "common/plain.rs"]
mod plain;

use implicit::{Implicit, Settings};
use physics::{Motion, Scheme, StepLimit, VoxelBlock};

/// Mean speed down over that of developed flow without a closed end, of liquid that pulls at its end with `pull` (Pa) and carries `most`.
fn speed(pull: f64, most: f64) -> f64 {
    let (h, n, length) = (2.9e-6, 6, 24);
    let m = |cells: usize| cells as f64 * h;
    let block = |low: [usize; 2], high: [usize; 2]| {
        VoxelBlock::solid_box([m(low[0]), m(low[1]), 0.0], [m(high[0]), m(high[1]), h])
    };
    let top = 2 * length;
    let mut scene = plain::scene(h, [n + 2, top + 2, 1]);
    let walls = vec![
        block([0, top], [n + 2, top + 2]),
        block([n, 0], [n + 2, top]),
    ];
    scene.bodies = vec![plain::body("wall", walls, Motion::Fixed)];
    let low = [0.0, m(top - length), 0.0];
    scene.points = plain::fill(low, [0.5 * h, 0.5 * h, h], [2 * n, 2 * length, 1]);
    // No inertia and no sound.
    scene.liquid.density = 1e-3;
    scene.gravity[1] = -pull / (scene.liquid.density * m(length));
    scene.liquid.tait.bulk_modulus = 1e14;
    scene.liquid.cavitation_pressure = Some(most);
    // Half of the slit lies beyond the mirror.
    let exact = pull / m(length) * m(2 * n).powi(2) / (12.0 * 1.3);
    let settings = Settings {
        tolerance: 1e-6,
        ..Settings::default()
    };
    let mut scheme = Implicit::new(&scene, settings).unwrap();
    let limit = StepLimit {
        time_s: 1e-3 * h / exact,
        travel_m: f64::INFINITY,
    };
    for _ in 0..3 {
        scheme.advance(limit).unwrap();
    }
    let liquid = scheme.liquid();
    let volume: f64 = liquid.volume.iter().map(|&v| f64::from(v)).sum();
    let flow = liquid.velocity.iter().zip(&liquid.volume);
    let flow: f64 = flow
        .map(|(v, &volume)| f64::from(v[1]) * f64::from(volume))
        .sum();
    println!(
        "pull {pull} Pa of {most} Pa: speed {:.4}",
        -flow / volume / exact
    );
    -flow / volume / exact
}

#[test]
fn liquid_is_torn_off_where_it_carries_too_much() {
    assert!(speed(1e5, 1.1e5).abs() < 1e-3);
    for pull in [2e5, 4e5] {
        let share = speed(pull, 1e5) / speed(pull, 1.0);
        println!("{share:.4} of the speed without tension");
        // What comes apart is a layer, a cell or two of it.
        assert!((share - (1.0 - 1e5 / pull)).abs() < 0.1);
    }
}

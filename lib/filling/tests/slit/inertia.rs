//! From which Reynolds number on inertia is kept from feeding on itself.

use filling::{Implicit, Settings};
use physics::{Boundary, Motion, Scheme, StepLimit, VoxelBlock};

use crate::{ETA, plain};

/// Fastest particle over the mean velocity in a channel of two cells, driven such that a cell's Reynolds
/// number is `reynolds`.
fn peak(reynolds: f64) -> f64 {
    let h = 1e-6;
    let mut scene = plain::scene(h, [4, 6, 1]);
    let speed = reynolds * ETA / (scene.liquid.density * h);
    scene.boundary[0] = Boundary::Periodic;
    // Mean velocity of plane Poiseuille flow.
    let pull = 3.0 * ETA * speed / (scene.liquid.density * h * h);
    scene.gravity = [pull, 0.0, 0.0];
    let wall =
        |from: f64, to: f64| VoxelBlock::solid_box([-h, from * h, 0.0], [9.0 * h, to * h, h]);
    let walls = vec![wall(-9.0, 2.0), wall(4.0, 19.0)];
    scene.bodies = vec![plain::body("walls", walls, Motion::Fixed)];
    scene.points = plain::fill([0.0, 2.0 * h, 0.0], [0.5 * h, 0.5 * h, h], [8, 4, 1]);
    let mut scheme = Implicit::new(scene, Settings::default()).unwrap();
    for _ in 0..6 {
        let limit = StepLimit {
            time_s: h / speed,
            travel_m: f64::INFINITY,
        };
        scheme.advance(limit).unwrap();
    }
    let fastest = |most: f32, v: &[f32; 3]| most.max(v[0]);
    f64::from(scheme.liquid().velocity.iter().fold(0.0, fastest)) / speed
}

/// Particles 3/8 of the width off a wall move 45/32 times as fast as the mean; limited, by an eighth more.
#[test]
fn particles_carry_the_profile_up_to_a_reynolds_number_of_a_tenth() {
    let (viscous, inertial) = (peak(0.07), peak(0.14));
    println!("{viscous:.4} and {inertial:.4} of the mean");
    assert!((viscous - 45.0 / 32.0).abs() < 0.02);
    assert!((inertial - 1.125).abs() < 0.02);
}

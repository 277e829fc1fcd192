//! Liquid that hangs in a slit closed above, and is torn off where it carries more tension than it can.

use physics::{Motion, Scheme};

use crate::plain;
use crate::runs::{ETA, advance, block, solved};

/// Mean downward speed over that of developed flow without a closed end. The weight puts the liquid at the closed end under the
/// tension `pull` (Pa); it bears `most`.
fn speed(pull: f64, most: f64) -> f64 {
    let (h, n, length) = (2.9e-6, 6, 24);
    let m = |cells: usize| cells as f64 * h;
    let top = 2 * length;
    let mut scene = plain::scene(h, [n + 2, top + 2, 1]);
    let (wide, end) = ((n + 2) as f64, top as f64);
    let walls = vec![
        block(h, [0.0, end], [wide, end + 2.0]),
        block(h, [n as f64, 0.0], [wide, end]),
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
    let exact = pull / m(length) * m(2 * n).powi(2) / (12.0 * ETA);
    let mut scheme = solved(&scene, 1e-6);
    (0..3).for_each(|_| _ = advance(&mut scheme, 1e-3 * h / exact));
    let liquid = scheme.liquid();
    let sum = |of: &dyn Fn(usize) -> f32| -> f64 {
        let points =
            (0..liquid.volume.len()).map(|i| f64::from(of(i)) * f64::from(liquid.volume[i]));
        points.sum()
    };
    let found = -sum(&|i| liquid.velocity[i][1]) / sum(&|_| 1.0) / exact;
    println!("pull {pull} Pa of {most} Pa: speed {found:.4}");
    found
}

#[test]
fn liquid_is_torn_off_where_it_carries_too_much() {
    assert!(speed(1e5, 1.1e5).abs() < 1e-3);
    for pull in [2e5, 4e5] {
        let share = speed(pull, 1e5) / speed(pull, 1.0);
        println!("{share:.4} of the speed without tension");
        // A layer of one or two cells is torn.
        assert!((share - (1.0 - 1e5 / pull)).abs() < 0.1);
    }
}

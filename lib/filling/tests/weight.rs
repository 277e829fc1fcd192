//! Liquid that stands under its weight.

#![allow(clippy::print_stdout, reason = "prints for developers")]

#[path = "common/march.rs"]
mod march;
#[path = "common/plain.rs"]
mod plain;

use filling::{Implicit, Settings};
use physics::{Boundary, Motion, Newtonian, Scheme, StepLimit, Viscosity, VoxelBlock};

/// Nothing of it moves, by steps that grow to 0.2 s: its weight is not what the solver's tolerance is relative to. On a side of the domain
/// no body bears it: forces on bodies are no measure of what the solver leaves. A floor bears the weight of 10 mm, less that of half the
/// cell next to it, whose pressure is that of its centre.
#[test]
fn thin_liquid_stands_on_a_side_and_on_a_floor() {
    let (h, far) = (1e-3, 1.0);
    for floor in [0.0, 2.0 * h] {
        let mut scene = plain::scene(h, [8, 16, 8]);
        if floor > 0.0 {
            let block = VoxelBlock::solid_box([-far; 3], [far, floor, far]);
            scene.bodies = vec![plain::body("floor", vec![block], Motion::Fixed)];
            scene.bottom = Some(0);
        }
        scene.points = plain::fill([0.0, floor, 0.0], [0.5 * h; 3], [16, 20, 16]);
        scene.liquid.viscosity = Viscosity::Newtonian(Newtonian(1e-3));
        scene.gravity[1] = -9.81;
        let mut scheme = Implicit::new(scene, Settings::default()).unwrap();
        let mut pressure = 0.0;
        march::until(&mut scheme, 0.5, |report, _| {
            pressure = report.pressure_bottom;
        });
        let heights = scheme.liquid().position.into_iter().map(|x| x[1].into());
        let top = heights.fold(0.0, f64::max) - floor;
        println!("{pressure:.2} Pa, highest point at {top:.5} m");
        if floor > 0.0 {
            let error = pressure / (1200.0 * 9.81 * 9.5 * h) - 1.0;
            assert!(error.abs() < 0.01, "pressure off by {error}");
        }
        assert!((top - 9.75 * h).abs() < 0.2 * h, "{top} m");
    }
}

/// A slug falls in a channel of 96 cells, where the forces of its flow are a thousandth of its velocities in the solver's units: as with
/// the tolerance a ten-thousandth.
#[test]
fn a_slug_falls_in_a_wide_channel() {
    let (h, n) = (0.05e-3, [96, 48]);
    let [width, far] = [n[0] as f64 * h, 1.0];
    let power = |tolerance| {
        let mut scene = plain::scene(h, [n[0] + 4, 96, 1]);
        scene.boundary[1] = Boundary::Open;
        let wall = |name, from, to| {
            let block = VoxelBlock::solid_box([from, -far, -far], [to, far, far]);
            plain::body(name, vec![block], Motion::Fixed)
        };
        let low = 2.0 * h;
        scene.bodies = vec![wall("left", -far, low), wall("right", low + width, far)];
        scene.points = plain::fill(
            [low, 24.0 * h, 0.0],
            [0.5 * h, 0.5 * h, h],
            [2 * n[0], 2 * n[1], 1],
        );
        scene.liquid.viscosity = Viscosity::Newtonian(Newtonian(10.0));
        scene.gravity[1] = -9.81;
        let settings = Settings {
            tolerance,
            ..Settings::default()
        };
        let mut scheme = Implicit::new(scene, settings).unwrap();
        for _ in 0..3 {
            let limit = StepLimit {
                time_s: 1e-3,
                travel_m: f64::INFINITY,
            };
            assert_eq!(scheme.advance(limit).unwrap().dt_s, 1e-3);
        }
        scheme.diagnostics().viscous_power
    };
    let [usual, tight] = [1e-3, 1e-7].map(power);
    let error = usual / tight - 1.0;
    println!("viscous power {usual:.3e} W, {error:+.1e}");
    assert!(error.abs() < 0.01, "{error}");
}

/// A drop of thick liquid far from walls falls freely: what its weight does in a step is not too little to count.
#[test]
fn a_thick_drop_falls() {
    let h = 0.05e-3;
    let mut scene = plain::scene(h, [40, 60, 1]);
    scene.boundary = [Boundary::Open; 3];
    scene.points = plain::fill(
        [14.0 * h, 40.0 * h, 0.0],
        [0.5 * h, 0.5 * h, h],
        [24, 24, 1],
    );
    scene.liquid.viscosity = Viscosity::Newtonian(Newtonian(1e3));
    scene.gravity[1] = -9.81;
    let mut scheme = Implicit::new(scene, Settings::default()).unwrap();
    let end = 8e-3;
    march::until(&mut scheme, end, |_, _| ());
    let error = scheme.diagnostics().max_speed / (9.81 * end) - 1.0;
    println!("speed of free fall {error:+.1e}");
    assert!(error.abs() < 0.03, "{error}");
}

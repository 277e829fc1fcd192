//! Liquid that thins along a channel, and liquid that flies on.

#![allow(clippy::print_stdout, reason = "prints for developers")]

#[path = "common/plain.rs"]
mod plain;

use implicit::{Implicit, Settings};
use physics::{
    Boundary, Law, LiquidState, Motion, Scene, Scheme, StepLimit, Viscosity, VoxelBlock, WallLaw,
};

/// Width of the channel, m.
const H: f64 = 17.4e-6;
/// Stress at its walls, Pa.
const STRESS: f64 = 1.3e5;
/// Of a liquid of eta = K rate^(n - 1).
const CONSISTENCY: f64 = 411.0;
const INDEX: f64 = 0.5;

fn steps(scene: &Scene, count: usize) -> LiquidState {
    let settings = Settings {
        tolerance: 1e-6,
        ..Settings::default()
    };
    let mut scheme = Implicit::new(scene, settings).unwrap();
    for _ in 0..count {
        let limit = StepLimit {
            time_s: 1e-5,
            travel_m: f64::INFINITY,
        };
        scheme.advance(limit).unwrap();
    }
    assert_eq!(scheme.objection(), None);
    scheme.liquid()
}

/// Mean velocity over that of the profile `exact` at the heights (m) of the points.
fn mean_against(liquid: &LiquidState, exact: impl Fn(f64) -> f64) -> f64 {
    let points = liquid.velocity.iter().zip(&liquid.position);
    let (found, right) = points.fold((0.0, 0.0), |(found, right), (v, x)| {
        (found + f64::from(v[0]), right + exact(f64::from(x[1])))
    });
    found / right
}

/// A channel of `n` cells along x, walls half a cell thick where they are off the faces of cells.
fn thinning(n: usize, off: bool) -> f64 {
    let h = H / n as f64;
    let low = if off { 1.5 * h } else { h };
    let end = (n + 3) as f64 * h;
    let mut scene = plain::scene(h, [4, n + 3, 1]);
    let slab = |from: f64, to: f64| VoxelBlock::solid_box([0.0, from, 0.0], [4.0 * h, to, h]);
    let walls = vec![slab(0.0, low), slab(low + H, end)];
    scene.bodies = vec![plain::body("wall", walls, Motion::Fixed)];
    scene.points = plain::fill([0.0, low, 0.0], [0.5 * h, 0.5 * h, h], [8, 2 * n, 1]);
    scene.boundary[0] = Boundary::Periodic;
    // Next to no inertia.
    scene.liquid.density = 1.2;
    scene.gravity = [2.0 * STRESS / H / 1.2, 0.0, 0.0];
    scene.liquid.viscosity = Viscosity::Law(Law::Power {
        k: CONSISTENCY,
        n: INDEX,
        rates: [1e2, 1e9],
    });
    let rate = (STRESS / CONSISTENCY).powf(1.0 / INDEX);
    let fastest = INDEX / (INDEX + 1.0) * 0.5 * H * rate;
    let exact = |y: f64| {
        let from_middle = (2.0 * (y - low) / H - 1.0).abs();
        fastest * (1.0 - from_middle.powf(1.0 / INDEX + 1.0))
    };
    let error = mean_against(&steps(&scene, 4), exact) - 1.0;
    println!(
        "channel of {n} cells, liquid of index {INDEX}, walls off {off}: {:+.2} %",
        100.0 * error
    );
    error
}

#[test]
fn liquid_that_thins_flows_as_the_closed_form_says() {
    for n in [6, 12, 24] {
        for off in [false, true] {
            assert!(thinning(n, off).abs() < 2e-3);
        }
    }
}

/// Liquid that nothing touches goes on as it came, but for the friction by which all liquid has a velocity.
#[test]
fn liquid_that_nothing_holds_keeps_its_velocity() {
    let h = 1e-6;
    let mut scene = plain::scene(h, [8, 8, 1]);
    scene.points = plain::fill([0.0, 2.0 * h, 0.0], [0.5 * h, 0.5 * h, h], [16, 6, 1]);
    scene.points.velocity.fill([0.25, 0.0, 0.0]);
    scene.boundary[0] = Boundary::Periodic;
    scene.wall = WallLaw::Frictionless;
    for v in steps(&scene, 3).velocity {
        assert!(
            (f64::from(v[0]) - 0.25).abs() < 5e-4 && v[1].abs() < 1e-5,
            "{v:?}"
        );
    }
}

/// Liquid between walls that all move at one velocity along themselves.
#[test]
fn liquid_that_goes_with_its_walls_goes_on_with_them() {
    let h = 1e-6;
    for low in [2.0, 2.5] {
        let mut scene = plain::scene(h, [8, 12, 1]);
        let wall = |name: &str, from: f64, to: f64| {
            let block = VoxelBlock::solid_box([-1e-4, from * h, 0.0], [1e-4, to * h, h]);
            plain::body(name, vec![block], Motion::Constant([0.5, 0.0, 0.0]))
        };
        scene.bodies = vec![wall("low", 0.0, low), wall("high", low + 6.0, 12.0)];
        scene.points = plain::fill([0.0, low * h, 0.0], [0.5 * h, 0.5 * h, h], [16, 12, 1]);
        scene.points.velocity.fill([0.5, 0.0, 0.0]);
        scene.boundary[0] = Boundary::Periodic;
        for v in steps(&scene, 3).velocity {
            assert!(
                (f64::from(v[0]) - 0.5).abs() < 1e-6 && v[1].abs() < 1e-6,
                "{low} {v:?}"
            );
        }
    }
}

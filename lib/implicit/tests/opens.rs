//! A press programme whose bodies meet, and one whose clamp gives way.

#![allow(clippy::print_stdout, reason = "prints for developers")]

#[path = "common/plain.rs"]
mod plain;

use implicit::{Implicit, Settings};
use physics::{Clamp, Motion, Press, PressStage, Scene, Scheme, StepLimit, Stop, VoxelBlock};

const CELL: f64 = 1e-6;

/// Liquid as wide as `width` cells between two plates `gap` cells apart, the upper with a lumen above all of it that is as wide
/// as `lumen`, held at `pressure` for 10 ms and let go in two stages of 1 ms.
fn scene(gap: f64, [width, lumen]: [usize; 2], pressure: f64) -> Scene {
    let (low, high, top) = (2.0 * CELL, (2.0 + gap) * CELL, 20.0 * CELL);
    let mut scene = plain::scene(CELL, [16, 18, 1]);
    let plate = |from: usize, low: f64, high: f64| {
        VoxelBlock::solid_box([from as f64 * CELL, low, 0.0], [16.0 * CELL, high, CELL])
    };
    scene.bodies = vec![
        plain::body("below", vec![plate(0, 0.0, low)], Motion::Fixed),
        plain::body("above", vec![plate(lumen, high, top)], Motion::Clamped),
    ];
    scene.points = plain::fill(
        [0.0, low, 0.0],
        [0.5 * CELL, 0.5 * CELL * gap / gap.ceil(), 0.5 * CELL],
        [2 * width, 2 * gap.ceil() as usize, 2],
    );
    (scene.bottom, scene.top) = (Some(0), Some(1));
    scene.stop = Stop::Closed {
        travel_m: gap * CELL,
    };
    scene.clamp = Some(Clamp {
        closing_speed: 1e-3,
        max_pressure: Some(pressure),
        pid: None,
    });
    let stage = |kind, pressure, time_s| PressStage {
        kind,
        speed: 1e-3,
        pressure: Some(pressure),
        time_s,
        travel_m: None,
        contact: false,
        slower: None,
    };
    scene.programme = vec![
        stage(Press::Hold, pressure, 1e-2),
        stage(Press::Release, 0.0, 1e-3),
        stage(Press::Release, 0.0, 1e-3),
    ];
    scene
}

/// The gap at its narrowest and at the end, cells, and the liquid at the end over that at the start, both without their
/// pressure.
fn pressed(scene: &Scene, gap: f64) -> [f64; 3] {
    let at_rest = |scheme: &Implicit| -> f64 {
        let liquid = scheme.liquid();
        (liquid.volume.iter().zip(&liquid.pressure))
            .map(|(&v, &p)| f64::from(v) / (1.0 + scene.liquid.tait.volume_change(f64::from(p))))
            .sum()
    };
    let mut scheme = Implicit::new(scene, Settings::default()).unwrap();
    let start = at_rest(&scheme);
    let (mut now, mut least) = (gap, gap);
    let limit = StepLimit {
        time_s: 1.0,
        travel_m: f64::INFINITY,
    };
    while !scheme.programme().unwrap().is_over() {
        now = gap - scheme.advance(limit).unwrap().travel_m / CELL;
        least = least.min(now);
    }
    let found = [least, now, at_rest(&scheme) / start];
    println!(
        "gap of {gap} cells: {:.4} and {:.4} cells, volume {:.8}",
        found[0], found[1], found[2]
    );
    found
}

/// Liquid that is closed in gives way by a hundredth of its volume and comes back, through rows of cells that the gap had lost.
#[test]
fn a_gap_that_opens_again_has_its_rows_and_its_liquid() {
    let gap = 9.05;
    let mut scene = scene(gap, [16, 0], 1e5);
    scene.liquid.tait.bulk_modulus = 1e7;
    let exact = gap * (1.0 + scene.liquid.tait.volume_change(1e5));
    let [least, last, volume] = pressed(&scene, gap);
    assert!((least / exact - 1.0).abs() < 1e-3 && (last / gap - 1.0).abs() < 1e-3);
    assert!((volume - 1.0).abs() < 1e-6);
}

/// Stages go on after the bodies have met.
#[test]
fn a_programme_goes_on_after_its_bodies_have_met() {
    let gap = 0.8;
    let [least, last, volume] = pressed(&scene(gap, [8, 8], 1e6), gap);
    assert!(least.abs() < 1e-9 && last.abs() < 0.02);
    assert!((volume - 1.0).abs() < 1e-6);
}

//! Press programmes whose bodies meet, and whose clamp retreats.

use physics::{Boundary, Motion, Press, Scene, Scheme, Stop};

use crate::plain;
use crate::runs::{advance, at_rest, block, clamp, plainly, press, stage, until};

const CELL: f64 = 1e-6;

/// Liquid as wide as `width` cells between two plates `gap` cells apart, the upper with a lumen above all of it that is as wide
/// as `lumen`, held at `pressure` for 10 ms and let go in two stages of 1 ms.
fn scene(gap: f64, [width, lumen]: [usize; 2], pressure: f64) -> Scene {
    let mut scene = plain::scene(CELL, [16, 18, 1]);
    let plates = [
        block(CELL, [0.0, 0.0], [16.0, 2.0]),
        block(CELL, [lumen as f64, 2.0 + gap], [16.0, 20.0]),
    ];
    let plates = plates.map(|plate| vec![plate]);
    press(&mut scene, ["below", "above"], plates, Motion::Clamped);
    scene.points = plain::fill(
        [0.0, 2.0 * CELL, 0.0],
        [0.5 * CELL, 0.5 * CELL * gap / gap.ceil(), 0.5 * CELL],
        [2 * width, 2 * gap.ceil() as usize, 2],
    );
    scene.stop = Stop::Closed {
        travel_m: gap * CELL,
    };
    scene.clamp = clamp(1e-3, pressure);
    let stages = [
        (Press::Hold, pressure, 1.0),
        (Press::Release, 0.0, 1e-3),
        (Press::Release, 0.0, 1e-3),
    ];
    scene.programme = stages
        .map(|(kind, pressure, time_s)| stage(kind, 1e-3, Some(pressure), time_s))
        .to_vec();
    scene
}

/// The gap at its narrowest and at the end, cells, and the liquid at the end over that at the start, both without their
/// pressure.
fn pressed(scene: &Scene, gap: f64) -> [f64; 3] {
    let mut scheme = plainly(scene);
    let start = at_rest(scene, &scheme.liquid());
    let (mut now, mut least) = (gap, gap);
    while !scheme.programme().unwrap().is_over() {
        now = gap - advance(&mut scheme, 1.0).travel_m / CELL;
        least = least.min(now);
    }
    let volume = at_rest(scene, &scheme.liquid()) / start;
    println!("gap of {gap} cells: {least:.4} and {now:.4} cells, volume {volume:.8}");
    [least, now, volume]
}

/// Enclosed liquid is compressed by a hundredth of its volume and expands again, through gap rows that had been removed.
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

/// The stages go on after the bodies have met.
#[test]
fn a_programme_goes_on_after_its_bodies_have_met() {
    let gap = 0.8;
    let [least, last, volume] = pressed(&scene(gap, [8, 8], 1e6), gap);
    assert!(least.abs() < 1e-9 && last.abs() < 0.02);
    assert!((volume - 1.0).abs() < 1e-6);
}

/// The step that closes the gap may end it by a hundredth of a cell early, and the time go on for a fiftieth more.
#[test]
fn bodies_that_meet_at_the_end_of_the_time_may() {
    for beyond in [0.0, 0.018] {
        meets(beyond);
    }
}

fn meets(beyond: f64) {
    let gap = 4.0;
    let mut scene = scene(gap, [8, 8], 1e6);
    scene.programme.clear();
    scene.clamp = None;
    let speed = 1e-8;
    scene.bodies[1].motion = Motion::Constant([0.0, -speed, 0.0]);
    let end = (gap + beyond) * CELL / speed;
    scene.stop = Stop::Time(end);
    let (mut travel, mut steps) = (0.0, 0);
    until(&mut plainly(&scene), end, |report, time| {
        println!("{time:.5e} s: {:.4} cells", report.travel_m / CELL);
        (travel, steps) = (report.travel_m, steps + 1);
    });
    assert!((travel / CELL - gap).abs() < 1e-9 && steps > 4);
}

/// No gap row is left where the bodies meet: its liquid would have no velocity.
#[test]
fn liquid_of_a_gap_that_has_closed_has_velocities() {
    let gap = 0.8;
    let mut scene = scene(gap, [8, 8], 1e6);
    scene.programme.clear();
    let mut scheme = plainly(&scene);
    let mut left = gap;
    while left > 1e-9 {
        left = gap - advance(&mut scheme, 1.0).travel_m / CELL;
    }
    let liquid = scheme.liquid();
    assert!((liquid.velocity.as_flattened().iter()).all(|v| v.is_finite()));
    let low = |at: &[f32; 3]| f64::from(at[1]) < 2.0 * CELL;
    assert!(!liquid.position.is_empty() && !liquid.position.iter().any(low));
}

/// Outflow is counted in points of the scene, of which a cell of one voxel has eight here.
#[test]
fn liquid_that_leaves_counts_in_points() {
    let mut scene = scene(4.0, [16, 0], 1e9);
    scene.programme.clear();
    scene.boundary[0] = Boundary::Open;
    let points = scene.points.position.len() as f64;
    let mut scheme = plainly(&scene);
    let start = at_rest(&scene, &scheme.liquid());
    let report = (0..6).map(|_| advance(&mut scheme, 1e-3)).last().unwrap();
    let left = 1.0 - at_rest(&scene, &scheme.liquid()) / start;
    println!(
        "{left:.4} of the liquid left, {} of {points} points",
        report.lost
    );
    assert!(left > 0.1 && (report.lost as f64 / points / left - 1.0).abs() < 0.01);
}

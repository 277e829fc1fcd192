//! Enclosed air: pockets that split and merge, a clamp on air. Boyle's law: tests/verification.

use implicit::Implicit;
use physics::{Motion, Press, PressStage, Scene, Scheme, Stop, VoxelBlock};

use crate::plain;
use crate::runs::{H, advance, block, clamp, forged, press, stage, with};

/// Absolute pressure outside, Pa.
const OUTSIDE: f64 = 1e5;

fn begun(scene: &Scene) -> Implicit {
    with(scene, |settings| settings.air_pressure = Some(OUTSIDE))
}

/// A slit of six cells that is closed below, four widths of air in it under one and a half of liquid, and a piston.
fn slit(piston: Motion) -> Scene {
    let h = H / 6.0;
    let mut scene = plain::scene(h, [5, 37, 1]);
    scene.points = plain::fill([0.0, 26.0 * h, 0.0], [0.5 * h, 0.5 * h, h], [6, 18, 1]);
    let walls = [[0.0, 0.0, 5.0, 2.0], [3.0, 0.0, 5.0, 600.0]];
    let walls = walls.map(|[x, y, to_x, to_y]| block(h, [x, y], [to_x, to_y]));
    let plunger = vec![block(h, [0.0, 35.0], [3.0, 600.0])];
    press(
        &mut scene,
        ["wall", "piston"],
        [walls.into(), plunger],
        piston,
    );
    scene
}

/// Air of all pores by the arrays of a checkpoint, in its unit.
fn air(scheme: &Implicit) -> f64 {
    scheme.save().f64s("air").unwrap().iter().sum()
}

/// Liquid that falls through air in a closed box splits and merges pockets; the air is conserved, across a restart too.
#[test]
fn pockets_that_part_and_meet_keep_their_air() {
    let h = 1e-6;
    let mut scene = plain::scene(h, [12, 24, 1]);
    let posts = [[2.0, 8.0], [7.0, 6.0], [4.0, 12.0]].map(|[x, y]| {
        VoxelBlock::solid_box([x * h, y * h, 0.0], [(x + 3.0) * h, (y + 2.0) * h, h])
    });
    scene.bodies = vec![plain::body("posts", posts.to_vec(), Motion::Fixed)];
    scene.points = plain::fill([0.0, 16.0 * h, 0.0], [0.5 * h, 0.5 * h, h], [24, 12, 1]);
    scene.gravity[1] = -1e6;
    let mut whole = begun(&scene);
    let first = air(&whole);
    let mut most = 0;
    for _ in 0..40 {
        advance(&mut whole, 1e-3);
        most = most.max(whole.counts()[0].1);
    }
    let mut resumed = begun(&scene);
    resumed.restore(&whole.save()).unwrap();
    for _ in 0..60 {
        advance(&mut whole, 1e-3);
        advance(&mut resumed, 1e-3);
        most = most.max(whole.counts()[0].1);
    }
    assert!(whole.save() == resumed.save());
    let kept = air(&whole) / first - 1.0;
    println!(
        "up to {most} pockets, air {kept:+.1e}, {:?}",
        whole.counts()
    );
    assert!(most > 1 && kept.abs() < 1e-12);
    let negative = forged(&whole, "air", |air| air.fill(-1.0));
    let said = resumed.restore(&negative).unwrap_err();
    assert!(said.contains("air"), "{said}");
}

/// The slit under a clamp that raises the pressure of its air by `rise` (Pa) in `time_s` (s), and then as the `next` stages say.
fn pressed_slit(rise: f64, time_s: f64, next: &[PressStage]) -> (Scene, f64) {
    let mut scene = slit(Motion::Clamped);
    let part = scene.grid.area_m2() / (0.5 * H * H / 6.0);
    scene.clamp = clamp(1e-2, rise / part);
    scene.stop = Stop::Closed { travel_m: 4.0 * H };
    scene.programme = vec![stage(Press::Ramp, 1e-2, Some(rise / part), time_s)];
    scene.programme.extend_from_slice(next);
    (scene, part)
}

/// Compressed air lifts a clamp that releases it, at once, by twelve cells or little more than one, back to its start.
#[test]
fn air_that_was_pressed_lifts_a_clamp_that_lets_go() {
    for rise in [1.0, 0.06] {
        let release = stage(Press::Release, 1e-2, Some(0.0), 10.0);
        let (scene, _) = pressed_slit(rise * OUTSIDE, 10.0, &[release]);
        let mut scheme = begun(&scene);
        let (mut travel, mut most) = (0.0, 0.0_f64);
        while !scheme.programme().unwrap().is_over() {
            travel = advance(&mut scheme, 1.0).travel_m / H;
            most = most.max(travel);
        }
        println!("clamp on air: {most:.3} widths, after its release {travel:+.4}");
        let exact = 4.0 * rise / (1.0 + rise);
        assert!((most - exact).abs() < 0.02 && travel.abs() < 0.01);
    }
}

/// A pressure ramp against air under liquid of low viscosity: each step ends at the set pressure of its end, so a short step
/// need not catch up with the rise of a long one before it.
#[test]
fn a_clamp_keeps_up_with_air_in_steps_of_any_length() {
    let (rise, stage_s) = (1e5, 10.0);
    let (scene, part) = pressed_slit(rise, stage_s, &[]);
    let mut scheme = begun(&scene);
    let (mut travel, mut moved, mut times, mut off) = ([0.0; 2], [0.0; 2], [0.0; 2], 0.0_f64);
    let (mut before, first) = (0.0, air(&scheme));
    for step in 0..20 {
        let report = advance(&mut scheme, [0.4, 0.04][step % 2]);
        times[step % 2] += report.dt_s;
        if step > 5 {
            travel[step % 2] += report.travel_m - before;
            moved[step % 2] += report.dt_s;
        }
        before = report.travel_m;
        let set = rise * times.iter().sum::<f64>() / stage_s;
        off = off.max((report.pressure_top * part / set - 1.0).abs());
    }
    let [long, short] = [0, 1].map(|kind| travel[kind] / moved[kind]);
    let (ratio, kept) = (short / long, air(&scheme) / first - 1.0);
    println!(
        "air under a ramp: short steps {ratio:.2} times as fast as long ones, pressure off by {off:.1e}, air {kept:+.1e}"
    );
    assert!(ratio < 2.2 && off < 1e-2 && kept.abs() < 1e-12);
}

/// A run is unsound if the gas law is missed in more than a tenth of its steps.
#[test]
fn air_that_is_often_astray_is_objected_to() {
    let mut scheme = begun(&slit(Motion::Constant([0.0, -1e-3, 0.0])));
    for _ in 0..10 {
        advance(&mut scheme, 1e-4);
    }
    let mut objection = |astray: f64| {
        let saved = forged(&scheme, "air_counts", |counts| {
            *counts = vec![1.0, 0.0, astray];
        });
        scheme.restore(&saved).unwrap();
        scheme.objection()
    };
    assert_eq!(objection(1.0), None);
    let said = objection(2.0).unwrap_or_default();
    assert!(said.starts_with("in 2 of 10 steps"), "{said}");
}

//! Air that liquid closes off: Boyle's law, pockets that part and meet, a bond with air.

use implicit::Implicit;
use physics::{Motion, Press, PressStage, Scene, Scheme, Stop, VoxelBlock};

use crate::plain;
use crate::runs::{ETA, H, advance, clamp, forged, stage, until, with};

/// Absolute pressure outside, Pa.
const OUTSIDE: f64 = 1e5;

fn begun(scene: &Scene, leak_time: f64) -> Implicit {
    with(scene, |settings| {
        (settings.air_pressure, settings.air_leak_time) = (Some(OUTSIDE), leak_time);
    })
}

/// A slit of `n` cells that is closed below, four widths of air in it under one and a half of liquid, which a piston presses down
/// at `speed` (m/s).
fn slit(n: usize, speed: f64) -> Scene {
    let h = H / n as f64;
    let m = |cells: usize| cells as f64 * h;
    let block = |low: [usize; 2], high: [usize; 2]| {
        VoxelBlock::solid_box([m(low[0]), m(low[1]), 0.0], [m(high[0]), m(high[1]), h])
    };
    let [floor, surface, top] = [2, 4 * n + 2, 4 * n + 2 + 3 * n / 2];
    let cells = [n / 2 + 2, top + 2, 1];
    let mut scene = plain::scene(h, cells);
    let liquid = [n, 3 * n, 1];
    scene.points = plain::fill([0.0, m(surface), 0.0], [0.5 * h, 0.5 * h, h], liquid);
    let walls = vec![
        block([0, 0], [n / 2 + 2, floor]),
        block([n / 2, floor], [n / 2 + 2, 99 * n]),
    ];
    let piston = vec![block([0, top], [n / 2, 99 * n])];
    scene.bodies = vec![
        plain::body("wall", walls, Motion::Fixed),
        plain::body("piston", piston, Motion::Constant([0.0, -speed, 0.0])),
    ];
    (scene.bottom, scene.top) = (Some(0), Some(1));
    scene
}

/// Air of all pores by the arrays of a checkpoint, in its unit.
fn air(scheme: &Implicit) -> f64 {
    scheme.save().f64s("air").unwrap().iter().sum()
}

/// Presses the air to a quarter; largest and mean error of its pressure, over what it is then by Boyle, and the last report.
fn pressed(n: usize, speed: f64, leak_time: f64) -> [f64; 3] {
    let scene = slit(n, speed);
    let part = scene.grid.area_m2() / (0.5 * H * H / n as f64);
    let mut scheme = begun(&scene, leak_time);
    let first = air(&scheme);
    let (mut errors, mut last) = (Vec::new(), 0.0);
    until(&mut scheme, 3.0 * H / speed, |report, time| {
        let boyle = OUTSIDE * (4.0 / (4.0 - time * speed / H) - 1.0);
        // Developed flow behind the front.
        let viscous = 12.0 * ETA * speed * 1.5 / H;
        last = report.pressure_top * part - viscous;
        errors.push((last - boyle) / (boyle + OUTSIDE));
    });
    let worst = errors.iter().fold(0.0, |most: f64, e| most.max(e.abs()));
    let mean = errors.iter().sum::<f64>() / errors.len() as f64;
    let kept = air(&scheme) / first - 1.0;
    println!(
        "{n} cells, {speed} m/s, leak {leak_time} s: absolute pressure {:+.2} % in the mean, {:.2} % at worst, in {} steps, air {kept:+.1e}, {:?}",
        100.0 * mean,
        100.0 * worst,
        errors.len(),
        scheme.counts()
    );
    [worst, kept, last]
}

#[test]
fn air_under_a_piston_has_the_pressure_that_boyle_says() {
    for (n, most) in [(6, 0.03), (12, 0.02)] {
        let [worst, kept, _] = pressed(n, 1e-3, f64::INFINITY);
        assert!(worst < most && kept.abs() < 1e-12);
    }
}

/// Far slower than it leaks, air has an excess of p_0 t_leak dV/dt / V.
#[test]
fn air_that_leaks_gives_way() {
    let (speed, leak) = (1e-3, 1e-3);
    let [_, _, last] = pressed(6, speed, leak);
    let rate = leak * speed / H;
    let exact = OUTSIDE * rate / (1.0 - rate);
    println!("leaking: {last:.0} Pa of {exact:.0}");
    assert!((last / exact - 1.0).abs() < 0.1);
}

/// Liquid that falls through air in a closed box parts and joins pockets; their air stays, also over a stop.
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
    let mut whole = begun(&scene, f64::INFINITY);
    let first = air(&whole);
    let mut most = 0;
    for _ in 0..40 {
        advance(&mut whole, 1e-3);
        most = most.max(whole.counts()[0].1);
    }
    let mut resumed = begun(&scene, f64::INFINITY);
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
    let mut scene = slit(6, 1e-2);
    let part = scene.grid.area_m2() / (0.5 * H * H / 6.0);
    scene.bodies[1].motion = Motion::Clamped;
    scene.clamp = clamp(1e-2, rise / part);
    scene.stop = Stop::Closed { travel_m: 4.0 * H };
    scene.programme = vec![stage(Press::Ramp, 1e-2, Some(rise / part), time_s)];
    scene.programme.extend_from_slice(next);
    (scene, part)
}

/// Air under pressure lifts a clamp that lets go, at once and by twelve cells or little more than one, to where it began.
#[test]
fn air_that_was_pressed_lifts_a_clamp_that_lets_go() {
    for rise in [1.0, 0.06] {
        let release = stage(Press::Release, 1e-2, Some(0.0), 10.0);
        let (scene, _) = pressed_slit(rise * OUTSIDE, 10.0, &[release]);
        let mut scheme = begun(&scene, f64::INFINITY);
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

/// A ramp of pressure against air under liquid that hardly resists: each step ends at the pressure that is set then,
/// and a short step has no rise of the long one before it to catch up.
#[test]
fn a_clamp_keeps_up_with_air_in_steps_of_any_length() {
    let (rise, stage_s) = (1e5, 10.0);
    let (scene, part) = pressed_slit(rise, stage_s, &[]);
    let mut scheme = begun(&scene, f64::INFINITY);
    let (mut travel, mut moved, mut times, mut off) = ([0.0; 2], [0.0; 2], [0.0; 2], 0.0_f64);
    let mut before = 0.0;
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
    let ratio = short / long;
    println!(
        "air under a ramp: short steps {ratio:.2} times as fast as long ones, pressure off by {off:.1e}"
    );
    assert!(ratio < 2.2 && off < 1e-2, "{ratio} {off}");
}

/// A run is objected to where the air is astray in more than a tenth of its steps.
#[test]
fn air_that_is_often_astray_is_objected_to() {
    let mut scheme = begun(&slit(6, 1e-3), f64::INFINITY);
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

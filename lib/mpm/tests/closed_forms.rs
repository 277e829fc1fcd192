//! Flows with a closed form. Errors are printed; the reason of each tolerance is beside it.

mod scenes;

use std::f64::consts::PI;

use mpm::{Explicit, ShapeFunction, VelocityUpdate};
use physics::{Boundary, Motion, Newtonian, Scene, Scheme, Viscosity, WallLaw};
use scenes::{
    CELL, DENSITY, MODULUS, SHAPES, VISCOSITY, combined, fill, pour, run_to, scene, settings, solid,
};

const NU: f64 = VISCOSITY / DENSITY;
const MIRROR: [Boundary; 3] = [Boundary::Symmetry; 3];
const BOTH: [VelocityUpdate; 2] = [VelocityUpdate::Flip, VelocityUpdate::Xpic(5)];

/// The scene between two sides that are open along y and periodic ones.
fn channel(width: usize, height: usize) -> Scene {
    let mut s = scene([width, height, 1], [Boundary::Periodic; 3]);
    s.boundary[1] = Boundary::Open;
    s
}

/// Mean over the points of `f(position in cells, velocity)`.
fn mean(run: &Explicit, f: impl Fn([f64; 3], [f64; 3]) -> f64) -> f64 {
    let liquid = run.liquid();
    let sum: f64 = liquid
        .position
        .iter()
        .zip(&liquid.velocity)
        .map(|(x, v)| f(x.map(|x| f64::from(x) / CELL), v.map(f64::from)))
        .sum();
    sum / liquid.position.len() as f64
}

#[test]
fn standing_sound_wave() {
    let n = 32.0;
    let period = 2.0 * n * CELL / (MODULUS / DENSITY).sqrt();
    for (shape, update) in combined(&[BOTH[0], BOTH[1], VelocityUpdate::Apic]) {
        let mut s = scene([32, 4, 1], MIRROR);
        s.liquid.viscosity = Viscosity::Newtonian(Newtonian(1e-3));
        fill(&mut s, [0.0; 3], [32.0, 4.0, 1.0], |x| {
            [(PI * x[0] / n).sin(), 0.0, 0.0]
        });
        let mut run = Explicit::new(&s, &settings(shape, update, 0.3)).unwrap();
        let mut crossings = Vec::new();
        let mut last = (0.0, 1.0);
        run_to(&mut run, 1.8 * period, |run, _, t| {
            let a = mean(run, |x, v| v[0] * (PI * x[0] / n).sin());
            if a * last.1 < 0.0 {
                crossings.push(last.0 + (t - last.0) * last.1 / (last.1 - a));
            }
            last = (t, a);
        });
        // Quarter period, then every half.
        let measured = (crossings[2] - crossings[0]) / period;
        println!(
            "{shape:?} {update:?}: sound speed {:.4} of sqrt(K/rho)",
            1.0 / measured
        );
        // A wave of 64 cells: the dispersion of lumped linear elements is (k h)^2/24 = 0.04 %.
        assert!((measured - 1.0).abs() < 0.01);
    }
}

#[test]
fn taylor_green_decay() {
    let n = 24.0;
    let k = 2.0 * PI / n;
    let rate = 4.0 * NU * (k / CELL).powi(2);
    for (shape, update) in combined(&[BOTH[0], BOTH[1], VelocityUpdate::Apic]) {
        let mut s = scene([24, 24, 1], [Boundary::Periodic; 3]);
        fill(&mut s, [0.0; 3], [24.0, 24.0, 1.0], |x| {
            let (x, y) = (k * x[0], k * x[1]);
            [x.sin() * y.cos(), -x.cos() * y.sin(), 0.0]
        });
        let mut run = Explicit::new(&s, &settings(shape, update, 0.5)).unwrap();
        let e0 = run.diagnostics().kinetic_energy;
        let time = 1.0 / rate;
        run_to(&mut run, time, |_, _, _| {});
        let measured = (e0 / run.diagnostics().kinetic_energy).ln() / (rate * time);
        println!("{shape:?} {update:?}: decay rate {measured:.4} of 4 nu k^2");
        // Second order in k cell = 0.26: the weights smooth by (k cell)^2/12 = 0.6 % (hat) to
        // 1.7 % (spline) per transfer, of which the rate takes two or three; APIC damps too.
        assert!((measured - 1.0).abs() < 0.10);
    }
}

#[test]
fn hydrostatic_column() {
    let (height, g) = (16.0, 2e7);
    let head = DENSITY * g * CELL;
    let c = (MODULUS / DENSITY).sqrt();
    for update in BOTH {
        let mut s = scene([4, 24, 1], MIRROR);
        s.boundary[1] = Boundary::Open;
        s.gravity = [0.0, -g, 0.0];
        s.wall = WallLaw::Frictionless;
        s.bodies = vec![solid("floor", [0.0; 3], [4.0, 4.0, 1.0], Motion::Fixed)];
        s.bottom = Some(0);
        pour(&mut s, [0.0, 4.0, 0.0], [4.0, 4.0 + height, 1.0]);
        let mut run = Explicit::new(&s, &settings(ShapeFunction::Gimp, update, 0.4)).unwrap();
        // The column rings at its lowest mode: averages over four periods of 4 H / c.
        let end = 4.0 * 4.0 * height * CELL / c;
        let rows = 2 * height as usize;
        let (mut pressure, mut floor) = (vec![0.0; rows], 0.0);
        run_to(&mut run, end, |run, report, _| {
            floor += report.pressure_bottom * report.dt_s / end;
            let liquid = run.liquid();
            for (i, p) in liquid.pressure.iter().enumerate() {
                pressure[i / 8] += f64::from(*p) * report.dt_s / (8.0 * end);
            }
        });
        let weight = head * height;
        let depth = |row: usize| height - 0.5 * (row as f64 + 0.5);
        let errors = pressure
            .iter()
            .enumerate()
            .map(|(row, p)| p - head * depth(row));
        let worst = errors.fold(0.0_f64, |most, e| most.max(e.abs())) / weight;
        println!(
            "{update:?}: floor carries {:.4} of the weight, pressure off by at most {worst:.4} of it",
            floor / weight
        );
        // The ringing fades by a few per cent in four periods, so its mean is not quite zero;
        // the top row, half a cell thick, adds 1/64.
        assert!((floor / weight - 1.0).abs() < 0.03 && worst < 0.04);
    }
}

/// A channel of `width` cells along x between sticking walls, the lower at `offset` cells above
/// a node, driven by a body force; steady flux over g H^3 / (12 nu).
fn channel_flux(shape: ShapeFunction, update: VelocityUpdate, width: f64, offset: f64) -> f64 {
    let g = 1e7;
    let (low, high) = (4.0 + offset, 4.0 + offset + width);
    let cells = 9 + width as usize;
    let mut s = channel(4, cells);
    s.gravity = [g, 0.0, 0.0];
    let (top, down) = (cells as f64, Motion::Constant([0.0, -0.1, 0.0]));
    s.bodies = vec![
        solid("lower", [0.0; 3], [4.0, low, 1.0], Motion::Fixed),
        // Contact acts only where the liquid presses on the wall: 1e-3 of the width is enough.
        solid("upper", [0.0, high, 0.0], [4.0, top, 1.0], down),
    ];
    pour(&mut s, [0.0, low, 0.0], [4.0, high, 1.0]);
    let mut run = Explicit::new(&s, &settings(shape, update, 0.5)).unwrap();
    let h = width * CELL;
    let settled = 8.0 * h * h / (PI * PI * NU);
    run_to(&mut run, settled, |_, _, _| {});
    mean(&run, |_, v| v[0]) / (g * h * h / (12.0 * NU))
}

#[test]
fn plane_poiseuille() {
    for shape in SHAPES {
        for update in BOTH {
            for offset in [0.0, 0.5] {
                let flux = channel_flux(shape, update, 6.0, offset);
                println!("{shape:?} {update:?}: walls {offset} cell off the nodes: flux {flux:.3}");
                // With the walls on nodes every shape is right but for the blur of the wall
                // layer; off the nodes the paper's contact is not, and that is reported only.
                if offset == 0.0 && shape != ShapeFunction::Bspline2 {
                    assert!((flux - 1.0).abs() < 0.06);
                }
            }
        }
    }
}

#[test]
fn couette_with_partial_slip() {
    let (width, speed, length) = (8.0, 1.0, 1.0);
    let (high, drag) = (4.0 + width, Motion::Constant([speed, -0.01, 0.0]));
    for update in BOTH {
        let mut s = channel(4, 16);
        s.wall = WallLaw::PartialSlip {
            influence_length_m: length * CELL,
        };
        // Contact acts only where the liquid presses on the wall: the upper one comes down
        // slowly, by 1e-4 of the gap.
        s.bodies = vec![
            solid("lower", [0.0; 3], [4.0, 4.0, 1.0], Motion::Fixed),
            solid("upper", [0.0, high, 0.0], [4.0, 16.0, 1.0], drag),
        ];
        pour(&mut s, [0.0, 4.0, 0.0], [4.0, high, 1.0]);
        let mut run = Explicit::new(&s, &settings(ShapeFunction::Gimp, update, 0.5)).unwrap();
        let h = width * CELL;
        run_to(&mut run, 12.0 * h * h / (PI * PI * NU), |_, _, _| {});
        // Slope of v_x(y) over the middle half by least squares.
        let inside = |x: [f64; 3]| f64::from((x[1] - 8.0).abs() < 0.25 * width);
        let n = mean(&run, |x, _| inside(x));
        let v0 = mean(&run, |x, v| inside(x) * v[0]) / n;
        let xx = mean(&run, |x, _| inside(x) * (x[1] - 8.0).powi(2));
        let slope = mean(&run, |x, v| inside(x) * (x[1] - 8.0) * (v[0] - v0)) / xx;
        let exact = speed / (width + 2.0 * length);
        println!(
            "{update:?}: shear rate {:.3} of U/(H + 2/k), mean velocity {v0:.3} U",
            slope / exact
        );
        assert!((slope / exact - 1.0).abs() < 0.1);
    }
}

/// The film of paper Fig. 4 with gravity 400 times the paper's for a 400th of the time: rms error of v_x over
/// v_max, and rms v_y over v_max.
fn film(update: VelocityUpdate, offset: f64) -> (f64, f64) {
    let (depth, angle, boost) = (6.0, 50.0_f64.to_radians(), 400.0);
    let g = 3e5 * boost;
    let floor = 4.0 + offset;
    let mut s = channel(8, 14);
    s.gravity = [g * angle.sin(), -g * angle.cos(), 0.0];
    s.bodies = vec![solid("floor", [0.0; 3], [8.0, floor, 1.0], Motion::Fixed)];
    pour(&mut s, [0.0, floor, 0.0], [8.0, floor + depth, 1.0]);
    let mut run = Explicit::new(&s, &settings(ShapeFunction::Gimp, update, 0.5)).unwrap();
    run_to(&mut run, 0.5e-3 / boost, |_, _, _| {});
    let scale = g * angle.sin() * CELL * CELL / NU;
    let largest = scale * depth * depth / 2.0;
    let exact = |y: f64| scale * y * (depth - y / 2.0);
    let rms = |f: &dyn Fn([f64; 3], [f64; 3]) -> f64| mean(&run, |x, v| f(x, v).powi(2)).sqrt();
    let error = rms(&|x, v| v[0] - exact(x[1] - floor)) / largest;
    let noise = rms(&|_, v| v[1]) / largest;
    (error, noise)
}

#[test]
fn film_on_an_incline() {
    for update in BOTH {
        for offset in [0.0, 0.5] {
            let (error, noise) = film(update, offset);
            println!(
                "{update:?}: floor {offset} cell off the nodes: rms error {:.2} %, v_y noise {:.2} % of v_max",
                100.0 * error,
                100.0 * noise
            );
            // On the nodes linear interpolation between them leaves 0.5 %; off the nodes the
            // paper's contact puts the wall elsewhere, which is reported only.
            if offset == 0.0 {
                let quiet = if update == BOTH[0] { 0.01 } else { 0.001 };
                assert!(error < 0.01 && noise < quiet);
            }
        }
    }
}

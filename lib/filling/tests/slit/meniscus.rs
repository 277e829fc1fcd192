//! What the front's shape on the lattice is worth: the piston's force on liquid behind the meniscus that it has by finite elements.

use std::f64::consts::FRAC_PI_4;

use filling::{Implicit, Settings};
use physics::{Motion, Points, Scene, Scheme, StepLimit, Tait, VoxelBlock};

use crate::{ETA, H, INCOMPRESSIBLE, SPEED, corner, plain, reference, scene};

/// How far the tip is ahead of the contact line from one filled width on, H (`lib/studies/reference`).
const DEPTH: f64 = 0.446;

/// The reservoir and `length` H of the slit filled behind half an ellipse of [`DEPTH`], with `side` points to a cell and direction.
/// The liquid is next to incompressible and without inertia.
fn filled(n: usize, offset: f64, length: f64, side: usize) -> Scene {
    let mut scene = scene(n, [offset, 0.0]);
    let h = H / n as f64;
    let d = h / side as f64;
    let (left, entrance) = ((2.0 + offset) * h, 2.0 * h + 2.0 * H);
    let piston = 2.0 * h + 0.25 * length * H;
    let mut points = Points::default();
    let mut column = |x: f64, from: f64, to: f64| {
        let rows = ((to - from) / d).round().max(1.0);
        let dy = (to - from) / rows;
        for row in 0..rows as usize {
            points
                .position
                .push([x, from + (row as f64 + 0.5) * dy, 0.5 * h]);
            points.velocity.push([0.0; 3]);
            points.volume.push(d * dy * h);
        }
    };
    let across = |i: usize| (i as f64 + 0.5) * d;
    for i in 0..4 * n * side {
        column(left + across(i), piston, entrance);
    }
    // The mean height of half an ellipse is pi/4 of its depth.
    let contact = entrance + (length - FRAC_PI_4 * DEPTH) * H;
    for x in (0..n * side).map(across) {
        let off_middle = 2.0 * x / H - 1.0;
        let height = DEPTH * H * (1.0 - off_middle * off_middle).sqrt();
        column(left + 1.5 * H + x, entrance, contact + height);
    }
    scene.points = points;
    let solid = VoxelBlock::solid_box([left, -99.0 * h, 0.0], [left + 4.0 * H, piston, h]);
    scene.bodies[1] = plain::body("piston", vec![solid], Motion::Constant([0.0, SPEED, 0.0]));
    scene.liquid.density = 1e-3;
    scene.liquid.tait = Tait { bulk_modulus: 1e14 };
    scene
}

/// Error of the force at a filled length, H.
fn error(reference: &[[f64; 2]], n: usize, offset: f64, length: f64, side: usize) -> f64 {
    let scene = filled(n, offset, length, side);
    let face = scene.grid.area_m2() / (4.0 * H * H / n as f64);
    let settings = Settings {
        cfl: 1e-3,
        ..Settings::default()
    };
    let mut scheme = Implicit::new(scene, settings).unwrap();
    let limit = StepLimit {
        time_s: 1.0,
        travel_m: f64::INFINITY,
    };
    let pressure = scheme.advance(limit).unwrap().pressure_bottom;
    let found = face * pressure / (48.0 * ETA * SPEED / H);
    let next = (reference.iter().position(|r| r[0] > length)).unwrap();
    let [[l0, f0], [l1, f1]] = [reference[next - 1], reference[next]];
    found / (f0 + (f1 - f0) * (length - l0) / (l1 - l0) + corner(n)) - 1.0
}

/// The same at 1, 2 and 3 filled widths, mean over four places of the front in its cells.
fn errors(n: usize, offset: f64, side: usize) -> [f64; 3] {
    let reference = reference(INCOMPRESSIBLE);
    [1.0, 2.0, 3.0].map(|length| {
        let places = (0..4).map(|quarter| length + (f64::from(quarter) - 1.5) / (4 * n) as f64);
        places
            .map(|l| error(&reference, n, offset, l, side))
            .sum::<f64>()
            / 4.0
    })
}

/// The air between the liquid and the wall behind the tip is a wedge that ends in nothing: coarse cells take it for liquid that
/// sticks to the wall, and the force is too large the shorter the slit is filled.
#[test]
fn a_meniscus_is_the_flatter_the_coarser_the_cells() {
    let worst = |n: usize, side: usize| {
        let all = [0.0, 0.25, 0.5].map(|offset| errors(n, offset, side));
        println!(
            "{n} cells, {side} points a direction, L = 1, 2, 3 H at offsets 0, 0.25, 0.5: {all:+.4?}"
        );
        (all.as_flattened().iter()).fold(0.0, |w: f64, e| w.max(e.abs()))
    };
    assert!(worst(6, 2) < 0.1);
    assert!(worst(12, 2) < 0.075);
    assert!(worst(24, 4) < 0.035);
}

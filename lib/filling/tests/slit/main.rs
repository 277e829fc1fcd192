//! A piston presses liquid from a reservoir into a slit: pressure against filled length, volume,
//! and no particle in a wall. Run with `--nocapture` to see the errors.

#![allow(clippy::print_stdout, reason = "prints for developers")]

mod constant_pressure;
mod inertia;
#[path = "../common/march.rs"]
mod march;
mod meniscus;
#[path = "../common/plain.rs"]
mod plain;
mod robustness;

use filling::{Implicit, Settings};
use physics::{Motion, RigidBody, Scene, Scheme, VoxelBlock};

/// Width of the slit, m.
const H: f64 = 17.4e-6;
const ETA: f64 = 1.3;
const SPEED: f64 = 0.5;

/// Reservoir 4 H wide and 2 H deep below a slit `n` cells wide, all walls off by `offset`
/// cells; the piston is body 1.
fn scene(n: usize, offset: [f64; 2]) -> Scene {
    let h = H / n as f64;
    let m = |cells: f64| cells * h;
    let w = n as f64;
    let (x0, y0) = (2.0 + offset[0], 2.0);
    let top = y0 + 2.0 * w + offset[1];
    let cells = [4 * n + 6, (9.0 * w) as usize + 6, 1];
    let block = |low: [f64; 2], high: [f64; 2]| {
        VoxelBlock::solid_box([m(low[0]), m(low[1]), 0.0], [m(high[0]), m(high[1]), h])
    };
    let (far, end) = (cells[0] as f64 + 9.0, cells[1] as f64 + 9.0);
    let wood = vec![
        block([-9.0, -9.0], [x0, end]),
        block([x0 + 4.0 * w, -9.0], [far, end]),
        block([x0, top], [x0 + 1.5 * w, end]),
        block([x0 + 2.5 * w, top], [x0 + 4.0 * w, end]),
    ];
    let piston = vec![block([x0, -99.0], [x0 + 4.0 * w, y0])];
    let rows = (2.0 * (top - y0)).round() as usize;
    let dy = (top - y0) / rows as f64;
    let points = plain::fill([m(x0), m(y0), 0.0], [m(0.5), m(dy), h], [8 * n, rows, 1]);
    Scene {
        points,
        bodies: vec![
            plain::body("wood", wood, Motion::Fixed),
            plain::body("piston", piston, Motion::Constant([0.0, SPEED, 0.0])),
        ],
        bottom: Some(1),
        top: Some(0),
        ..plain::scene(h, cells)
    }
}

/// What a filling run showed.
struct Filled {
    /// Filled length over H and piston force over that of lubrication theory for H.
    force: Vec<[f64; 2]>,
    steps: usize,
    iterations: f64,
    volume_error: f64,
    in_walls: usize,
    /// Liquid in the slit over the volume swept by the piston.
    delivered: f64,
}

fn run(n: usize, offset: [f64; 2], settings: Settings, change: impl Fn(&mut Scene)) -> Filled {
    let mut scene = scene(n, offset);
    change(&mut scene);
    let (h, area, bodies) = (H / n as f64, scene.grid.area_m2(), scene.bodies.clone());
    let start = scene.liquid_volume();
    let end = 0.6 * 2.0 * H / SPEED;
    let mut scheme = Implicit::new(scene, settings).unwrap();
    let (mut force, mut iterations) = (Vec::new(), 0);
    march::until(&mut scheme, end, |report, time| {
        iterations += report.iterations;
        let pressure = report.pressure_bottom * area / (4.0 * H * h);
        // The force is that of the middle of the step.
        let filled = 4.0 * SPEED * (time - 0.5 * report.dt_s) / H;
        force.push([filled, pressure / (12.0 * ETA * 4.0 * SPEED / H)]);
    });
    let liquid = scheme.liquid();
    let moved = scheme.displacements();
    // Deeper than the rounding of positions to f32.
    let deep = |x: &[f32; 3], body: &RigidBody, d: &[f64; 3]| {
        let at = |dx: f64, dy: f64| [dx, dy, 0.0].map(|s| s * 1e-4 * h);
        [at(1.0, 0.0), at(-1.0, 0.0), at(0.0, 1.0), at(0.0, -1.0)]
            .iter()
            .all(|s| body.contains(std::array::from_fn(|a| f64::from(x[a]) - d[a] + s[a])))
    };
    let in_walls = (liquid.position.iter())
        .filter(|x| bodies.iter().zip(&moved).any(|(body, d)| deep(x, body, d)))
        .count();
    let entrance = 2.0 * h + 2.0 * H + offset[1] * h;
    let inside: f64 = (liquid.position.iter().zip(&liquid.volume))
        .filter(|(x, _)| f64::from(x[1]) > entrance)
        .map(|(_, &v)| f64::from(v))
        .sum();
    Filled {
        steps: force.len(),
        iterations: f64::from(iterations) / force.len() as f64,
        volume_error: scheme.diagnostics().volume / start - 1.0,
        in_walls,
        delivered: inside / (4.0 * H * h * SPEED * end),
        force,
    }
}

/// Mean force within a quarter H of a filled length.
fn at(force: &[[f64; 2]], length: f64) -> f64 {
    let near: Vec<f64> = (force.iter())
        .filter(|f| (f[0] - length).abs() < 0.25)
        .map(|f| f[1])
        .collect();
    near.iter().sum::<f64>() / near.len() as f64
}

/// What the piston's corners add to the force over that of one filled width where its sides give
/// way over one of `n` cells and not over 1/24 H (Taylor's scraper; lib/studies/reference).
fn corner(n: usize) -> f64 {
    0.0223 * (n as f64 / 24.0).ln()
}

/// Reference: finite elements behind a tracked front, the sides giving way over 1/24 H: filled length and a column of `force`.
fn reference(force: usize) -> Vec<[f64; 2]> {
    include_str!("../../../studies/reference/slit-filling.csv")
        .lines()
        .skip(1)
        .map(|line| {
            let columns: Vec<f64> = line.split(',').map(|c| c.parse().unwrap()).collect();
            [columns[0], columns[force]]
        })
        .collect()
}

/// Columns of it: the force, and that on liquid that is not compressed.
const FORCE: usize = 1;
const INCOMPRESSIBLE: usize = 3;

/// Largest error of the force at one to four filled widths.
fn compare(n: usize, offset: [f64; 2]) -> f64 {
    compare_at(1.0, n, offset)
}

/// The same at a Courant number.
fn compare_at(cfl: f64, n: usize, offset: [f64; 2]) -> f64 {
    let settings = Settings {
        cfl,
        ..Settings::default()
    };
    let filled = run(n, offset, settings, |_| ());
    let reference = reference(FORCE);
    let lengths = [1.0, 2.0, 3.0, 4.0];
    let errors = lengths.map(|l| at(&filled.force, l) / (at(&reference, l) + corner(n)) - 1.0);
    let mean = errors.iter().sum::<f64>() / 4.0;
    println!(
        "slit of {n} cells, offset {offset:?}, Courant number {cfl}: force {:+.3} at L = 1..4 H {:+.3?}, {} steps, {:.1} iterations, volume {:+.4}, delivered {:.4}, in walls {}",
        mean,
        errors,
        filled.steps,
        filled.iterations,
        filled.volume_error,
        filled.delivered,
        filled.in_walls
    );
    assert_eq!(filled.in_walls, 0);
    // 14 steps a cell: no step is shorter than it must be.
    assert!((filled.steps as f64) < (16 * n) as f64 / cfl);
    errors.iter().fold(0.0, |most, error| error.abs().max(most))
}

#[test]
fn six_cells() {
    assert!(compare(6, [0.0; 2]) < 0.06);
    assert!(compare(6, [0.25, 0.0]) < 0.07);
    assert!(compare(6, [0.5, 0.0]) < 0.05);
    assert!(compare(6, [0.75, 0.25]) < 0.05);
}

/// What cells lack behind the front does not let its tip run ahead in short steps.
#[test]
fn short_steps_fill_as_long_ones_do() {
    assert!(compare_at(0.25, 12, [0.5, 0.0]) < 0.02);
}

#[test]
#[ignore = "about 10 s; prints the numbers of docs/results"]
fn three_and_twelve_cells() {
    for offset in [0.0, 0.25, 0.5, 0.75] {
        compare(3, [offset, 0.0]);
    }
    compare(12, [0.0, 0.0]);
    compare(12, [0.25, 0.0]);
    compare(12, [0.5, 0.0]);
}

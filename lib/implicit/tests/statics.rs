//! Developed flow along channels and ducts under weight, walls on the faces of cells and half way between them.

#![allow(clippy::print_stdout, reason = "prints for developers")]

#[path = "common/plain.rs"]
mod plain;

use implicit::{Implicit, Settings};
use physics::{Boundary, Motion, Scene, Scheme, StepLimit, VoxelBlock};

/// Edge of a cell, m.
const CELL: f64 = 2.9e-6;
const ETA: f64 = 1.3;
const PULL: f64 = 1e5;

/// The scheme after two long steps, which leave nothing of the start.
fn flowing(scene: &Scene) -> Implicit {
    let settings = Settings {
        tolerance: 1e-6,
        ..Settings::default()
    };
    let mut scheme = Implicit::new(scene, settings).unwrap();
    for _ in 0..2 {
        let limit = StepLimit {
            time_s: 1e-5,
            travel_m: f64::INFINITY,
        };
        scheme.advance(limit).unwrap();
    }
    scheme
}

/// A channel or duct along x of `width` half-cells, its low walls `offset` half-cells off the faces of cells.
fn channel(width: usize, offset: usize, square: bool) -> Scene {
    let h = CELL;
    let n = width.div_ceil(2) + 2;
    let cells = [4, n, if square { n } else { 1 }];
    let mut scene = plain::scene(h, cells);
    let at = |half: usize| 0.5 * h * half as f64;
    let (low, high) = (at(2 + offset), at(2 + offset + width));
    let end = h * n as f64;
    let length = 4.0 * h;
    let slab = |low: [f64; 3], high: [f64; 3]| VoxelBlock::solid_box(low, high);
    let depth = if square { end } else { h };
    let mut walls = vec![
        slab([0.0; 3], [length, low, depth]),
        slab([0.0, high, 0.0], [length, end, depth]),
    ];
    let mut points = [4, width, 2];
    let (mut from, mut size) = ([0.0, low, 0.0], [h, 0.5 * h, 0.5 * h]);
    if square {
        walls.push(slab([0.0, low, 0.0], [length, high, low]));
        walls.push(slab([0.0, low, high], [length, high, end]));
        points[2] = width;
        from[2] = low;
    } else {
        points[2] = 1;
        size[2] = h;
    }
    (size[0], points[0]) = (0.5 * h, 8);
    scene.points = plain::fill(from, size, points);
    scene.bodies = vec![plain::body("wall", walls, Motion::Fixed)];
    scene.boundary[0] = Boundary::Periodic;
    scene.gravity = [PULL, 0.0, 0.0];
    scene.liquid.density = 1200.0;
    scene
}

/// Error of the mean velocity, by the power that the weight gives off, and the largest of velocities at points in a channel
/// over the fastest.
fn errors(width: usize, offset: usize, square: bool) -> [f64; 2] {
    let scene = channel(width, offset, square);
    let scheme = flowing(&scene);
    let (h, pull) = (0.5 * CELL * width as f64, 1200.0 * PULL);
    let factor = if square { 0.035_144_3 } else { 1.0 / 12.0 };
    let found = scheme.diagnostics();
    let mean = found.viscous_power / (pull * found.volume);
    let error = mean / (factor * h * h * pull / ETA) - 1.0;
    let low = 0.5 * CELL * (2 + offset) as f64;
    let exact = |y: f64| 4.0 * (y - low) * (low + h - y) / (h * h);
    let fastest = h * h * pull / (8.0 * ETA);
    let liquid = scheme.liquid();
    let points = liquid.velocity.iter().zip(&liquid.position);
    let worst = points
        .map(|(v, x)| (f64::from(v[0]) / fastest - exact(f64::from(x[1]))).abs())
        .fold(0.0, f64::max);
    let (cells, off) = (width as f64 / 2.0, offset as f64 / 2.0);
    println!(
        "width {cells} cells, offset {off}, square {square}: mean velocity {:+.3} %{}",
        100.0 * error,
        match square {
            true => String::new(),
            false => format!(", points {:.3} % at most", 100.0 * worst),
        }
    );
    [error.abs(), worst]
}

#[test]
fn flow_along_channels_and_ducts_is_that_of_the_closed_forms() {
    for width in [4, 6, 8, 12] {
        for offset in [0, 1] {
            let [mean, points] = errors(width, offset, false);
            // Where walls stand half way in cells, the flux of faces is right and not what each has of it.
            let most = if offset == 0 {
                2e-3
            } else {
                0.6 / width as f64
            };
            assert!(mean < 4e-3 && points < most);
            // Ducts of three cells and more.
            assert!(width < 6 || errors(width, offset, true)[0] < 0.013);
        }
    }
}

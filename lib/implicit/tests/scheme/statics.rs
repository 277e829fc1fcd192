//! Developed flow along channels and ducts under weight, walls on the faces of cells and half way between them.

use physics::{Scene, Scheme, VoxelBlock};

use crate::plain;
use crate::runs::{ETA, advance, driven, mean_velocity, solved};

/// Edge of a cell, m.
const CELL: f64 = 2.9e-6;
const PULL: f64 = 1e5;

/// A channel or duct along x of `width` half-cells, its low walls `offset` half-cells off the faces of cells.
fn channel(width: usize, offset: usize, square: bool) -> Scene {
    let h = CELL;
    let n = width.div_ceil(2) + 2;
    let at = |half: usize| 0.5 * h * half as f64;
    let (low, high) = (at(2 + offset), at(2 + offset + width));
    let (end, length) = (h * n as f64, 4.0 * h);
    let [depth, first] = if square { [end, low] } else { [h, 0.0] };
    let slab = VoxelBlock::solid_box;
    let mut walls = vec![
        slab([0.0; 3], [length, low, depth]),
        slab([0.0, high, 0.0], [length, end, depth]),
    ];
    if square {
        walls.push(slab([0.0, low, 0.0], [length, high, low]));
        walls.push(slab([0.0, low, high], [length, high, end]));
    }
    let (deep, cells, dz) = match square {
        true => (width, n, 0.5 * h),
        false => (1, 1, h),
    };
    let mut scene = plain::scene(h, [4, n, cells]);
    scene.points = plain::fill([0.0, low, first], [0.5 * h, 0.5 * h, dz], [8, width, deep]);
    driven(scene, walls, PULL)
}

/// Error of the mean velocity, and the largest of velocities at points in a channel over the fastest.
fn errors(width: usize, offset: usize, square: bool) -> [f64; 2] {
    let scene = channel(width, offset, square);
    let mut scheme = solved(&scene, 1e-6);
    // Two long steps leave nothing of the start.
    (0..2).for_each(|_| _ = advance(&mut scheme, 1e-5));
    let (h, pull) = (0.5 * CELL * width as f64, 1200.0 * PULL);
    let factor = if square { 0.035_144_3 } else { 1.0 / 12.0 };
    let error = mean_velocity(&scene, &scheme) / (factor * h * h * pull / ETA) - 1.0;
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
    for (width, offset) in [4, 6, 8, 12].into_iter().flat_map(|w| [(w, 0), (w, 1)]) {
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

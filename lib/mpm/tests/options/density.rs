//! The density projection on cells of which the answer is known.

use mpm::{Explicit, Settings, ShapeFunction, VelocityUpdate};
use physics::{Boundary, Motion, Scheme};

use crate::scenes::{CELL, FREE, fill, scene, settings, solid};

/// Points per cell at the place of a wave cos(2 pi x / 8 cells), as the wave's amplitude.
fn wave(run: &Explicit) -> f64 {
    let liquid = run.liquid();
    let (mut sine, mut cosine) = (0.0, 0.0);
    for x in &liquid.position {
        let phase = std::f64::consts::TAU * f64::from(x[0]) / (8.0 * CELL);
        sine += phase.sin();
        cosine += phase.cos();
    }
    2.0 * f64::hypot(sine, cosine) / liquid.position.len() as f64
}

#[test]
fn the_projection_evens_the_density_and_nothing_else() {
    let mut s = scene(
        [8, 6, 1],
        [Boundary::Periodic, Boundary::Symmetry, Boundary::Symmetry],
    );
    fill(&mut s, [0.0, 0.0, 0.0], [8.0, 6.0, 1.0], |_| {
        [1.0, 0.0, 0.0]
    });
    for x in &mut s.points.position {
        let phase = std::f64::consts::TAU * x[0] / (8.0 * CELL);
        x[0] += 0.15 * CELL * phase.sin();
    }
    let mut paper = settings(ShapeFunction::Gimp, VelocityUpdate::Pic, 0.5);
    let end = |settings: &Settings| {
        let mut run = Explicit::new(&s, settings).unwrap();
        let first = wave(&run);
        // One cell of motion: 25 projections, each taking half of what is left.
        let mut time = 0.0;
        while time < CELL {
            time += run.advance(FREE).unwrap().dt_s;
        }
        let liquid = run.liquid();
        let speed = |v: &[f32; 3]| f64::hypot(f64::from(v[0]) - 1.0, f64::from(v[1]));
        let change = liquid.velocity.iter().map(speed).fold(0.0, f64::max);
        (
            first,
            wave(&run),
            change,
            liquid.volume.iter().map(|&v| f64::from(v)).sum::<f64>(),
        )
    };
    let (first, kept, ..) = end(&paper);
    paper.density_projection = Some(0.04);
    let (_, evened, change, volume) = end(&paper);
    println!(
        "density wave {first:.4}, without projection {kept:.4}, with it {evened:.5}; largest change of velocity {change:e}"
    );
    // Displacement 0.15 sin: density amplitude 0.15 * 2 pi / 8 = 0.118.
    assert!((first - 0.118).abs() < 0.005 && (kept / first - 1.0).abs() < 1e-3);
    // Cubes of points that straddle cells leave what a cell cannot see.
    assert!(evened < 0.1 * first);
    assert!(change < 1e-5 && (volume / s.liquid_volume() - 1.0).abs() < 1e-6);
}

/// Where one projection moves the points of `s` along x, cells.
fn projected(s: &physics::Scene) -> Vec<f64> {
    let after = |density_projection: Option<f64>| {
        let settings = Settings {
            density_projection,
            ..settings(ShapeFunction::Gimp, VelocityUpdate::Pic, 0.5)
        };
        let mut run = Explicit::new(s, &settings).unwrap();
        run.advance(FREE).unwrap();
        run.liquid().position
    };
    let (with, without) = (after(Some(1e-6)), after(None));
    (with.iter().zip(without))
        .map(|(a, b)| f64::from(a[0] - b[0]) / CELL)
        .collect()
}

/// Two drops of one cell. One is free and holds twice its room, 1.46 of it after what its points, as
/// cubes, have in the air: an error of 0.3 counts, of which half goes out through four faces. The
/// other, a tenth more than a cell, has walls around that leave it 0.8 cells: half of 0.3 of that goes out
/// where there is a way. Points at 1/4 and 3/4 of a cell follow linearly.
#[test]
fn a_crowded_cell_pushes_out_what_the_method_says() {
    let let_out = |low: [f64; 2], high: [f64; 2], wanted: f64| {
        let mut s = scene([14, 14, 1], [Boundary::Symmetry; 3]);
        for (low, high) in [
            ([4.0, 4.0], [7.0, 5.0]),
            ([4.0, 6.0], [7.0, 7.0]),
            ([4.0, 5.0], [5.2, 6.0]),
            (low, high),
        ] {
            let (low, high) = ([low[0], low[1], 0.0], [high[0], high[1], 1.0]);
            s.bodies.push(solid("wall", low, high, Motion::Fixed));
        }
        for y in [5.0, 10.0] {
            fill(&mut s, [5.0, y, 0.0], [6.0, y + 1.0, 1.0], |_| {
                [0.01, 0.0, 0.0]
            });
        }
        for (p, volume) in s.points.volume.iter_mut().enumerate() {
            *volume *= if p < 4 { 1.1 } else { 2.0 };
        }
        let found = projected(&s);
        println!("{found:.5?}, {wanted} wanted");
        let free = 0.15 / 4.0;
        for (found, wanted) in [
            (found[0], 0.25 * wanted),
            (found[1], 0.75 * wanted),
            (found[4], -0.5 * free),
            (found[5], 0.5 * free),
        ] {
            assert!((found - wanted).abs() < 5e-4);
        }
    };
    // More than a tenth of a cell of room is a way out, less is wall.
    let end = [8.0, 6.0];
    let_out([6.12, 5.0], end, 0.12);
    let_out([6.08, 5.0], end, 0.0);
    // Through three tenths of a face four tenths of a cell: a quarter is the most.
    let_out([6.0, 5.3], end, 0.25);
    // A face is open where the next millionth of a cell behind it is: a plate may close a quarter of it.
    let_out([6.0 + 1.5e-6, 5.0], [6.3, 6.0], 0.12);
    let_out([6.0 + 0.75e-6, 5.0], [6.3, 6.0], 0.16);
}

/// A cell in the liquid that is less than half full is a bubble; one above draws the rest together.
#[test]
fn a_cell_half_full_is_drawn_together() {
    let drawn = |full: f64| {
        let mut s = scene([9, 9, 1], [Boundary::Symmetry; 3]);
        fill(&mut s, [2.0, 2.0, 0.0], [7.0, 7.0, 1.0], |_| {
            [0.01, 0.0, 0.0]
        });
        for (x, v) in s.points.position.iter().zip(&mut s.points.volume) {
            if x[..2].iter().all(|x| (x / CELL - 4.5).abs() < 0.5) {
                *v *= full;
            }
        }
        projected(&s)
            .iter()
            .fold(0.0_f64, |most, d| most.max(d.abs()))
    };
    let (bubble, thin) = (drawn(0.45), drawn(0.55));
    println!("{bubble:e} and {thin:.4} cells");
    assert!(bubble < 1e-3 && thin > 0.01);
}

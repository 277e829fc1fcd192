//! The options that are not the paper's: pressure from the cell, density projection, contact
//! separation.

mod density;
#[path = "../scenes/mod.rs"]
mod scenes;

use mpm::{Explicit, PressureFrom, Settings, ShapeFunction, VelocityUpdate};
use physics::{Boundary, Motion, Scene, Scheme};
use scenes::{CELL, FREE, advance, fill, press, scene, settings, solid};

#[test]
fn points_of_a_cell_share_their_volume_ratio_and_volume_is_kept() {
    let mut s = scene([10, 10, 1], [Boundary::Symmetry; 3]);
    // Converging flow that fills the box: volume is given by the walls.
    fill(&mut s, [0.0; 3], [10.0, 10.0, 1.0], |x| {
        let wave = |x: f64| 2.0 * (std::f64::consts::PI * x / 10.0).sin();
        [wave(x[0]), wave(x[1]), 0.0]
    });
    let settings = Settings {
        pressure: PressureFrom::CellMean,
        ..settings(ShapeFunction::Gimp, VelocityUpdate::Flip, 0.5)
    };
    let after = |s: &Scene| {
        let mut run = Explicit::new(s, &settings).unwrap();
        advance(&mut run, 100);
        run.liquid()
    };
    let liquid = after(&s);
    // Half of the mass under half of the force moves and compresses alike.
    let mut half = s.clone();
    half.points.volume.iter_mut().for_each(|v| *v *= 0.5);
    for (half, whole) in after(&half).volume.iter().zip(&liquid.volume) {
        assert!((2.0 * half / whole - 1.0).abs() < 1e-6);
    }
    let mut of_cell = std::collections::HashMap::new();
    let (mut least, mut most) = (f32::INFINITY, 0.0_f32);
    for (x, &v) in liquid.position.iter().zip(&liquid.volume) {
        let cell = [0, 1].map(|a| (f64::from(x[a]) / CELL).floor() as i32);
        let first = *of_cell.entry(cell).or_insert(v);
        assert!((v / first - 1.0).abs() < 1e-6, "cell {cell:?}");
        (least, most) = (least.min(v), most.max(v));
    }
    let volume: f64 = liquid.volume.iter().map(|&v| f64::from(v)).sum();
    let change = volume / s.liquid_volume() - 1.0;
    println!("volumes of points {least:e} to {most:e} m3, volume change {change:e}");
    assert!(most / least > 1.0002, "the flow compresses some cells");
    // In closed walls the fluxes add up to nothing; J follows them by products, hence J^2.
    assert!(change.abs() < 1e-5);
}

#[test]
fn the_contact_separation_says_how_near_liquid_is_held() {
    let mut s = scene([6, 10, 1], [Boundary::Symmetry; 3]);
    s.bodies = vec![solid("floor", [0.0; 3], [6.0, 2.0, 1.0], Motion::Fixed)];
    // A cell of air, then liquid that falls.
    fill(&mut s, [0.0, 3.0, 0.0], [6.0, 6.0, 1.0], |_| {
        [0.0, -5.0, 0.0]
    });
    s.bottom = Some(0);
    let height = |separation: Option<f64>| {
        let settings = Settings {
            separation,
            ..settings(ShapeFunction::Gimp, VelocityUpdate::Flip, 0.5)
        };
        let mut run = Explicit::new(&s, &settings).unwrap();
        while run.advance(FREE).unwrap().pressure_bottom == 0.0 {}
        let heights = run.liquid().position.into_iter().map(|x| x[1]);
        f64::from(heights.fold(f32::INFINITY, f32::min)) / CELL - 2.0
    };
    let (default, same, near) = (height(None), height(Some(0.8)), height(Some(0.5)));
    println!(
        "first contact with points {default:.3}, {same:.3} and {near:.3} cells above the floor"
    );
    assert_eq!(default, same);
    assert!(near < default - 0.1);
}

#[test]
fn options_out_of_range_are_refused() {
    let s = press();
    let flip = settings(ShapeFunction::Gimp, VelocityUpdate::Flip, 0.5);
    let refused = |density_projection, separation| {
        let changed = Settings {
            density_projection,
            separation,
            ..flip
        };
        Explicit::new(&s, &changed).err()
    };
    for (said, word) in [
        (refused(Some(0.0), None), "density_projection"),
        (refused(Some(f64::NAN), None), "density_projection"),
        (refused(None, Some(3.1)), "separation"),
    ] {
        println!("{said:?}");
        assert!(said.expect("a refusal").contains(word));
    }
    assert_eq!(refused(None, Some(3.0)), None);
}

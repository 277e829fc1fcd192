//! A lumen sealed by a thin wall, below liquid under the clamp's pressure limit: nothing may
//! get in, at any offset of the wall from the nodes.

mod scenes;

use mpm::{Explicit, ShapeFunction, VelocityUpdate};
use physics::{Boundary, Motion, Scene, Scheme, VoxelBlock};
use scenes::{CELL, FREE, body, clamp, pour, scene, settings, solid};

const WIDTH: usize = 4;

/// Liquid between a lid that the clamp moves and wood with an empty lumen below a roof of
/// `thickness` voxels; a second, filled lumen stands beside it behind a wall as thin.
fn sealed(thickness: usize, offset: f64) -> Scene {
    let mut s = scene([2 * WIDTH, 14, 4], [Boundary::Symmetry; 3]);
    s.boundary[1] = Boundary::Open;
    // Voxels of half a cell: floor 2, lumen 6, roof; the wall stands in the middle.
    let lumen = 2..8;
    let roof = 8 + thickness;
    let wall = 2 * WIDTH - thickness..2 * WIDTH;
    let (columns, low) = (4 * WIDTH, 1.0 + offset);
    let wood = VoxelBlock::from_fn(
        [0.0, low * CELL, 0.0],
        [0.5 * CELL; 3],
        [columns, roof, 8],
        |i, j, _| j < 2 || wall.contains(&i) || (i < wall.start && !lumen.contains(&j)),
    );
    let top = low + 0.5 * roof as f64;
    let side = wall.end as f64 * 0.5;
    let (width, lid) = (2.0 * WIDTH as f64, top + 2.0);
    pour(&mut s, [side, low + 1.0, 0.0], [width, top, 4.0]);
    pour(&mut s, [0.0, top, 0.0], [width, lid, 4.0]);
    let (low, high) = ([0.0, lid, 0.0], [width, lid + 2.0, 4.0]);
    let lid = solid("lid", low, high, Motion::Clamped);
    clamp(&mut s, [body("wood", wood, Motion::Fixed), lid], 1.0);
    s
}

#[test]
fn thin_walls_hold() {
    for update in [VelocityUpdate::Flip, VelocityUpdate::Xpic(2)] {
        for thickness in [1, 2] {
            for offset in [0.0, 0.38, 0.76] {
                let s = sealed(thickness, offset);
                let settings = settings(ShapeFunction::Gimp, update, 0.5);
                let mut run = Explicit::new(&s, &settings).unwrap();
                let v0 = run.diagnostics().volume;
                let (mut bottom, mut top, mut largest) = (0.0, 0.0, 0.0_f64);
                for i in 0..900 {
                    let report = run.advance(FREE).unwrap();
                    if i >= 500 {
                        bottom += report.pressure_bottom / 400.0;
                        top += report.pressure_top / 400.0;
                    }
                    largest = largest.max(report.pressure_top);
                }
                let liquid = run.liquid();
                let low = 1.0 + offset;
                let roof = low + 4.0 + 0.5 * thickness as f64;
                let side = WIDTH as f64 - 0.5 * thickness as f64;
                let inside =
                    |x: &[f32; 3]| f64::from(x[0]) < side * CELL && f64::from(x[1]) < roof * CELL;
                let leaked = liquid.position.iter().filter(|x| inside(x)).count();
                let mean_p = liquid.pressure.iter().map(|&p| f64::from(p)).sum::<f64>()
                    / liquid.pressure.len() as f64;
                println!(
                    "{update:?} {thickness} voxel, offset {offset:.2}: leaked {leaked}, stopped {:?}, volume {:+.2e}, bottom {:.2} top {:.2} largest {:.2} mean liquid {:.2} MPa",
                    run.counts(),
                    run.diagnostics().volume / v0 - 1.0,
                    bottom / 1e6,
                    top / 1e6,
                    largest / 1e6,
                    mean_p / 1e6,
                );
                assert_eq!(leaked, 0);
                // Both bodies carry the same; when a face lies half a cell off the nodes a layer
                // of half a cell at it goes unstrained, so the mean in the liquid may be half.
                assert!((bottom / top - 1.0).abs() < 0.02);
                assert!((0.45..1.2).contains(&(mean_p / bottom)));
                assert!(run.counts().contains(&("points trapped in walls", 0)));
            }
        }
    }
}

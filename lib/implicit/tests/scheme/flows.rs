//! Liquid that thins along a channel, and liquid that flies on.

use physics::{Boundary, Law, LiquidState, Motion, Scene, Scheme, Viscosity, VoxelBlock, WallLaw};

use crate::plain;
use crate::runs::{H, advance, block, driven, solved};

/// Stress at the walls of the channel, Pa.
const STRESS: f64 = 1.3e5;
/// Of a liquid of eta = K rate^(n - 1).
const CONSISTENCY: f64 = 411.0;
const INDEX: f64 = 0.5;

fn steps(scene: &Scene, count: usize) -> LiquidState {
    let mut scheme = solved(scene, 1e-6);
    (0..count).for_each(|_| _ = advance(&mut scheme, 1e-5));
    assert_eq!(scheme.objection(), None);
    scheme.liquid()
}

/// Error of the mean velocity in a channel of `n` cells along x, walls half a cell thick where they are off the faces of cells.
fn thinning(n: usize, off: bool) -> f64 {
    let (h, w) = (H / n as f64, n as f64);
    let from = if off { 1.5 } else { 1.0 };
    let low = from * h;
    let mut scene = plain::scene(h, [4, n + 3, 1]);
    let walls = [[0.0, from], [from + w, w + 3.0]];
    let walls = walls.map(|[from, to]| block(h, [0.0, from], [4.0, to]));
    scene.points = plain::fill([0.0, low, 0.0], [0.5 * h, 0.5 * h, h], [8, 2 * n, 1]);
    // Next to no inertia.
    scene.liquid.density = 1.2;
    scene.liquid.viscosity = Viscosity::Law(Law::Power {
        k: CONSISTENCY,
        n: INDEX,
        rates: [1e2, 1e9],
    });
    let scene = driven(scene, walls.to_vec(), 2.0 * STRESS / H / 1.2);
    let rate = (STRESS / CONSISTENCY).powf(1.0 / INDEX);
    let fastest = INDEX / (INDEX + 1.0) * 0.5 * H * rate;
    let exact = |y: f64| {
        let from_middle = (2.0 * (y - low) / H - 1.0).abs();
        fastest * (1.0 - from_middle.powf(1.0 / INDEX + 1.0))
    };
    let liquid = steps(&scene, 4);
    let points = liquid.velocity.iter().zip(&liquid.position);
    let (found, right) = points.fold((0.0, 0.0), |(found, right), (v, x)| {
        (found + f64::from(v[0]), right + exact(f64::from(x[1])))
    });
    let error = found / right - 1.0;
    println!(
        "channel of {n} cells, liquid of index {INDEX}, walls off {off}: {:+.2} %",
        100.0 * error
    );
    error
}

#[test]
fn liquid_that_thins_flows_as_the_closed_form_says() {
    for n in [6, 12, 24] {
        for off in [false, true] {
            assert!(thinning(n, off).abs() < 2e-3);
        }
    }
}

/// Liquid that nothing touches goes on as it came, but for the friction by which all liquid has a velocity; between walls that
/// all move along themselves it goes on with them.
#[test]
fn liquid_that_nothing_holds_keeps_its_velocity() {
    let h = 1e-6;
    for (low, speed, most) in [
        (2.0, 0.25, [5e-4, 1e-5]),
        (2.0, 0.5, [1e-6; 2]),
        (2.5, 0.5, [1e-6; 2]),
    ] {
        let walled = speed == 0.5;
        let mut scene = plain::scene(h, [8, if walled { 12 } else { 8 }, 1]);
        let rows = if walled { 12 } else { 6 };
        scene.points = plain::fill([0.0, low * h, 0.0], [0.5 * h, 0.5 * h, h], [16, rows, 1]);
        scene.points.velocity.fill([speed, 0.0, 0.0]);
        scene.boundary[0] = Boundary::Periodic;
        if walled {
            let wall = |name: &str, from: f64, to: f64| {
                let block = VoxelBlock::solid_box([-1e-4, from * h, 0.0], [1e-4, to * h, h]);
                plain::body(name, vec![block], Motion::Constant([speed, 0.0, 0.0]))
            };
            scene.bodies = vec![wall("low", 0.0, low), wall("high", low + 6.0, 12.0)];
        } else {
            scene.wall = WallLaw::Frictionless;
        }
        for v in steps(&scene, 3).velocity {
            let off = [f64::from(v[0]) - speed, f64::from(v[1])].map(f64::abs);
            assert!(off[0] < most[0] && off[1] < most[1], "{low} {v:?}");
        }
    }
}

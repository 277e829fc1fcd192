//! Penetration, maps and profiles against closed forms.

mod specimens;

use bondline::Specimen;
use metrics::{Datum, Map, Penetration, Reference, Sealed, Side, depth_profile, penetration};
use specimens::{Run, Stack, VOXEL, close, placed};
use units::Axis;

fn measured(state: &metrics::State, reference: Reference) -> [Penetration; 3] {
    penetration(state, &Datum::find(reference, state).unwrap())
}

/// The sum of squares of the sides, weighted by volume, is the square of the total.
fn identity_holds([bottom, top, total]: &[Penetration; 3]) -> bool {
    let square = |p: &Penetration| match p.voxels {
        0 => 0.0,
        _ => p.volume_m3 * p.wp_m * p.wp_m,
    };
    close(square(bottom) + square(top), square(total), 1e-12) || square(total) < 1e-40
}

/// 30 layers of wood with grooves, `t` layers of adhesive, 30 layers of wood with grooves.
fn slab(normal: Axis, t: usize) -> Stack {
    let mut dims = [24, 24, 24];
    dims[normal.index()] = 60 + t;
    Stack::new(dims, move |x, y, z| {
        let index = [x, y, z];
        let layer = index[normal.index()];
        let across = index[(normal.index() + 1) % 3];
        match layer {
            l if (30..30 + t).contains(&l) => 'a',
            _ if across.is_multiple_of(3) => ' ',
            _ => 'w',
        }
    })
}

#[test]
fn a_slab_has_not_penetrated() {
    for normal in Axis::ALL {
        for t in [1, 2, 13, 38] {
            let stack = slab(normal, t);
            let found = measured(&stack.state(normal), Reference::Mid);
            let total = found[2];
            // Voxels at their centres: variance (t^2 - 1) / 12, of a continuous slab t^2 / 12.
            let t = t as f64;
            let exact = ((t * t - 1.0) / 12.0).sqrt() * VOXEL;
            assert!(
                close(total.wp_m, exact, 1e-9),
                "{normal} {t}: {}",
                total.wp_m
            );
            assert!(close(total.slab_wp_m, t * VOXEL / 12_f64.sqrt(), 1e-12));
            assert!(close(total.ep_m, t * VOXEL, 1e-12));
            assert!(close(total.plane_m, (30.0 + 0.5 * t) * VOXEL, 1e-12));
            assert!((total.max_depth_m - 0.5 * (t - 1.0) * VOXEL).abs() < 1e-12);
            assert!(identity_holds(&found));
            // Measured from the adherends, what lies between has no depth.
            let from_wood = measured(&stack.state(normal), Reference::Adherend);
            assert_eq!(from_wood[2].wp_m, 0.0);
            assert!(close(from_wood[0].plane_m, 30.0 * VOXEL, 1e-12));
            assert!(close(from_wood[1].plane_m, (30.0 + t) * VOXEL, 1e-12));
        }
    }
}

#[test]
fn unequal_sides_about_a_given_plane() {
    // 12 layers below and 4 above y = 20, in a quarter of the columns below.
    let stack = Stack::new([8, 40, 8], |x, y, _| match y {
        8..20 if x < 2 => 'a',
        20..24 => 'a',
        _ => 'w',
    });
    let found = measured(&stack.state(Axis::Y), Reference::Plane(20.0 * VOXEL));
    let [bottom, top, total] = found;
    let mean_square = |n: f64| (4.0 * n * n - 1.0) / 12.0 * VOXEL * VOXEL;
    assert!(close(bottom.wp_m, mean_square(12.0).sqrt(), 1e-9));
    assert!(close(top.wp_m, mean_square(4.0).sqrt(), 1e-9));
    let (below, above) = (12.0 * 16.0, 4.0 * 64.0);
    let both = (below * mean_square(12.0) + above * mean_square(4.0)) / (below + above);
    assert!(close(total.wp_m, both.sqrt(), 1e-9));
    assert!(identity_holds(&found));
    assert_eq!((bottom.voxels, top.voxels, total.voxels), (192, 256, 448));
    assert!(close(bottom.ep_m, 3.0 * VOXEL, 1e-9) && close(total.ep_m, 7.0 * VOXEL, 1e-9));
    // Of 192 voxels in 12 layers 99 % need the deepest layer, of 50 layers they do not.
    assert!(close(bottom.p99_depth_m, 11.5 * VOXEL, 1e-9));
    assert!(close(bottom.max_depth_m, 11.5 * VOXEL, 1e-9));
}

#[test]
fn the_99th_percentile_leaves_a_speck_out() {
    let stack = Stack::new([10, 60, 20], |x, y, z| match y {
        30..31 => 'a',
        55 if x == 0 && z == 0 => 'a',
        _ => 'w',
    });
    let top = measured(&stack.state(Axis::Y), Reference::Plane(30.0 * VOXEL))[1];
    assert!(close(top.max_depth_m, 25.5 * VOXEL, 1e-9));
    assert!(close(top.p99_depth_m, 0.5 * VOXEL, 1e-9));
}

#[test]
fn a_side_without_adhesive_has_no_penetration() {
    let stack = Stack::new([4, 20, 4], |_, y, _| if y == 12 { 'a' } else { 'w' });
    let [bottom, top, total] = measured(&stack.state(Axis::Y), Reference::Plane(10.0 * VOXEL));
    assert!(bottom.wp_m.is_nan() && bottom.max_depth_m.is_nan());
    assert_eq!((bottom.volume_m3, bottom.voxels), (0.0, 0));
    assert!(bottom.volume_m3.is_sign_positive());
    assert!(close(top.wp_m, total.wp_m, 1e-12));
}

#[test]
fn the_middle_of_a_run_moves_with_half_the_gap() {
    // The same points in a closed and in an open bond: the open one is measured from where
    // the middle is now.
    let stack = slab(Axis::Y, 10);
    for gap in [0.0, 7.3 * VOXEL] {
        let mut run = Run::new(&stack, 35, gap);
        for i in 0..100 {
            let y = 20.0 + 0.3 * f64::from(i);
            run.add([0.5 + f64::from(i % 24), y, 0.5 + f64::from(i % 23)]);
        }
        let state = run.state();
        let found = measured(&state, Reference::Mid);
        let middle = 35.0 + 0.5 * gap / VOXEL;
        assert!(close(found[2].plane_m, middle * VOXEL, 1e-9));
        let squares: f64 = (0..100)
            .map(|i| (20.0 + 0.3 * f64::from(i) - middle).powi(2))
            .sum();
        let exact = (squares / 100.0).sqrt() * VOXEL;
        assert!(
            close(found[2].wp_m, exact, 1e-5),
            "{} {exact}",
            found[2].wp_m
        );
        assert!(identity_holds(&found));
        assert_eq!(found[2].voxels, 100);
        let surfaces = measured(&state, Reference::Adherend);
        assert!(close(surfaces[0].plane_m, 30.0 * VOXEL, 1e-9));
        assert!(close(surfaces[1].plane_m, 40.0 * VOXEL + gap, 1e-9));
    }
}

/// A gap of 8 voxels that rises 12 voxels over 96 along x and falls 6 over 64 along z at the slopes of the test, in wood
/// with lumens; adhesive fills the gap only.
fn tilted(slope: [f64; 2]) -> Stack {
    let middle = move |x: usize, z: usize| {
        60.0 + slope[0] * (x as f64 + 0.5 - 48.0) + slope[1] * (z as f64 + 0.5 - 32.0)
    };
    Stack::new([96, 120, 64], move |x, y, z| {
        let height = y as f64 + 0.5 - middle(x, z);
        let lumen = (x % 16) < 6 && (y % 14) < 9;
        match height.abs() {
            h if h < 4.0 => 'a',
            _ if lumen => ' ',
            _ => 'w',
        }
    })
}

#[test]
fn a_tilted_bond_line_is_found_by_the_fit() {
    let slope = [0.125, -0.09375];
    let stack = tilted(slope);
    let state = stack.state(Axis::Y);
    let found = measured(&state, Reference::Fit);
    let tilt = Datum::find(Reference::Fit, &state)
        .unwrap()
        .tilt_deg()
        .unwrap();
    // A rise along x is a turn about z, a fall along z one about x.
    for (tilt, exact) in tilt.into_iter().zip([-slope[1], 0.0, slope[0]]) {
        assert!((tilt - exact.atan().to_degrees()).abs() < 0.1, "{tilt}");
    }
    let cosine = (1.0 + slope[0] * slope[0] + slope[1] * slope[1])
        .sqrt()
        .recip();
    let exact = 8.0 / 12_f64.sqrt() * cosine * VOXEL;
    let level = measured(&state, Reference::Mid)[2].wp_m;
    println!(
        "WP um: fit {:.4}, exact {:.4}, level {:.4}",
        1e6 * found[2].wp_m,
        1e6 * exact,
        1e6 * level
    );
    assert!(close(found[2].wp_m, exact, 0.02));
    assert!(close(found[2].plane_m, 60.0 * VOXEL, 0.005));
    // The same volume over the larger area of the plane.
    let thickness = 8.0 * cosine * VOXEL;
    assert!(close(found[2].ep_m, thickness, 0.005));
    assert!(close(found[2].slab_wp_m, exact, 0.005));
    assert!(
        level > 1.5 * exact,
        "a level reference takes the tilt for penetration"
    );
}

/// Turned, it has the thickness and depths that the fit tells, and no tilt; so for any bond normal.
#[test]
fn a_tilted_specimen_is_turned_level() {
    let exact = tilted([0.125, -0.09375]);
    for normal in Axis::ALL {
        // y of the specimen along the normal, the order of the axes kept.
        let turn = (4 - normal.index()) % 3;
        let old = [96, 120, 64];
        let dims = std::array::from_fn(|i| old[(i + turn) % 3]);
        let stack = Stack::new(dims, |x, y, z| {
            let index: [usize; 3] = std::array::from_fn(|i| [x, y, z][(i + 3 - turn) % 3]);
            match index {
                [x, y, z] if exact.wood.get(x, y, z) => 'w',
                [x, y, z] if exact.adhesive.get(x, y, z) => 'a',
                _ => ' ',
            }
        });
        let specimen = Specimen::new(placed(&stack.wood), placed(&stack.adhesive)).unwrap();
        let level = metrics::level(&specimen, normal).unwrap();
        let turned = Stack {
            wood: level.wood,
            adhesive: level.adhesive,
        };
        let state = turned.state(normal);
        let tilt = Datum::find(Reference::Fit, &state)
            .unwrap()
            .tilt_deg()
            .unwrap();
        assert!(
            tilt.iter().all(|tilt| tilt.abs() < 0.2),
            "{normal}: {tilt:?}"
        );
        let found = measured(&state, Reference::Mid)[2];
        let thickness = 8.0 / (1.0_f64 + 0.125 * 0.125 + 0.09375 * 0.09375).sqrt();
        assert!(
            close(found.ep_m, thickness * VOXEL, 0.01),
            "{normal}: {}",
            found.ep_m
        );
        // Voxels whose centres are in and out by rounding stand out of a slab.
        assert!(close(found.wp_m, thickness / 12_f64.sqrt() * VOXEL, 0.03));
        let again = Specimen::new(placed(&turned.wood), placed(&turned.adhesive)).unwrap();
        let dims = metrics::level(&again, normal).unwrap().wood.dims();
        assert!(dims.iter().zip(turned.wood.dims()).all(|(a, b)| a + 1 >= b));
    }
}

#[test]
fn a_map_tells_columns_apart() {
    let stack = Stack::new([6, 40, 5], |x, y, z| match y {
        20 if z < 4 => 'a',
        21..25 if x == 3 && z == 2 => 'a',
        _ => 'w',
    });
    let state = stack.state(Axis::Y);
    let datum = Datum::find(Reference::Plane(20.0 * VOXEL), &state).unwrap();
    let map = Map::new(&state, &datum, Side::Total);
    assert_eq!(map.across.columns, [6, 5]);
    let at = |x: usize, z: usize| map.wp_m(z * 6 + x);
    assert!(close(at(0, 0).unwrap(), 0.5 * VOXEL, 1e-9));
    // Mean of (i + 1/2)^2 over five voxels: 8.25.
    assert!(close(at(3, 2).unwrap(), 8.25_f64.sqrt() * VOXEL, 1e-9));
    assert_eq!(at(3, 4), None);
    let centre = map.across.centre_m(2 * 6 + 3);
    assert!(close(centre[0], 3.5 * VOXEL, 1e-12) && close(centre[1], 2.5 * VOXEL, 1e-12));
    let total: f64 = map.volume_m3.iter().sum();
    assert!(close(
        total,
        penetration(&state, &datum)[2].volume_m3,
        1e-12
    ));
    // Nothing of it is on the bottom side.
    let bottom = Map::new(&state, &datum, Side::Bottom);
    assert!(bottom.volume_m3.iter().all(|&v| v == 0.0));
}

#[test]
fn a_depth_profile_is_the_share_of_layer_and_void() {
    // Lumens are half of the wood's columns and filled to 6 layers below and 3 above.
    let stack = Stack::new([8, 50, 4], |x, y, _| match (x % 2, y) {
        (_, 22..28) => 'a',
        (0, 16..31) => 'a',
        (0, _) => ' ',
        _ => 'w',
    });
    let state = stack.state(Axis::Y);
    let datum = Datum::find(Reference::Mid, &state).unwrap();
    let layers = depth_profile(&state, &datum, &Sealed::of(&state, &datum)).unwrap();
    assert_eq!(layers.len(), 50);
    for (y, layer) in layers.iter().enumerate() {
        let depth = (y as f64 + 0.5 - 25.0) * VOXEL;
        assert!((layer.depth_m - depth).abs() < 1e-12);
        let (share, filled) = match y {
            22..28 => (1.0, 1.0),
            16..31 => (0.5, 1.0),
            _ => (0.0, 0.0),
        };
        assert!(
            (layer.adhesive_fraction - share).abs() < 1e-9,
            "{y}: {layer:?}"
        );
        assert!(
            (layer.filled_void_fraction - filled).abs() < 1e-9,
            "{y}: {layer:?}"
        );
    }
    // From the adherends the 6 layers between them are in no layer.
    let datum = Datum::find(Reference::Adherend, &state).unwrap();
    let layers = depth_profile(&state, &datum, &Sealed::of(&state, &datum)).unwrap();
    assert_eq!(layers.len(), 44);
    assert!(layers.iter().all(|l| l.adhesive_fraction < 0.51));
}

#[test]
fn sealed_lumens_are_room_outside_wood_but_not_open() {
    // Below the bond line a third of the columns are open lumens, filled to 6 layers; as many are sealed ones
    // behind three layers of wood.
    let stack = Stack::new([12, 50, 4], |x, y, _| match (x % 6, y) {
        (_, 22..28) | (0 | 1, 16..28) => 'a',
        (0 | 1, ..16) | (3 | 4, ..19) => ' ',
        _ => 'w',
    });
    let state = stack.state(Axis::Y);
    let datum = Datum::find(Reference::Mid, &state).unwrap();
    let layers = depth_profile(&state, &datum, &Sealed::of(&state, &datum)).unwrap();
    for (y, void, open) in [(10, 0.0, 0.0), (17, 0.5, 1.0), (20, 1.0, 1.0)] {
        let layer = layers[y];
        assert!(
            (layer.filled_void_fraction - void).abs() < 1e-9,
            "{layer:?}"
        );
        assert!(
            (layer.filled_open_fraction - open).abs() < 1e-9,
            "{layer:?}"
        );
    }
    assert!(layers[40].filled_open_fraction.is_nan());
    let line = metrics::bond_line(&state, 0.0, &Sealed::of(&state, &datum)).unwrap();
    // Full to nine layers below the middle; above it there are open lumens between the surfaces only.
    let half = line.half_filled_m.map(|depth| depth / VOXEL);
    for (found, wanted) in half.into_iter().zip([9.0, 3.0, 3.0]) {
        assert!((found - wanted).abs() < 1e-9, "{half:?}");
    }
}

#[test]
fn a_profile_between_voxel_faces_keeps_the_volume() {
    let stack = slab(Axis::Y, 10);
    let mut run = Run::new(&stack, 35, 7.3 * VOXEL);
    for i in 0..500 {
        run.add([0.5 + f64::from(i % 24), 25.0 + 0.05 * f64::from(i), 3.5]);
    }
    let state = run.state();
    let datum = Datum::find(Reference::Mid, &state).unwrap();
    let layers = depth_profile(&state, &datum, &Sealed::of(&state, &datum)).unwrap();
    let volume: f64 =
        layers.iter().map(|l| l.adhesive_fraction).sum::<f64>() * VOXEL * state.area_m2();
    assert!(close(volume, 500.0 * VOXEL.powi(3), 1e-5), "{volume}");
}

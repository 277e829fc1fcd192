//! Penetration and maps against closed forms.

mod specimens;

use metrics::{Datum, Map, Penetration, Reference, Side, penetration};
use specimens::{Run, Stack, VOXEL, close, slab};
use units::Axis;

fn measured(state: &metrics::State, reference: Reference) -> [Penetration; 3] {
    let found = penetration(state, &Datum::find(reference, state).unwrap());
    // The squares of the sides, weighted by volume, add up to that of the total.
    let square = |p: &Penetration| match p.voxels {
        0 => 0.0,
        _ => p.volume_m3 * p.wp_m * p.wp_m,
    };
    let [bottom, top, total] = found.each_ref().map(square);
    assert!(close(bottom + top, total, 1e-12) || total < 1e-40);
    found
}

#[test]
fn a_slab_has_not_penetrated() {
    for (normal, t) in Axis::ALL
        .into_iter()
        .flat_map(|n| [1, 2, 13, 38].map(|t| (n, t)))
    {
        let stack = slab(normal, t);
        let [bottom, top, total] = measured(&stack.state(normal), Reference::Mid);
        // Voxels at their centres: variance (t^2 - 1) / 12, of a continuous slab t^2 / 12.
        let t = t as f64;
        let exact = ((t * t - 1.0) / 12.0).sqrt() * VOXEL;
        assert!(close(total.wp_m, exact, 1e-9), "{normal} {t}: {total:?}");
        assert!(close(total.slab_wp_m, t * VOXEL / 12_f64.sqrt(), 1e-12));
        assert!(close(total.ep_m, t * VOXEL, 1e-12));
        // The middle layer of an odd number counts half to each side.
        assert!(
            [bottom, top]
                .iter()
                .all(|side| close(side.ep_m, 0.5 * t * VOXEL, 1e-12))
        );
        assert!(close(total.plane_m, (30.0 + 0.5 * t) * VOXEL, 1e-12));
        assert!((total.max_depth_m - 0.5 * (t - 1.0) * VOXEL).abs() < 1e-12);
        // Measured from the adherends, adhesive between them has no depth.
        let from_wood = measured(&stack.state(normal), Reference::Adherend);
        assert_eq!(from_wood[2].wp_m, 0.0);
        assert!(close(from_wood[0].plane_m, 30.0 * VOXEL, 1e-12));
        assert!(close(from_wood[1].plane_m, (30.0 + t) * VOXEL, 1e-12));
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
    let (below, above) = (12.0 * 16.0, 4.0 * 64.0);
    let both = (below * mean_square(12.0) + above * mean_square(4.0)) / (below + above);
    for (found, square) in found
        .iter()
        .zip([mean_square(12.0), mean_square(4.0), both])
    {
        assert!(close(found.wp_m, square.sqrt(), 1e-9), "{found:?}");
    }
    assert_eq!((bottom.voxels, top.voxels, total.voxels), (192, 256, 448));
    assert!(close(bottom.ep_m, 3.0 * VOXEL, 1e-9) && close(total.ep_m, 7.0 * VOXEL, 1e-9));
    // Of 192 voxels in 12 layers 99 % need the deepest layer.
    assert!(close(bottom.p99_depth_m, 11.5 * VOXEL, 1e-9));
    assert!(close(bottom.max_depth_m, 11.5 * VOXEL, 1e-9));
}

#[test]
fn the_99_percent_depth_ignores_a_speck_and_no_adhesive_has_no_depth() {
    let stack = Stack::new([10, 60, 20], |x, y, z| match y {
        30..31 => 'a',
        55 if x == 0 && z == 0 => 'a',
        _ => 'w',
    });
    let [bottom, top, total] = measured(&stack.state(Axis::Y), Reference::Plane(30.0 * VOXEL));
    assert!(close(top.max_depth_m, 25.5 * VOXEL, 1e-9));
    assert!(close(top.p99_depth_m, 0.5 * VOXEL, 1e-9));
    assert!(bottom.wp_m.is_nan() && bottom.max_depth_m.is_nan());
    assert_eq!((bottom.volume_m3, bottom.voxels), (0.0, 0));
    assert!(bottom.volume_m3.is_sign_positive());
    assert!(close(top.wp_m, total.wp_m, 1e-12));
}

/// The same points in a closed and in an open bond; the open bond is measured from its current middle.
#[test]
fn the_middle_of_a_run_moves_with_half_the_gap() {
    for gap in [0.0, 7.3 * VOXEL] {
        let mut run = Run::new(&slab(Axis::Y, 10), 35, gap);
        for i in 0..100 {
            let y = 20.0 + 0.3 * f64::from(i);
            run.add([0.5 + f64::from(i % 24), y, 0.5 + f64::from(i % 23)]);
        }
        let state = run.state();
        let total = measured(&state, Reference::Mid)[2];
        let middle = 35.0 + 0.5 * gap / VOXEL;
        assert!(close(total.plane_m, middle * VOXEL, 1e-9));
        let squares = (0..100).map(|i| (20.0 + 0.3 * f64::from(i) - middle).powi(2));
        let exact = (squares.sum::<f64>() / 100.0).sqrt() * VOXEL;
        assert!(close(total.wp_m, exact, 1e-5), "{} {exact}", total.wp_m);
        assert_eq!(total.voxels, 100);
        let surfaces = measured(&state, Reference::Adherend);
        assert!(close(surfaces[0].plane_m, 30.0 * VOXEL, 1e-9));
        assert!(close(surfaces[1].plane_m, 40.0 * VOXEL + gap, 1e-9));
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

//! Permeability of voxels against closed forms, and what it must not depend on.

#![allow(clippy::print_stdout, reason = "prints for developers")]

use std::f64::consts::PI;

use implicit::{Permeability, permeability};
use physics::{Boundary, VoxelBlock};

/// Edge of a voxel, m.
const EDGE: f64 = 1.45e-6;

/// Voxels of a box of `dims` whose flow is along `axis`: solid where `solid(u, v, w)` says so, w along the flow, u and v the
/// other axes in their order.
fn block(dims: [usize; 3], axis: usize, solid: impl Fn(usize, usize, usize) -> bool) -> VoxelBlock {
    let mut order = vec![0, 1, 2];
    order.retain(|a| *a != axis);
    order.push(axis);
    let mut size = [0; 3];
    (0..3).for_each(|i| size[order[i]] = dims[i]);
    VoxelBlock::from_fn([0.0; 3], [EDGE; 3], size, |x, y, z| {
        let at = [x, y, z];
        solid(at[order[0]], at[order[1]], at[order[2]])
    })
}

fn along(
    dims: [usize; 3],
    axis: usize,
    solid: impl Fn(usize, usize, usize) -> bool,
) -> Permeability {
    permeability(&block(dims, axis, solid), axis, Boundary::Symmetry).unwrap()
}

/// Relative error against `squares` of the edge of a voxel, printed with the estimate.
fn error(what: &str, found: Permeability, squares: f64) -> f64 {
    let exact = squares * EDGE * EDGE;
    let error = found.m2 / exact - 1.0;
    println!(
        "{what}: {:.4e} m2, closed form {exact:.4e}, error {:+.2} %, estimated {:.2} %",
        found.m2,
        100.0 * error,
        100.0 * found.error_m2 / found.m2
    );
    error
}

#[test]
fn slits_and_ducts_are_those_of_closed_forms_along_every_axis() {
    for axis in 0..3 {
        for n in [4, 6, 12] {
            let width = n as f64;
            let slit = along([n + 2, 4, 8], axis, |u, _, _| u == 0 || u > n);
            let squares = width.powi(3) / 12.0 / (width + 2.0);
            let off = error(&format!("slit of {n} along axis {axis}"), slit, squares);
            assert!(off.abs() < 1e-3);
            assert!((slit.porosity - width / (width + 2.0)).abs() < 1e-12 && slit.through == 1.0);
            let wall = |i: usize| i == 0 || i > n;
            let duct = along([n + 2, n + 2, 8], axis, |u, v, _| wall(u) || wall(v));
            let squares = 0.035_144 * width.powi(4) / (width + 2.0).powi(2);
            let off = error(&format!("duct of {n} along axis {axis}"), duct, squares);
            assert!(off.abs() < 3e-3);
        }
    }
}

#[test]
fn tubes_come_near_poiseuille_as_voxels_do() {
    for (n, most) in [(8, 0.08), (16, 0.05), (32, 0.03)] {
        let (radius, middle) = (0.5 * n as f64, 0.5 * (n + 2) as f64);
        let solid = |u: usize, v: usize, _| {
            let from = [u, v].map(|i| i as f64 + 0.5 - middle);
            from[0].hypot(from[1]) > radius
        };
        let tube = along([n + 2, n + 2, 6], 2, solid);
        let squares = PI * radius.powi(4) / 8.0 / (n as f64 + 2.0).powi(2);
        let off = error(&format!("tube of {n}"), tube, squares);
        assert!(off.abs() < most);
    }
}

#[test]
fn channels_side_by_side_add_up_and_in_a_row_resist() {
    // Walls at 0, 7 and 12: channels of 6 and 4.
    let both = along([12, 4, 8], 1, |u, _, _| u == 0 || u == 7);
    // The second is bounded by a mirror: half of one of 8.
    let squares = (6_f64.powi(3) + 0.5 * 8_f64.powi(3)) / 12.0 / 12.0;
    assert!(error("slits side by side", both, squares).abs() < 1e-3);
    for (split, most) in [(1, 0.03), (2, 0.003)] {
        let row = along([14 * split, 4, 120 * split], 1, |u, _, w| {
            let half = if w < 60 * split { 6 * split } else { 2 * split };
            u.abs_diff(7 * split) > half || u + half == 7 * split
        });
        let resistance: f64 = [12_f64, 4.0].map(|w| 0.5 * 12.0 / w.powi(3)).iter().sum();
        let off = error(
            "slits in a row",
            row,
            (split * split) as f64 / resistance / 14.0,
        );
        // The liquid has to come together besides: -2.1 % in voxels of a third.
        assert!((off + 0.021).abs() < most);
    }
}

/// Grains at places without order.
fn grain(u: usize, v: usize, w: usize) -> bool {
    let mixed = (u / 3 * 73 + v / 3 * 179 + w / 3 * 283) * 2_654_435_761 % 4099;
    mixed < 2000
}

#[test]
fn mirrors_and_exchanged_axes_change_nothing() {
    let dims = [18, 24, 12];
    let first = along(dims, 0, grain);
    println!("grains: {first:?}");
    assert!(first.m2 > 0.0 && first.through < 1.0);
    let same = |other: Permeability| (other.m2 / first.m2 - 1.0).abs() < 1e-3;
    assert!(same(along(dims, 1, grain)) && same(along(dims, 2, grain)));
    assert!(same(along(dims, 0, |u, v, w| grain(17 - u, v, 11 - w))));
    // The same grains between periodic sides, moved over them.
    let moved = |by: usize| {
        let solid = block(dims, 2, |u, v, w| {
            grain((u + by) % 18, (v + 2 * by) % 24, w)
        });
        permeability(&solid, 2, Boundary::Periodic).unwrap()
    };
    assert!((moved(4).m2 / moved(0).m2 - 1.0).abs() < 1e-3);
}

#[test]
fn what_ends_within_lets_nothing_through_and_what_is_no_cube_is_refused() {
    let blind = along([6, 6, 10], 2, |u, v, w| u != 2 || v != 2 || w > 6);
    assert_eq!((blind.m2, blind.error_m2, blind.through), (0.0, 0.0, 0.0));
    let flat = VoxelBlock::from_fn([0.0; 3], [EDGE, EDGE, 2.0 * EDGE], [4; 3], |_, _, _| false);
    let said = permeability(&flat, 0, Boundary::Symmetry).unwrap_err();
    assert!(said.contains("no cubes"), "{said}");
    let thin = block([1, 4, 4], 2, |_, _, _| false);
    let said = permeability(&thin, 2, Boundary::Symmetry).unwrap_err();
    assert!(said.contains("one voxel along x"), "{said}");
    let open = block([4, 4, 4], 2, |_, _, _| false);
    assert!(permeability(&open, 2, Boundary::Open).is_err());
}

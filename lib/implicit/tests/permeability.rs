//! Permeability of voxel volumes against closed forms and finer cells, and its invariances.

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

/// Relative errors in cells of one voxel and of two against `squares` of the edge of a voxel, printed.
fn errors(what: &str, found: Permeability, squares: f64) -> [f64; 2] {
    let exact = squares * EDGE * EDGE;
    let errors = [found.m2, found.coarse_m2].map(|m2| m2 / exact - 1.0);
    println!(
        "{what}: {:.4e} m2 of {exact:.4e}, error {:+.2} %, with two voxels a cell {:+.2} %",
        found.m2,
        100.0 * errors[0],
        100.0 * errors[1]
    );
    errors
}

#[test]
fn slits_and_ducts_are_those_of_closed_forms_along_every_axis() {
    for (axis, n) in (0..3).flat_map(|axis| [2_usize, 3, 4, 6, 8, 12].map(|n| (axis, n))) {
        // Walls half way between the faces of cells of two voxels, or on them.
        for wall in [1, 2] {
            let (width, whole) = (n as f64, (n + 2 * wall).next_multiple_of(2));
            let solid = move |i: usize| i < wall || i >= n + wall;
            let what =
                |kind: &str| format!("{kind} of {n} voxels along axis {axis}, walls of {wall}");
            let slit = along([whole, 4, 8], axis, |u, _, _| solid(u));
            let squares = width.powi(3) / 12.0 / whole as f64;
            let [one, two] = errors(&what("slit"), slit, squares);
            assert!(one.abs() < 1e-3 && (n < 4 || two.abs() < 4e-3));
            assert!((slit.porosity - width / whole as f64).abs() < 1e-12 && slit.through == 1.0);
            let duct = along([whole, whole, 8], axis, |u, v, _| solid(u) || solid(v));
            let squares = 0.035_144_3 * width.powi(4) / (whole as f64).powi(2);
            let [one, two] = errors(&what("duct"), duct, squares);
            let most = [f64::INFINITY, 0.013, 3e-3][n.clamp(2, 4) - 2];
            assert!(one.abs() < most && (n < 6 || wall == 2 || two.abs() < 0.013));
        }
    }
}

/// The last of an odd number of layers was once left out: a slit of one voxel in three was of one in two.
#[test]
fn odd_numbers_of_voxels_are_covered_whole() {
    for (axis, whole) in (0..3).flat_map(|axis| [3_usize, 5, 7].map(|whole| (axis, whole))) {
        let solid = |u: usize| u == 0 || u + 1 == whole;
        let (width, what) = (
            whole as f64 - 2.0,
            format!("slit in {whole} voxels, axis {axis}"),
        );
        let found = along([whole, 5, 3], axis, |u, _, _| solid(u));
        let [one, two] = errors(&what, found, width.powi(3) / 12.0 / whole as f64);
        assert!(one.abs() < 1e-3 && (width < 4.0 || two.abs() < 4e-3));
        assert!((found.porosity - width / whole as f64).abs() < 1e-12 && found.through == 1.0);
    }
    // A periodic cell of odd edges is as permeable as two of them side by side and their mirror images.
    let cell = |u: usize, v: usize, w: usize| (u / 2).max(v / 2) == 1 && w < 2;
    let twice = block([14, 14, 10], 2, |u, v, w| cell(u % 7, v % 7, w.min(9 - w)));
    let [once, twice] = [block([7, 7, 5], 2, cell), twice]
        .map(|solid| permeability(&solid, 2, Boundary::Periodic).unwrap());
    println!("periodic cell: {once:?}, twice {twice:?}");
    for (a, b) in [(once.m2, twice.m2), (once.coarse_m2, twice.coarse_m2)] {
        assert!((a / b - 1.0).abs() < 2e-3, "{a:e}, {b:e}");
    }
    assert!((once.porosity - twice.porosity).abs() < 1e-12);
    let solid = permeability(&block([3; 3], 2, |_, _, _| true), 2, Boundary::Symmetry).unwrap();
    assert!(solid.porosity == 0.0 && solid.porosity.is_sign_positive());
}

#[test]
fn tubes_come_near_poiseuille_as_voxels_do() {
    for (n, most) in [(8, 0.08), (16, 0.05), (32, 0.03)] {
        let tube = tube(n + 2, n as f64, [0.0; 2]);
        let squares = PI * (0.5 * n as f64).powi(4) / 8.0 / (n as f64 + 2.0).powi(2);
        let found = along([n + 2, n + 2, 6], 2, tube);
        let [off, _] = errors(&format!("tube of {n}"), found, squares);
        assert!(off.abs() < most);
    }
}

/// A tube in a square of `n` voxels, its axis off the middle by `shift`.
fn tube(n: usize, diameter: f64, shift: [f64; 2]) -> impl Fn(usize, usize, usize) -> bool {
    let off = move |i: usize, shift: f64| i as f64 + 0.5 - 0.5 * n as f64 - shift;
    move |u, v, _| off(u, shift[0]).hypot(off(v, shift[1])) >= 0.5 * diameter
}

/// Errors with cells of one voxel, two voxels and a quarter of a voxel, against the Richardson extrapolation of a quarter and an
/// eighth, whose error has the given `order`. An axis of two voxels is not refined: nothing varies along it.
fn against_finer(
    what: &str,
    dims: [usize; 3],
    order: f64,
    solid: impl Fn(usize, usize, usize) -> bool,
) -> [f64; 3] {
    let of = |finer: usize| {
        let dims = dims.map(|n| if n == 2 { 2 } else { finer * n });
        let found = along(dims, 2, |u, v, w| solid(u / finer, v / finer, w / finer));
        [found.m2, found.coarse_m2].map(|m2| m2 / (EDGE * EDGE * (finer * finer) as f64))
    };
    let [[one, two], [coarse, _], [fine, _]] = [1, 4, 8].map(of);
    let reference = fine + (fine - coarse) / (2.0_f64.powf(order) - 1.0);
    let errors = [one, two, coarse].map(|found| found / reference - 1.0);
    println!("{what}: one voxel a cell, two, four cells a voxel {errors:+.4?}");
    errors
}

/// Along re-entrant edges the discretisation error is of order h^(4/3).
#[test]
fn flow_along_tubes_of_voxels_is_that_of_finer_cells() {
    for diameter in [4.0, 6.0, 8.0, 12.0] {
        let n = diameter as usize + 4;
        for shift in [[0.0, 0.0], [0.5, 0.5], [0.3, 0.1], [1.0, 1.0]] {
            let what = format!("tube of {diameter} voxels, off by {shift:?}");
            let solid = tube(n, diameter, shift);
            let [one, two, _] = against_finer(&what, [n, n, 2], 4.0 / 3.0, solid);
            assert!(one.abs() < 0.02);
            // Tubes of six cells.
            assert!(diameter < 12.0 || two.abs() < 0.02);
        }
        // Cells of two voxels give the same result on whichever side and along whichever axis the tube's axis is shifted.
        let of = |axis, x| along([n, n, 2], axis, tube(n, diameter, [x, 0.1])).coarse_m2;
        let [own, image, turned] = [(2, 0.3), (2, -0.3), (0, 0.3)].map(|(axis, x)| of(axis, x));
        println!(
            "image {:+.1e}, along x {:+.1e}",
            image / own - 1.0,
            turned / own - 1.0
        );
        assert!((image / own - 1.0).abs() < 1e-5 && (turned / own - 1.0).abs() < 1e-5);
    }
}

/// Past corners the discretisation error is of order h^1.09.
#[test]
fn flow_across_rods_of_voxels_is_that_of_finer_cells() {
    const PITCH: usize = 12;
    for round in [false, true] {
        for thick in [2.0, 4.0, 6.0, 8.0, 10.0] {
            let solid = |u: usize, _: usize, w: usize| {
                let [u, w] = [u, w].map(|i| (i as f64 + 0.5 - 0.5 * PITCH as f64).abs());
                let off = if round { u.hypot(w) } else { u.max(w) };
                off < 0.5 * thick
            };
            let what = format!("rods of {thick} of {PITCH} voxels, round {round}");
            let [one, _, four] = against_finer(&what, [PITCH, 2, PITCH], 1.09, solid);
            // Between the thickest are two cells.
            assert!(one.abs() < if thick < 9.0 { 0.04 } else { 0.08 });
            assert!(four.abs() < 0.01);
        }
    }
}

#[test]
fn channels_side_by_side_add_up_and_in_a_row_resist() {
    // Walls at 0, 7 and 12: channels of 6 and 4.
    let both = along([12, 4, 8], 1, |u, _, _| u == 0 || u == 7);
    // The second is bounded by a mirror: half of one of 8.
    let squares = (6_f64.powi(3) + 0.5 * 8_f64.powi(3)) / 12.0 / 12.0;
    assert!(errors("slits side by side", both, squares)[0].abs() < 1e-3);
    for (split, most) in [(1, 0.03), (2, 0.003)] {
        let row = along([14 * split, 4, 120 * split], 1, |u, _, w| {
            let half = if w < 60 * split { 6 * split } else { 2 * split };
            u.abs_diff(7 * split) > half || u + half == 7 * split
        });
        let resistance: f64 = [12_f64, 4.0].map(|w| 0.5 * 12.0 / w.powi(3)).iter().sum();
        let squares = (split * split) as f64 / resistance / 14.0;
        let [off, _] = errors("slits in a row", row, squares);
        // The contraction adds resistance: -2.1 % with voxels of a third of the size.
        assert!((off + 0.021).abs() < most);
    }
}

/// Grains at irregular positions.
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
    assert_eq!((blind.m2, blind.coarse_m2, blind.through), (0.0, 0.0, 0.0));
    let flat = VoxelBlock::from_fn([0.0; 3], [EDGE, EDGE, 2.0 * EDGE], [4; 3], |_, _, _| false);
    let said = permeability(&flat, 0, Boundary::Symmetry).unwrap_err();
    assert!(said.contains("not cubes"), "{said}");
    let thin = block([1, 4, 4], 2, |_, _, _| false);
    let said = permeability(&thin, 2, Boundary::Symmetry).unwrap_err();
    assert!(said.contains("one voxel along x"), "{said}");
    let open = block([4, 4, 4], 2, |_, _, _| false);
    assert!(permeability(&open, 2, Boundary::Open).is_err());
}

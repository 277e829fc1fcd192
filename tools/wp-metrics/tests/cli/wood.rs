//! Permeability and pores of wood, and islands left out of slices.

use crate::workbench::{number, rows};
use crate::{DIMS, VOXEL, bench};

/// The gap of six voxels is a slit across x and z, with less friction where grooves of one voxel every four open into it; they
/// add to it along z.
#[test]
fn permeability_is_that_of_the_gap_and_the_grooves() {
    let bench = bench();
    let squares = VOXEL * VOXEL;
    let gap = 6_f64.powi(3) / 12.0 / 60.0;
    // Nine grooves, and half of one of two voxels at the mirror.
    let grooves = (9.0 / 12.0 + 0.5 * 8.0 / 12.0) / 40.0 * 54.0 / 60.0;
    for (axis, expected) in [("x", gap), ("z", gap + grooves)] {
        let table = bench
            .run(&format!("specimen.mpts --permeability {axis}"))
            .output();
        assert!(table.starts_with("file,axis,permeability_m2,error_m2,porosity,through\n"));
        let found = &rows(&table)[0];
        let off = number(&found[2]) / (expected * squares) - 1.0;
        assert_eq!(found[1], axis);
        assert!((0.0..0.2).contains(&off), "{axis}: {off}");
        assert!(number(&found[3]) < 0.1 * number(&found[2]), "{found:?}");
    }
    // Ten grooves between periodic sides, and next to no resistance in the gap.
    let across = bench
        .run("specimen.mpts --permeability y --periodic")
        .output();
    let along = number(&rows(&across)[0][2]);
    let expected = 10.0 / 12.0 / 40.0 * 60.0 / 54.0;
    assert!((along / squares / expected - 1.0).abs() < 0.02, "{along}");
}

/// The gap is a slit of six voxels; grooves of one open into it.
#[test]
fn pores_are_those_of_the_gap_and_the_grooves() {
    let table = bench().run("specimen.mpts specimen.mpts --pores").output();
    assert!(table.starts_with("file,diameter_um,volume_fraction,up_to_fraction\n"));
    let found = rows(&table);
    let (one, other) = found.split_at(found.len() / 2);
    assert_eq!(one, other);
    assert_eq!(one[0][0], "specimen.mpts");
    let all: f64 = one.iter().map(|row| number(&row[2])).sum();
    assert!((all - 1.0).abs() < 1e-5, "{all}");
    let [gap, grooves] = [6.0, 54.0 / 4.0];
    let widest = one.last().unwrap();
    let share = number(&widest[2]);
    assert!((share - gap / (gap + grooves)).abs() < 1e-5, "{share}");
    assert!((number(&widest[1]) - 6.5 * 1.45).abs() < 1e-9);
}

#[test]
fn islands_of_a_slice_are_left_out() {
    let bench = bench();
    let least = |least| bench.run(&format!("specimen.mpts --ignore-islands {least}"));
    let [nx, _, nz] = DIMS;
    let all = nz * (6 * nx + 14 * nx / 4);
    // The slices are of 380 pixels each.
    for kept in [0, 380] {
        assert_eq!(number(&rows(&least(kept).output())[2][10]), all as f64);
    }
    least(381).refused(3, "");
}

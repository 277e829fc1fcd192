//! Permeability and pores of wood, and islands left out of slices.

use tempfile::TempDir;

use crate::{DIMS, VOXEL, number, rows, specimen, state, text, tool};

/// The gap of six voxels is a slit across x and z, with less friction where grooves of one voxel every four open into it; they
/// add to it along z.
#[test]
fn permeability_is_that_of_the_gap_and_the_grooves() {
    let folder = TempDir::new().unwrap();
    let path = specimen(folder.path());
    let path = path.to_str().unwrap();
    let squares = VOXEL * VOXEL;
    let gap = 6_f64.powi(3) / 12.0 / 60.0;
    // Nine grooves, and half of one of two voxels at the mirror.
    let grooves = (9.0 / 12.0 + 0.5 * 8.0 / 12.0) / 40.0 * 54.0 / 60.0;
    for (axis, expected) in [("x", gap), ("z", gap + grooves)] {
        let run = tool(&[path, "--permeability", axis]);
        assert!(run.status.success(), "{}", text(&run.stderr));
        let table = text(&run.stdout);
        assert!(table.starts_with("file,axis,permeability_m2,error_m2,porosity,through\n"));
        let found = &rows(&table)[0];
        let off = number(&found[2]) / (expected * squares) - 1.0;
        assert!(
            found[1] == axis && (0.0..0.2).contains(&off),
            "{axis}: {off}"
        );
        assert!(number(&found[3]) < 0.1 * number(&found[2]), "{found:?}");
    }
    // Ten grooves between periodic sides, and next to no resistance in the gap.
    let across = tool(&[path, "--permeability", "y", "--periodic"]);
    let along = number(&rows(&text(&across.stdout))[0][2]);
    let expected = 10.0 / 12.0 / 40.0 * 60.0 / 54.0;
    assert!((along / squares / expected - 1.0).abs() < 0.02, "{along}");
}

/// The gap is a slit of six voxels; grooves of one open into it.
#[test]
fn pores_are_those_of_the_gap_and_the_grooves() {
    let folder = TempDir::new().unwrap();
    let path = specimen(folder.path());
    let path = path.to_str().unwrap();
    let run = tool(&[path, path, "--pores"]);
    assert!(run.status.success(), "{}", text(&run.stderr));
    let table = text(&run.stdout);
    assert!(table.starts_with("file,diameter_um,volume_fraction,up_to_fraction\n"));
    let found = rows(&table);
    let (one, other) = found.split_at(found.len() / 2);
    assert_eq!(one, other);
    assert_eq!(one[0][0], path);
    let share = |row: &Vec<String>| number(&row[2]);
    let all: f64 = one.iter().map(share).sum();
    assert!((all - 1.0).abs() < 1e-5, "{all}");
    let [gap, grooves] = [6.0, 54.0 / 4.0];
    let wide = share(one.last().unwrap());
    assert!((wide - gap / (gap + grooves)).abs() < 1e-5, "{wide}");
    assert!((number(&one.last().unwrap()[1]) - 6.5 * 1.45).abs() < 1e-9);
    let state = state(folder.path(), 2, |_| ());
    let refused = tool(&[state.to_str().unwrap(), "--pores"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(text(&refused.stderr).contains("adherends are parted"));
}

#[test]
fn islands_of_a_slice_are_left_out() {
    let folder = TempDir::new().unwrap();
    let path = specimen(folder.path());
    let path = path.to_str().unwrap();
    let voxels = |least: &str| {
        let run = tool(&[path, "--ignore-islands", least]);
        assert!(run.status.success(), "{}", text(&run.stderr));
        number(&rows(&text(&run.stdout))[2][10]) as usize
    };
    let [nx, _, nz] = DIMS;
    let all = nz * (6 * nx + 14 * nx / 4);
    assert_eq!([voxels("0"), voxels("380")], [all, all]);
    // The slices are of 380 pixels each.
    let none = tool(&[path, "--ignore-islands", "381"]);
    assert_eq!(none.status.code(), Some(3), "{}", text(&none.stderr));
    let state = state(folder.path(), 2, |_| ());
    let refused = tool(&[state.to_str().unwrap(), "--ignore-islands", "2"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(text(&refused.stderr).contains("no slices"));
    let flow = tool(&[state.to_str().unwrap(), "--permeability", "z"]);
    assert!(text(&flow.stderr).contains("adherends are parted"));
}

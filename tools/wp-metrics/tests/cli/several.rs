//! Several specimens: a folder of them, their mean and its scatter, and how their bonds are tilted.

use std::fs;

use crate::workbench::{Bench, number, rows};
use crate::{ENTERED, HEADER, specimen, state};

/// Two specimens in the folder `scans`, and what is none.
fn scans() -> Bench {
    let bench = crate::bench();
    fs::create_dir(bench.path("scans")).unwrap();
    specimen(&bench, "scans/specimen.mpts", crate::DIMS);
    specimen(&bench, "scans/narrower.mpts", [39, 58, 12]);
    bench.write("scans/notes.txt", "two specimens");
    bench
}

#[test]
fn a_folder_of_specimens_has_rows_of_each_and_a_summary() {
    let bench = scans();
    let table = bench.run("scans --summary mean.csv").output();
    // The rows stay what they are.
    assert_eq!(table, bench.run("scans").output());
    let found = rows(&table);
    assert!(found[0][0].ends_with("narrower.mpts") && found[3][0].ends_with("specimen.mpts"));
    let summary = bench.text("mean.csv");
    let header = "side,reference,files,wp_um,wp_sd_um,slab_wp_um,slab_wp_sd_um,ep_um,ep_sd_um";
    assert!(summary.starts_with(header), "{summary}");
    for (side, row) in rows(&summary).iter().enumerate() {
        assert_eq!(row[..3], [&found[side][1], "mid", "2"]);
        // wp, slab_wp, ep, max_depth, p99_depth, volume.
        for (i, column) in (4..10).enumerate() {
            let pair = [&found[side], &found[side + 3]].map(|row| number(&row[column]));
            let [mean, deviation] = [&row[3 + 2 * i], &row[4 + 2 * i]].map(|cell| number(cell));
            let half = 0.5 * (pair[0] - pair[1]).abs();
            assert!((mean - 0.5 * (pair[0] + pair[1])).abs() < 1e-4, "{row:?}");
            assert!((deviation - half * 2_f64.sqrt()).abs() < 1e-4, "{row:?}");
        }
    }
    assert!(bench.path("mean.csv.provenance.json").is_file());
    let one = bench.run("specimen.mpts --summary - -o /dev/null");
    one.refused(2, "several files");
}

/// Copies, states beside specimens, and specimens that were left out because of pictures beside them, which
/// were read as slices of a stack.
#[test]
fn values_without_a_mean_are_refused() {
    let bench = scans();
    let mean = |files: &str| bench.run(&format!("{files} -o /dev/null --summary -"));
    state(&bench, "state.mpts", 0, 0.0);
    let said = "'state.mpts' is a state of a run and 'specimen.mpts' a specimen";
    mean("specimen.mpts state.mpts").refused(2, said);
    bench.write("scans/the same.mpts", bench.read("scans/specimen.mpts"));
    let copied = mean("scans").refused(2, "the same.mpts' holds the same as");
    assert!(copied.stdout.is_empty());
    // Without a mean, two rows tell so.
    bench.run("scans").done();
    bench.write("scans/look.png", "a picture");
    bench
        .run("scans")
        .refused(2, "holds particle files and slices");
}

#[test]
fn a_fitted_plane_adds_columns_of_tilt() {
    let table = crate::bench().run("specimen.mpts --reference fit").output();
    let errors = "tilt_x_error_deg,tilt_y_error_deg,tilt_z_error_deg";
    let header = format!("{HEADER},tilt_x_deg,tilt_y_deg,tilt_z_deg,{errors}{ENTERED}");
    assert_eq!(table.lines().next(), Some(&*header));
    for row in rows(&table) {
        assert_eq!(row[11..17], ["0.0000"; 6]);
    }
}

//! Several specimens: a folder of them, their mean and its scatter, and how their bonds are tilted.

use std::fs;

use tempfile::TempDir;

use crate::{HEADER, number, rows, specimen, text, tool};

/// Two specimens in a folder, and what is none.
fn folder() -> TempDir {
    let folder = TempDir::new().unwrap();
    let own = specimen(folder.path());
    let narrower = crate::specimen_of(folder.path(), "narrower.mpts", [39, 58, 12]);
    assert!(own.is_file() && narrower.is_file());
    fs::write(folder.path().join("notes.txt"), "two specimens").unwrap();
    folder
}

#[test]
fn a_folder_of_specimens_has_rows_of_each_and_a_summary() {
    let folder = folder();
    let path = folder.path().to_str().unwrap();
    let summary = folder.path().join("mean.csv");
    let alone = tool(&[path]);
    let run = tool(&[path, "--summary", summary.to_str().unwrap()]);
    assert!(run.status.success(), "{}", text(&run.stderr));
    // The rows stay what they are.
    assert_eq!(text(&run.stdout), text(&alone.stdout));
    let found = rows(&text(&run.stdout));
    assert!(found[0][0].ends_with("narrower.mpts") && found[3][0].ends_with("specimen.mpts"));
    let table = fs::read_to_string(&summary).unwrap();
    assert!(
        table.starts_with("side,reference,files,wp_um,wp_sd_um,slab_wp_um,slab_wp_sd_um,ep_um")
    );
    for (side, row) in rows(&table).iter().enumerate() {
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
    assert!(summary.with_extension("csv.provenance.json").is_file());
    let one = folder.path().join("specimen.mpts");
    let refused = tool(&[one.to_str().unwrap(), "--summary", "-", "-o", "/dev/null"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(text(&refused.stderr).contains("several files"));
}

#[test]
fn a_copy_of_a_specimen_does_not_count_in_a_mean() {
    let folder = folder();
    let path = folder.path();
    fs::copy(path.join("specimen.mpts"), path.join("the same.mpts")).unwrap();
    let arguments = [path.to_str().unwrap(), "-o", "/dev/null", "--summary", "-"];
    let refused = tool(&arguments);
    let said = text(&refused.stderr);
    assert_eq!(refused.status.code(), Some(2), "{said}");
    assert!(said.contains("the same.mpts' holds the same as"), "{said}");
    assert!(refused.stdout.is_empty());
    // Without a mean, two rows tell so.
    assert!(tool(&arguments[..3]).status.success());
}

/// Pictures beside specimens were read as slices of a stack, and the specimens were left out.
#[test]
fn a_folder_of_specimens_and_slices_is_refused() {
    let folder = folder();
    fs::write(folder.path().join("look.png"), "a picture").unwrap();
    let refused = tool(&[folder.path().to_str().unwrap()]);
    let said = text(&refused.stderr);
    assert_eq!(refused.status.code(), Some(2), "{said}");
    assert!(said.contains("holds particle files and slices"), "{said}");
}

#[test]
fn a_fit_tells_its_tilt_behind_all_columns() {
    let folder = TempDir::new().unwrap();
    let path = specimen(folder.path());
    let run = tool(&[path.to_str().unwrap(), "--reference", "fit"]);
    assert!(run.status.success(), "{}", text(&run.stderr));
    let table = text(&run.stdout);
    let header = format!("{HEADER},tilt_x_deg,tilt_y_deg,tilt_z_deg");
    assert_eq!(table.lines().next(), Some(header.as_str()));
    for row in rows(&table) {
        assert_eq!(row[11..], ["0.0000", "0.0000", "0.0000"]);
    }
}

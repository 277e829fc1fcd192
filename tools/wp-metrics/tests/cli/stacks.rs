//! Image stacks measured as they are, without a particle file of them.

use std::fs;
use std::path::Path;

use tempfile::TempDir;

use crate::{DIMS, letter, number, rows, specimen, text, tool};

/// Raw volumes and proposed grey values were for xct2particles alone.
#[test]
fn raw_volumes_and_proposed_grey_values() {
    let folder = TempDir::new().unwrap();
    let grey = |letter| match letter {
        ' ' => 10_000_u16,
        'w' => 18_000,
        _ => 26_000,
    };
    let [nx, ny, nz] = DIMS;
    let voxels = (0..nx * ny * nz).map(|i| grey(letter(i % nx, i / nx % ny)));
    let bytes: Vec<u8> = voxels.flat_map(u16::to_le_bytes).collect();
    let raw = folder.path().join("a.raw");
    fs::write(&raw, bytes).unwrap();
    let raw = raw.to_str().unwrap();
    let own = specimen(folder.path());
    let expected = rows(&text(&tool(&[own.to_str().unwrap()]).stdout));
    let size = ["--dims", "40x60x16", "--type", "u16", "--voxel", "1.45 um"];
    for values in [
        ["--grey", "auto"],
        ["--grey", "wood=18000..18000,adhesive=26000.."],
        ["--labels", "void=10000,wood=18000,adhesive=26000"],
    ] {
        let run = tool(&[&[raw], &size[..], &values].concat());
        assert!(run.status.success(), "{}", text(&run.stderr));
        let said = text(&run.stderr);
        assert_eq!(
            said.contains("grey values taken as wood="),
            values[1] == "auto",
            "{said}"
        );
        let found = rows(&text(&run.stdout));
        assert!(
            found.iter().zip(&expected).all(|(a, b)| a[1..] == b[1..]),
            "{found:?}"
        );
    }
    // A particle file beside them is told by itself.
    let both = tool(&[&[raw, own.to_str().unwrap(), "--grey", "auto"], &size[..]].concat());
    assert_eq!(rows(&text(&both.stdout)).len(), 6, "{}", text(&both.stderr));
    let short = tool(&[raw, "--dims", "40x60x15", "--type", "u16"]);
    assert_eq!(short.status.code(), Some(2), "{}", text(&short.stderr));
}

/// `bondline-acer-240.json` beside the stack, computed by its authors with NumPy. `make test` runs this
/// test where the shared data are present.
#[test]
#[ignore = "needs the shared volumes, which are not in the repository"]
fn shared_data_gives_the_reference_numbers() {
    let stack =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/bondline-acer-240.tif");
    let run = tool(&[stack.to_str().unwrap(), "--voxel", "1.45 um"]);
    assert!(run.status.success(), "{}", text(&run.stderr));
    let found = rows(&text(&run.stdout));
    for (row, [wp, ep, deepest, voxels]) in found.iter().zip([
        [17.5810, 20.6259, 215.325, 819_346.0],
        [16.7128, 20.0407, 225.475, 796_100.0],
        [17.1586, 40.6666, 225.475, 1_615_446.0],
    ]) {
        assert!((number(&row[3]) - 226.2e-6).abs() < 1e-12, "{row:?}");
        assert!((number(&row[4]) - wp).abs() < 5e-5, "{row:?}");
        assert!((number(&row[5]) - 40.666_609 / 12_f64.sqrt()).abs() < 1e-5);
        assert!((number(&row[6]) - ep).abs() < 5e-5, "{row:?}");
        assert!((number(&row[7]) - deepest).abs() < 1e-6, "{row:?}");
        assert_eq!(number(&row[10]), voxels);
    }
}

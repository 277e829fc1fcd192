//! Which stored values are labels or grey values.

mod common;

use common::*;
use voxels::Phases;

/// The test volume as floats with `value` at column 5, row 3 of page 2.
fn floats(value: f32) -> Vec<u8> {
    let [nx, ny, nz] = DIMS;
    let mut values: Vec<f32> = pages(|l| [l]).concat().into_iter().map(f32::from).collect();
    values[nx * ny + 3 * nx + 5] = value;
    let head = format!(
        "NDims = 3\nDimSize = {nx} {ny} {nz}\nElementType = MET_FLOAT\nElementDataFile = LOCAL\n"
    );
    let data = values.into_iter().flat_map(f32::to_le_bytes);
    head.into_bytes().into_iter().chain(data).collect()
}

/// Stored floats that are no labels, or no numbers, are named with their place.
#[test]
fn floats_that_are_no_labels_are_refused_by_their_voxel() {
    let said = |value: f32, phases: &Phases| {
        let (_folder, path) = stored("a.mha", &floats(value));
        segmented(&[path], phases).unwrap_err().to_string()
    };
    let labels = Phases::Labels("void=0,wood=1,adhesive=2".parse().unwrap());
    for value in [0.1, f32::NAN, f32::INFINITY, 1.000_000_1] {
        for phases in [&labels, &Phases::Guess] {
            let said = said(value, phases);
            for part in [
                "page 2: ",
                "column 5, row 3 holds",
                "labels are whole numbers",
            ] {
                assert!(said.contains(part), "{value}: {said}");
            }
        }
    }
    let grey = Phases::Grey("wood=0.5..1.5,adhesive=1.6..".parse().unwrap());
    for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let said = said(value, &grey);
        assert!(
            said.contains("column 5, row 3 holds") && said.contains("--crop"),
            "{said}"
        );
    }
}

#[test]
fn grey_values_become_phases_by_range() {
    let (_folder, path) = stored("a.tif", &tiff(CLASSIC, &plain_pages()));
    let grey = Phases::Grey("wood=1..1.5,adhesive=1.6..".parse().unwrap());
    let found = segmented(&[path], &grey).unwrap();
    let labels = |wanted| {
        (0..DIMS[2])
            .flat_map(|z| page(z, |l| l))
            .filter(|l| *l == wanted)
            .count() as u64
    };
    assert_eq!(
        [found.wood.count(), found.adhesive.count()],
        [labels(1), labels(2)]
    );
}

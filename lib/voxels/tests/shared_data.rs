//! The design's collection of TIFF variants of one volume, where it is at hand.

#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "prints for developers"
)]

use std::path::{Path, PathBuf};

use voxels::{Crop, Labels, Phases, Segmented, Stack, segment};

fn collection() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/tiff");
    if !folder.is_dir() {
        println!("skipped: {} is not there", folder.display());
        return None;
    }
    Some(folder)
}

fn read(path: &Path, labels: &str) -> Result<Segmented, voxels::Error> {
    let stack = Stack::open(&[path.to_owned()])?;
    let labels: Labels = labels.parse().unwrap();
    segment(
        &stack,
        &Phases::Labels(labels),
        &Crop::whole(stack.dims()),
        || {},
    )
}

#[test]
fn every_variant_gives_the_expected_labels() {
    let Some(folder) = collection() else { return };
    let plain = "void=0,wood=1,adhesive=2";
    let expected = read(&folder.join("expected_zyx_u8.npy"), plain).unwrap();
    let sum = expected.wood.count() + 2 * expected.adhesive.count();
    assert_eq!(sum, 314_984);
    let mut variants = 0;
    let mut damaged = 0;
    for entry in std::fs::read_dir(&folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        if name.starts_with('z') {
            let sentence = read(&path, plain).unwrap_err().to_string();
            println!("{sentence}");
            assert!(
                sentence.contains(&name) && sentence.contains("page"),
                "{sentence}"
            );
            damaged += 1;
        } else if name.starts_with('a') {
            // One bit cannot hold three labels: it says wood or not.
            let bilevel = name.contains("1bit");
            let labels = match () {
                () if bilevel => "void=0,wood=1,adhesive=7",
                () if name.contains("rgb") => "void=0:0:0,wood=234:156:0,adhesive=0:78:255",
                () => plain,
            };
            let found = read(&path, labels).unwrap_or_else(|e| panic!("{e}"));
            assert_eq!(found.wood, expected.wood, "{name}");
            assert!(bilevel || found.adhesive == expected.adhesive, "{name}");
            variants += 1;
        }
    }
    println!("{variants} variants read, {damaged} refused");
    assert!(variants > 0 && damaged > 0);
}

#[test]
fn voxel_sizes_are_found_where_they_are_stated() {
    let Some(folder) = collection() else { return };
    for (name, stated) in [
        ("a01_multipage_u8_none.tif", None),
        ("a17_imagej_single_ifd_truncated.tif", Some(1.45e-6)),
        ("a25.ome.tif", Some(1.45e-6)),
    ] {
        let stack = Stack::open(&[folder.join(name)]).unwrap();
        let edge = stack.voxel_size().map(|size| size.cube_edge().unwrap());
        assert_eq!(edge.is_some(), stated.is_some(), "{name}");
        if let (Some(edge), Some(stated)) = (edge, stated) {
            let relative: f64 = edge / stated - 1.0;
            assert!(relative.abs() < 1e-12, "{name}: {edge}");
        }
    }
}

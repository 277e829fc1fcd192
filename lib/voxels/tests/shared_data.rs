//! A collection of TIFF variants of one volume, which is not in the repository: `make test` runs these
//! tests where the folder is present.

#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "prints for developers"
)]

use std::path::{Path, PathBuf};

use voxels::{Crop, Error, Phases, Segmented, Stack, segment};

fn collection() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data/tiff")
}

fn read(path: &Path, labels: &str) -> Result<Segmented, Error> {
    let stack = Stack::open(&[path.to_owned()])?;
    let phases = Phases::Labels(labels.parse().unwrap());
    segment(&stack, &phases, &Crop::whole(stack.dims()), || {})
}

#[test]
#[ignore = "needs the shared volumes, which are not in the repository"]
fn shared_data_variants_give_the_expected_labels() {
    let folder = collection();
    let plain = "void=0,wood=1,adhesive=2";
    let expected = read(&folder.join("expected_zyx_u8.npy"), plain).unwrap();
    let sum = expected.wood.count() + 2 * expected.adhesive.count();
    assert_eq!(sum, 314_984);
    let [mut variants, mut damaged] = [0, 0];
    for entry in std::fs::read_dir(&folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        // One bit cannot hold three labels: it says wood or not.
        let bilevel = name.contains("1bit");
        let labels = match () {
            () if bilevel => "void=0,wood=1,adhesive=7",
            () if name.contains("rgb") => "void=0:0:0,wood=234:156:0,adhesive=0:78:255",
            () => plain,
        };
        if name.starts_with('z') {
            let sentence = read(&path, plain).unwrap_err().to_string();
            println!("{sentence}");
            let named = sentence.contains(&name) && sentence.contains("page");
            assert!(named, "{sentence}");
            damaged += 1;
        } else if name.starts_with('a') {
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
#[ignore = "needs the shared volumes, which are not in the repository"]
fn shared_data_states_its_voxel_sizes() {
    for (name, stated) in [
        ("a01_multipage_u8_none.tif", None),
        ("a17_imagej_single_ifd_truncated.tif", Some(1450.0)),
        ("a25.ome.tif", Some(1450.0)),
    ] {
        let stack = Stack::open(&[collection().join(name)]).unwrap();
        let edge = stack.voxel_size().map(|size| size.cube_edge().unwrap());
        let nanometres = edge.map(|edge| (edge * 1e15).round() / 1e6);
        assert_eq!(nanometres, stated, "{name}");
    }
}

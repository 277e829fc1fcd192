//! Folders of slices, NumPy arrays and MetaImages give the same volume as a TIFF.

mod common;

use std::fs;
use std::path::PathBuf;

use common::*;
use voxels::{Stack, VoxelEdge};

fn slices(names: impl Fn(usize) -> String) -> (tempfile::TempDir, Vec<PathBuf>) {
    let folder = tempfile::tempdir().unwrap();
    let paths = plain_pages()
        .into_iter()
        .enumerate()
        .map(|(z, page)| {
            let path = folder.path().join(names(z));
            fs::write(&path, tiff(CLASSIC, &[page])).unwrap();
            path
        })
        .collect();
    (folder, paths)
}

#[test]
fn slices_are_taken_in_natural_order() {
    // 8, 9, 10, 11: unpadded numbers with a space, endings in both cases.
    let name = |z: usize| format!("scan slice {}.{}", z + 8, ["tif", "TIF", "tiff", "TIFF"][z]);
    let (folder, mut paths) = slices(name);
    fs::write(folder.path().join("notes.txt"), "not a slice").unwrap();
    assert_test_volume("folder", folder.path(), ["0", "1", "2"]);
    paths.reverse();
    let stack = Stack::open(&paths).unwrap();
    assert_eq!(stack.dims(), DIMS);
    let mut read = Vec::new();
    for z in 0..DIMS[2] {
        stack.read_page(z, &mut read).unwrap();
        assert_eq!(read, page(z, |l| l));
    }
}

#[test]
fn slices_that_do_not_belong_together_are_refused() {
    let (folder, _) = slices(|z| format!("{z}.tif"));
    let open = || {
        Stack::open(&[folder.path().to_owned()])
            .unwrap_err()
            .to_string()
    };
    fs::write(folder.path().join("7.tif"), tiff(CLASSIC, &plain_pages())).unwrap();
    assert!(open().contains("7.tif': it holds 4 pages"), "{}", open());
    let odd = tiff(CLASSIC, &[Page::new(3, 2, 8, vec![0; 6])]);
    fs::write(folder.path().join("7.tif"), odd).unwrap();
    assert!(open().contains("7.tif', page 5: it is 3 x 2"), "{}", open());
    let missing = Stack::open(&[folder.path().join("none.tif")]).unwrap_err();
    assert!(missing.to_string().contains("none.tif"), "{missing}");
}

#[test]
fn slices_that_contradict_one_another_state_no_voxel_size() {
    let (_folder, paths) = slices(|z| format!("{z}.tif"));
    let stated = |changes: [Option<u32>; 2]| {
        for (path, micrometres) in paths.iter().zip(changes) {
            let page = plain_pages().remove(0).short(296, 3);
            let page = match micrometres {
                None => page,
                Some(n) => {
                    (page.tag(282, Value::Rational(10_000, n))).tag(283, Value::Rational(10_000, n))
                }
            };
            fs::write(path, tiff(CLASSIC, &[page])).unwrap();
        }
        let stack = Stack::open(&paths[..2]).unwrap();
        stack.voxel_size().map(|size| size.cube_edge().unwrap())
    };
    let close = |edge: Option<f64>| (edge.unwrap() / 2e-6 - 1.0).abs() < 1e-9;
    assert!(close(stated([Some(2), Some(2)])) && close(stated([Some(2), None])));
    assert_eq!(stated([Some(2), Some(3)]), None);
}

/// A `.npy` file as `numpy.save` writes it.
fn npy(version: u8, descr: &str, fortran: bool, shape: &str, data: &[u8]) -> Vec<u8> {
    let order = if fortran { "True" } else { "False" };
    let mut header =
        format!("{{'descr': '{descr}', 'fortran_order': {order}, 'shape': ({shape}), }}");
    while (header.len() + 11) % 64 != 0 {
        header.push(' ');
    }
    header.push('\n');
    let mut bytes = b"\x93NUMPY".to_vec();
    bytes.extend([version, 0]);
    let length = (header.len() as u32).to_le_bytes();
    bytes.extend(&length[..if version == 1 { 2 } else { 4 }]);
    bytes.extend(header.as_bytes());
    bytes.extend(data);
    bytes
}

#[test]
fn arrays_of_every_type_and_order() {
    let [nx, ny, nz] = DIMS;
    let shape = format!("{nz}, {ny}, {nx}");
    let case = |descr: &str, fortran: bool, data: Vec<u8>, labels| {
        let (_folder, path) = stored("a.npy", &npy(1, descr, fortran, &shape, &data));
        assert_test_volume(descr, &path, labels);
    };
    case("|u1", false, pages(|l| [l]).concat(), ["0", "1", "2"]);
    case(
        "<i2",
        false,
        pages(|l| (i16::from(l) * -7).to_le_bytes()).concat(),
        ["0", "-7", "-14"],
    );
    case(
        ">u4",
        false,
        pages(|l| (u32::from(l) << 20).to_be_bytes()).concat(),
        ["0", "1048576", "2097152"],
    );
    case(
        "<i8",
        false,
        pages(|l| i64::from(l).to_le_bytes()).concat(),
        ["0", "1", "2"],
    );
    case(
        "<f4",
        false,
        pages(|l| f32::from(l).to_le_bytes()).concat(),
        ["0", "1", "2"],
    );
    // z fastest, then y.
    let fortran: Vec<u8> = (0..nx * ny * nz)
        .map(|i| label(i / (nz * ny), i / nz % ny, i % nz))
        .collect();
    case("|u1", true, fortran.clone(), ["0", "1", "2"]);
    let doubles = fortran
        .iter()
        .flat_map(|l| f64::from(*l).to_le_bytes())
        .collect();
    case("<f8", true, doubles, ["0", "1", "2"]);
    let (_folder, path) = stored(
        "a.npy",
        &npy(2, "|u1", false, &shape, &pages(|l| [l]).concat()),
    );
    assert_test_volume("version 2", &path, ["0", "1", "2"]);
}

#[test]
fn damaged_arrays_are_refused() {
    let [nx, ny, nz] = DIMS;
    let data = pages(|l| [l]).concat();
    let good = npy(1, "|u1", false, &format!("{nz}, {ny}, {nx}"), &data);
    for length in (0..good.len()).step_by(11) {
        refusal("a.npy", &good[..length]);
    }
    for shape in [
        "99999999999, 99999999999, 99999999999",
        "5, 13, 21",
        "0, 13, 21",
    ] {
        for fortran in [false, true] {
            refusal("a.npy", &npy(1, "|u1", fortran, shape, &data));
        }
    }
}

#[test]
fn meta_images_beside_and_behind_their_header() {
    let [nx, ny, nz] = DIMS;
    let header = |kind: &str, more: &str, file: &str| {
        format!(
            "ObjectType = Image\nNDims = 3\nDimSize = {nx} {ny} {nz}\nElementType = {kind}\n{more}ElementDataFile = {file}\n"
        )
    };
    let raw: Vec<u8> = pages(|l| (u16::from(l) * 300).to_be_bytes()).concat();
    let spaced =
        "ElementByteOrderMSB = True\nElementSpacing = 1.45 1.45 1.45\nDistanceUnits = um\n";
    let (folder, path) = stored("a.mhd", header("MET_USHORT", spaced, "a.raw").as_bytes());
    fs::write(folder.path().join("a.raw"), &raw).unwrap();
    assert_test_volume("beside", &path, ["0", "300", "600"]);
    let edge = Stack::open(&[path])
        .unwrap()
        .voxel_size()
        .unwrap()
        .cube_edge();
    assert!((edge.unwrap() - 1.45e-6).abs() < 1e-18);

    let mut behind = header("MET_UCHAR", "", "LOCAL").into_bytes();
    behind.extend(pages(|l| [l]).concat());
    let (_folder, path) = stored("a.mha", &behind);
    assert_test_volume("behind", &path, ["0", "1", "2"]);
    assert!(Stack::open(&[path]).unwrap().voxel_size().is_none());

    for (bad, said) in [
        (header("MET_USHORT", "", "none.raw"), "none.raw"),
        (header("MET_LONG_DOUBLE", "", "a.raw"), "line 4"),
        (
            header("MET_UCHAR", "CompressedData = True\n", "LOCAL"),
            "0 compressed bytes are stored",
        ),
        (header("MET_UCHAR", "HeaderSize = -2\n", "a.raw"), "line 5"),
        (
            header("MET_UCHAR", "BinaryData = False\n", "LOCAL") + "1 2 x" + &" 1".repeat(1100),
            "'x', which is not",
        ),
        (
            header("MET_UCHAR", "BinaryData = False\n", "LOCAL") + "1 256" + &" 1".repeat(1100),
            "'256', which is not",
        ),
        (
            header("MET_UCHAR", "BinaryData = 0\n", "LOCAL") + &"1 ".repeat(700),
            "700 numbers",
        ),
        (header("MET_UCHAR", "", "a%03d.raw 0 4 1"), "a000.raw"),
        (header("MET_UCHAR", "", "a%s 0 4 1"), "no pattern"),
        (header("MET_UCHAR", "", "LIST"), "no names below"),
        (header("MET_UCHAR", "", "LOCAL"), "truncated"),
        ("NDims = 3\n".into(), "ElementDataFile"),
    ] {
        let sentence = refusal("a.mhd", bad.as_bytes());
        assert!(sentence.contains(said), "{sentence}");
    }
}

/// A header could name any file that its reader can read, and a device fills memory or disk.
#[test]
fn a_meta_image_reads_nothing_outside_its_folder() {
    let [nx, ny, nz] = DIMS;
    let folder = tempfile::tempdir().unwrap();
    let inside = |name: &str| folder.path().join(name);
    fs::create_dir_all(inside("own/deeper")).unwrap();
    let raw = pages(|l| [l]).concat();
    for name in ["secret.raw", "own/deeper/a.raw"] {
        fs::write(inside(name), &raw).unwrap();
    }
    std::os::unix::fs::symlink(inside("secret.raw"), inside("own/link.raw")).unwrap();
    std::os::unix::fs::symlink("deeper/a.raw", inside("own/fine.raw")).unwrap();
    let opened = |file: &str| {
        let header = format!(
            "NDims = 3\nDimSize = {nx} {ny} {nz}\nElementType = MET_UCHAR\nElementDataFile = {file}\n"
        );
        fs::write(inside("own/a.mhd"), header).unwrap();
        Stack::open(&[inside("own/a.mhd")]).map_err(|e| e.to_string())
    };
    for good in ["deeper/a.raw", "./deeper/a.raw", "fine.raw"] {
        assert_eq!(opened(good).unwrap().dims(), DIMS);
    }
    let absolute = inside("own/deeper/a.raw").display().to_string();
    for (bad, said) in [
        ("../secret.raw", "has '..' in it"),
        (&absolute, "absolute path"),
        ("/dev/zero", "absolute path"),
        ("link.raw", "a link that leaves the folder"),
        ("deeper", "no regular file"),
    ] {
        let sentence = opened(bad).unwrap_err();
        assert!(sentence.contains(said), "{bad}: {sentence}");
        assert!(sentence.contains("header's own folder"), "{sentence}");
    }
}

/// They became the size of a voxel, or of none.
#[test]
fn spacings_that_no_voxel_has_are_refused() {
    let header = |spacing: &str, units: &str| {
        format!(
            "NDims = 3\nDimSize = 1 1 1\nElementType = MET_UCHAR\nElementSpacing = {spacing}\n{units}ElementDataFile = LOCAL\n0"
        )
    };
    for spacing in [
        "1e300 1e300 1e300",
        "0 1 1",
        "-1 -1 -1",
        "nan 1 1",
        "1 1",
        "1 1 x",
    ] {
        for units in ["", "DistanceUnits = um\n"] {
            let sentence = refusal("a.mhd", header(spacing, units).as_bytes());
            assert!(sentence.contains("line 4 of its header"), "{sentence}");
        }
    }
    let (_folder, path) = stored(
        "a.mhd",
        header("1e12 1e12 1e12", "DistanceUnits = m\n").as_bytes(),
    );
    let stack = Stack::open(&[path]).unwrap();
    let said = VoxelEdge::resolve(None, stack.voxel_size(), "a.mhd").unwrap_err();
    assert!(said.to_string().contains("a voxel is 1e12 m"), "{said}");
}

#[test]
fn a_stack_beyond_the_limits_is_refused() {
    let long = npy(1, "|u1", false, "100001, 1, 1", &[0; 100_001]);
    let sentence = refusal("a.npy", &long);
    assert!(
        sentence.contains("more than 100000 along an axis"),
        "{sentence}"
    );
}

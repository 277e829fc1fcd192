//! Every number type and unit that a MetaImage may state, and what a stack says about itself.

mod common;

use common::*;
use voxels::Stack;

/// A header for data behind it.
fn meta_image(kind: &str, more: &str, data: &[u8]) -> Vec<u8> {
    let [nx, ny, nz] = DIMS;
    let header = format!(
        "NDims = 3\nDimSize = {nx} {ny} {nz}\nElementType = {kind}\n{more}ElementDataFile = LOCAL\n"
    );
    [header.as_bytes(), data].concat()
}

#[test]
fn elements_of_every_type() {
    let check = |kind: &str, says: &str, data: Vec<u8>, labels| {
        let (_folder, path) = stored("a.mha", &meta_image(kind, "", &data));
        assert_test_volume(kind, &path, labels);
        let stack = Stack::open(&[path]).unwrap();
        assert_eq!(stack.format().to_string(), format!("21 x 13, {says}"));
    };
    let plain = ["0", "1", "2"];
    let signed = ["0", "-7", "-14"];
    let seven = |l: u8| -7 * i32::from(l);
    check(
        "MET_UCHAR",
        "unsigned 8 bits",
        pages(|l| [l]).concat(),
        plain,
    );
    let bytes = pages(|l| (seven(l) as i8).to_le_bytes()).concat();
    check("MET_CHAR", "signed 8 bits", bytes, signed);
    let bytes = pages(|l| u16::from(l).to_le_bytes()).concat();
    check("MET_USHORT", "unsigned 16 bits", bytes, plain);
    let bytes = pages(|l| (seven(l) as i16).to_le_bytes()).concat();
    check("MET_SHORT", "signed 16 bits", bytes, signed);
    let bytes = pages(|l| (u32::from(l) << 20).to_le_bytes()).concat();
    check(
        "MET_UINT",
        "unsigned 32 bits",
        bytes,
        ["0", "1048576", "2097152"],
    );
    let bytes = pages(|l| seven(l).to_le_bytes()).concat();
    check("MET_INT", "signed 32 bits", bytes, signed);
    let bytes = pages(|l| f32::from(l).to_le_bytes()).concat();
    check("MET_FLOAT", "32-bit float", bytes, plain);
    let bytes = pages(|l| f64::from(seven(l)).to_le_bytes()).concat();
    check("MET_DOUBLE", "64-bit float", bytes, signed);
    let bytes = pages(|l| seven(l).to_le_bytes()).concat();
    check("MET_LONG", "signed 32 bits", bytes, signed);
    let bytes = pages(|l| i64::from(seven(l)).to_le_bytes()).concat();
    check("MET_LONG_LONG", "signed 64 bits", bytes, signed);
    let bytes = pages(|l| u64::from(l).to_le_bytes()).concat();
    check("MET_ULONG_LONG", "unsigned 64 bits", bytes, plain);
}

#[test]
fn spacings_in_every_unit() {
    for (unit, metres) in [
        ("um", 1e-6),
        ("micron", 1e-6),
        ("nm", 1e-9),
        ("nanometre", 1e-9),
        ("mm", 1e-3),
        ("millimeter", 1e-3),
        ("cm", 1e-2),
        ("centimetre", 1e-2),
        ("inch", 25.4e-3),
        ("in", 25.4e-3),
        ("m", 1.0),
        ("meter", 1.0),
    ] {
        let spaced = format!("ElementSpacing = 0.5 0.5 0.5\nDistanceUnits = {unit}\n");
        let data = pages(|l| [l]).concat();
        let (_folder, path) = stored("a.mha", &meta_image("MET_UCHAR", &spaced, &data));
        let stack = Stack::open(&[path]).unwrap();
        let size = stack.voxel_size().unwrap();
        let edge = size.cube_edge().unwrap();
        assert!(
            (edge / (0.5 * metres) - 1.0).abs() < 1e-12,
            "{unit}: {edge} m"
        );
        assert!(size.states_spacing() && size.from() == "MetaImage spacing");
    }
    let unknown = "ElementSpacing = 1 1 1\nDistanceUnits = pixel\n";
    let data = pages(|l| [l]).concat();
    let (_folder, path) = stored("a.mha", &meta_image("MET_UCHAR", unknown, &data));
    assert!(Stack::open(&[path]).unwrap().voxel_size().is_none());
}

#[test]
fn a_stack_is_called_by_its_path_and_says_its_colours() {
    let data = pages(|l| [l, 0, l]).concat();
    let colours = meta_image("MET_UCHAR", "ElementNumberOfChannels = 3\n", &data);
    let (_folder, path) = stored("colours.mha", &colours);
    let stack = Stack::open(std::slice::from_ref(&path)).unwrap();
    assert_eq!(stack.name(), format!("'{}'", path.display()));
    assert_eq!(stack.format().to_string(), "21 x 13, unsigned 8 bits x 3");

    // A resolution of 1000 pixels a centimetre, and no distance of the pages.
    let page = |page: Page| {
        (page.short(296, 3))
            .tag(282, Value::Rational(1000, 1))
            .tag(283, Value::Rational(1000, 1))
    };
    let pages: Vec<Page> = plain_pages().into_iter().map(page).collect();
    let (_folder, path) = stored("a.tif", &tiff(CLASSIC, &pages));
    let stack = Stack::open(&[path]).unwrap();
    let size = stack.voxel_size().unwrap();
    assert!((size.cube_edge().unwrap() - 1e-5).abs() < 1e-17 && !size.states_spacing());
}

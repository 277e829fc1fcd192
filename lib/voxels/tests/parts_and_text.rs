//! Volumes as text, compressed, in many files and at the end of their file.

mod common;

use std::fs;
use std::io::Write;
use std::path::Path;

use common::*;
use voxels::Stack;

const PLAIN: [&str; 3] = ["0", "1", "2"];

fn bzip2(bytes: &[u8]) -> Vec<u8> {
    let mut packed = bzip2::write::BzEncoder::new(Vec::new(), bzip2::Compression::default());
    packed.write_all(bytes).unwrap();
    packed.finish().unwrap()
}

fn mhd(more: &str, file: &str) -> String {
    let [nx, ny, nz] = DIMS;
    format!(
        "ObjectType = Image\nNDims = 3\nDimSize = {nx} {ny} {nz}\n{more}\nElementDataFile = {file}\n"
    )
}

fn nrrd(more: &str) -> String {
    let [nx, ny, nz] = DIMS;
    format!("NRRD0004\ndimension: 3\nsizes: {nx} {ny} {nz}\n{more}\n")
}

/// The volume as numbers, lines of a row each, `factor` times the labels.
fn text(factor: i32) -> String {
    let rows = pages(|l| [l]).concat();
    let row = |row: &[u8]| {
        let numbers = row.iter().map(|l| (factor * i32::from(*l)).to_string());
        numbers.collect::<Vec<_>>().join(" ")
    };
    rows.chunks(DIMS[0])
        .map(row)
        .collect::<Vec<_>>()
        .join(" \r\n")
}

#[test]
fn numbers_written_as_text() {
    let seven = ["0", "-7", "-14"];
    for (kind, factor, labels) in [
        ("MET_UCHAR", 1, PLAIN),
        ("MET_USHORT", 1, PLAIN),
        ("MET_SHORT", -7, seven),
        ("MET_LONG_LONG", -7, seven),
        ("MET_FLOAT", 1, PLAIN),
        ("MET_DOUBLE", -7, seven),
    ] {
        let more = format!("BinaryData = False\nElementByteOrderMSB = True\nElementType = {kind}");
        let (_folder, path) = stored("a.mha", (mhd(&more, "LOCAL") + &text(factor)).as_bytes());
        assert_test_volume(kind, &path, labels);
        let (folder, path) = stored("a.mhd", mhd(&more, "a.txt").as_bytes());
        fs::write(folder.path().join("a.txt"), text(factor)).unwrap();
        assert_test_volume(kind, &path, labels);
    }
    for (kind, factor, labels) in [
        ("uchar", 1, PLAIN),
        ("short", -7, seven),
        ("float", 1, PLAIN),
    ] {
        for name in ["ascii", "text", "txt"] {
            let head = nrrd(&format!("type: {kind}\nencoding: {name}\n"));
            let (_folder, path) = stored("a.nrrd", (head + &text(factor)).as_bytes());
            assert_test_volume(kind, &path, labels);
        }
    }
}

#[test]
fn pixels_by_bzip2() {
    let words = pages(|l| (300 * u16::from(l)).to_be_bytes()).concat();
    let head = nrrd("type: ushort\nendian: big\nencoding: bzip2\nbyte skip: 5\n");
    let whole = [head.as_bytes(), &bzip2(&[b"skips", &words[..]].concat())].concat();
    let (_folder, path) = stored("a.nrrd", &whole);
    assert_test_volume("bzip2", &path, ["0", "300", "600"]);
    let said = refusal("a.nrrd", &whole[..whole.len() - 30]);
    assert!(said.contains("compressed pixels cannot be read"), "{said}");
}

#[test]
fn pixels_at_the_end_of_their_file() {
    let raw = [b"a header of a camera", &pages(|l| [l]).concat()[..]].concat();
    let beside = |name: &str, head: String| {
        let (folder, path) = stored(name, head.as_bytes());
        fs::write(folder.path().join("a.raw"), &raw).unwrap();
        assert_test_volume(name, &path, PLAIN);
        fs::write(folder.path().join("a.raw"), &raw[30..]).unwrap();
        let said = Stack::open(&[path]).unwrap_err().to_string();
        assert!(said.contains("it is truncated"), "{said}");
    };
    beside(
        "a.mhd",
        mhd("ElementType = MET_UCHAR\nHeaderSize = -1", "a.raw"),
    );
    beside(
        "a.nhdr",
        nrrd("type: uchar\nencoding: raw\nbyte skip: -1\ndata file: a.raw"),
    );
}

/// Headers that name a file for each page, or for two pages.
#[test]
fn volumes_in_many_files() {
    let data = pages(|l| [l]);
    let written = |folder: &Path, names: [&str; 4]| {
        for (name, page) in names.iter().zip(&data) {
            fs::write(folder.join(name), page).unwrap();
        }
    };
    let names = ["p008.raw", "p010.raw", "p012.raw", "p014.raw"];
    let list = format!("LIST\n{}", names.join("\n"));
    let kind = "ElementType = MET_UCHAR";
    let nhdr = |file: &str| nrrd(&format!("type: uchar\nencoding: raw\ndata file: {file}"));
    for (name, head) in [
        ("a.mhd", mhd(kind, "p%03d.raw 8 14 2")),
        ("a.mhd", mhd(kind, &list)),
        ("a.nhdr", nhdr("p%03d.raw 8 14 2")),
        ("a.nhdr", nhdr(&list)),
    ] {
        let (folder, path) = stored(name, head.as_bytes());
        written(folder.path(), names);
        assert_test_volume(&head, &path, PLAIN);
        fs::write(folder.path().join(names[2]), &data[2][1..]).unwrap();
        let said = Stack::open(&[path]).unwrap_err().to_string();
        assert!(
            said.contains(names[2]) && said.contains("end after 272 of 273"),
            "{said}"
        );
    }
    let (folder, path) = stored("a.mhd", mhd(kind, "half %d.raw 1 2 1").as_bytes());
    let said = Stack::open(std::slice::from_ref(&path)).unwrap_err();
    assert!(said.to_string().contains("no pattern"), "{said}");
    fs::write(&path, mhd(kind, "half%d.raw 1 2 1")).unwrap();
    fs::write(folder.path().join("half1.raw"), data[..2].concat()).unwrap();
    fs::write(folder.path().join("half2.raw"), data[2..].concat()).unwrap();
    assert_test_volume("two pages a file", &path, PLAIN);
    fs::write(&path, mhd(kind, "LIST\nhalf1.raw\nhalf2.raw\nhalf1.raw")).unwrap();
    let said = Stack::open(&[path]).unwrap_err().to_string();
    assert!(said.contains("4 pages are in 3 files"), "{said}");
}

#[test]
fn meta_images_that_are_compressed() {
    let [nx, ny, nz] = DIMS;
    let header = |file: &str, size: usize| {
        format!(
            "NDims = 3\nDimSize = {nx} {ny} {nz}\nElementType = MET_UCHAR\nCompressedData = True\nCompressedDataSize = {size}\nElementDataFile = {file}\n"
        )
    };
    let packed = zlib(&pages(|l| [l]).concat());
    let behind = [header("LOCAL", packed.len()).as_bytes(), &packed].concat();
    let (_folder, path) = stored("a.mha", &behind);
    assert_test_volume("mha", &path, PLAIN);
    let (folder, path) = stored("a.mhd", header("a.zraw", packed.len()).as_bytes());
    fs::write(folder.path().join("a.zraw"), &packed).unwrap();
    assert_test_volume("mhd", &path, PLAIN);
    assert_eq!(Stack::open(&[path]).unwrap().sources().len(), 2);
    let cut = refusal("a.mha", &behind[..behind.len() - 40]);
    assert!(cut.contains("compressed pixels"), "{cut}");
    let bomb = header("LOCAL", 1).replace(&format!("{nx} {ny} {nz}"), "90000 90000 90000");
    let said = refusal("a.mha", &[bomb.as_bytes(), &packed].concat());
    assert!(said.contains("compressed bytes are stored"), "{said}");
}

//! Copies of one volume in every format are one volume; formats that are not read say what to do.

mod common;

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use common::*;
use flate2::Compression;
use flate2::write::GzEncoder;
use voxels::{Crop, Dims, Histogram, Phases, RawType, Stack, segment};

const PLAIN: [&str; 3] = ["0", "1", "2"];

fn volume() -> Vec<u8> {
    pages(|label| [label]).concat()
}

fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut packed = GzEncoder::new(Vec::new(), Compression::default());
    packed.write_all(bytes).unwrap();
    packed.finish().unwrap()
}

#[test]
fn raw_volumes_by_size_and_type() {
    let words: Vec<u8> = pages(|l| (300 * u16::from(l)).to_be_bytes()).concat();
    let (_folder, path) = stored("a.raw", &words);
    let dims: Dims = "21x13x4".parse().unwrap();
    let open = |dims, kind: &str| Stack::open_raw(&path, dims, kind.parse::<RawType>().unwrap());
    let stack = open(dims, "u16be").unwrap();
    let labels = Phases::Labels("void=0,wood=300,adhesive=600".parse().unwrap());
    let found = segment(&stack, &labels, &Crop::whole(DIMS), || {}).unwrap();
    let expected = volume().iter().filter(|l| **l == 1).count() as u64;
    assert_eq!(found.wood.count(), expected);
    for (dims, kind) in [
        ("21x13x4", "u8"),
        ("21x13x5", "u16"),
        ("1000000x1000000x1000000", "f64"),
    ] {
        let said = open(dims.parse().unwrap(), kind).unwrap_err().to_string();
        assert!(said.contains("check --dims and --type"), "{said}");
    }
}

fn nrrd(kind: &str, encoding: &str, more: &str) -> String {
    let [nx, ny, nz] = DIMS;
    format!(
        "NRRD0004\n# a comment\ntype: {kind}\ndimension: 3\nsizes: {nx} {ny} {nz}\nencoding: {encoding}\n{more}"
    )
}

#[test]
fn nrrd_raw_and_gzipped_behind_and_beside() {
    let size =
        "space directions: (1.45,0,0) (0,1.45,0) (0,0,1.45)\nspace units: \"um\" \"um\" \"um\"\n";
    let raw = [
        nrrd("uchar", "raw", &format!("{size}\n")).as_bytes(),
        &volume(),
    ]
    .concat();
    let (_folder, path) = stored("a.nrrd", &raw);
    assert_test_volume("raw", &path, PLAIN);
    let stack = Stack::open(&[path]).unwrap();
    let edge = stack.voxel_size().unwrap().cube_edge().unwrap();
    assert!((edge - 1.45e-6).abs() < 1e-15);
    let words = pages(|l| (300 * u16::from(l)).to_be_bytes()).concat();
    let head = nrrd("unsigned short", "gzip", "endian: big\n\n");
    let (_folder, path) = stored("a.nrrd", &[head.as_bytes(), &gzip(&words)].concat());
    assert_test_volume("gzip", &path, ["0", "300", "600"]);
    let mut damaged = gzip(&words);
    let sum = damaged.len() - 8;
    damaged[sum] ^= 1;
    let longer = gzip(&[&words[..], &[0]].concat());
    for (pixels, what) in [(damaged, "cannot be read"), (longer, "unpacks to more")] {
        let said = refusal("a.nrrd", &[head.as_bytes(), &pixels].concat());
        assert!(said.contains(what), "{said}");
    }
    let head = nrrd("uchar", "raw", "byte skip: 3\ndata file: a.raw\n");
    let (folder, path) = stored("a.nhdr", head.as_bytes());
    fs::write(
        folder.path().join("a.raw"),
        [b"abc", &volume()[..]].concat(),
    )
    .unwrap();
    assert_test_volume("beside", &path, PLAIN);
    for (more, said) in [
        ("data file: ../a.raw\n", "'..'"),
        ("data file: LIST\n", "no names below"),
        ("data file: LIST\n../a.raw\n", "'..'"),
        ("byte skip: -2\n\n", "byte skip"),
        ("line skip: 2\n\n", "skips lines"),
        ("nonsense\n\n", "KEY: VALUE"),
        ("\n", "truncated"),
    ] {
        let sentence = refusal("a.nrrd", nrrd("uchar", "raw", more).as_bytes());
        assert!(sentence.contains(said), "{sentence}");
    }
    for (kind, encoding, said) in [
        ("block", "raw", "type is 'block'"),
        ("uchar", "bzip2", "compressed bytes are stored"),
        ("uchar", "hex", "raw, gzip, bzip2 and ascii"),
        ("uchar", "ascii", "are stored: its size"),
        ("ushort", "raw", "endian"),
    ] {
        let sentence = refusal("a.nrrd", nrrd(kind, encoding, "\n").as_bytes());
        assert!(sentence.contains(said), "{sentence}");
    }
}

/// A header of NIfTI-1 or -2 for `kind`.
fn nifti(second: bool, kind: i16, more: impl Fn(&mut [u8])) -> Vec<u8> {
    let length: usize = if second { 540 } else { 348 };
    let mut head = vec![0; length + 4];
    head[..4].copy_from_slice(&(length as u32).to_le_bytes());
    let dims = [3, DIMS[0], DIMS[1], DIMS[2], 1, 1, 1, 1];
    let mut put = |at: usize, bytes: &[u8]| head[at..at + bytes.len()].copy_from_slice(bytes);
    for (i, n) in dims.into_iter().enumerate() {
        match second {
            true => put(16 + 8 * i, &(n as i64).to_le_bytes()),
            false => put(40 + 2 * i, &(n as i16).to_le_bytes()),
        }
    }
    for i in 1..4 {
        match second {
            true => put(104 + 8 * i, &1.45_f64.to_le_bytes()),
            false => put(76 + 4 * i, &1.45_f32.to_le_bytes()),
        }
    }
    match second {
        true => {
            put(4, b"n+2\0\r\n\x1a\n");
            put(12, &kind.to_le_bytes());
            put(168, &544_i64.to_le_bytes());
            put(500, &3_i32.to_le_bytes());
        }
        false => {
            put(344, b"n+1\0");
            put(70, &kind.to_le_bytes());
            put(108, &352_f32.to_le_bytes());
            put(123, &[3]);
        }
    }
    more(&mut head);
    head
}

#[test]
fn nifti_of_both_versions_plain_and_gzipped() {
    for second in [false, true] {
        let plain = [nifti(second, 2, |_| {}), volume()].concat();
        for (name, bytes) in [("a.nii", plain.clone()), ("a.nii.gz", gzip(&plain))] {
            let (_folder, path) = stored(name, &bytes);
            assert_test_volume(name, &path, PLAIN);
            let stack = Stack::open(&[path]).unwrap();
            let edge = stack.voxel_size().unwrap().cube_edge().unwrap();
            assert!((edge / 1.45e-6 - 1.0).abs() < 1e-6, "{edge}");
        }
        let cut = refusal("a.nii", &plain[..plain.len() - 1]);
        assert!(cut.contains("truncated"), "{cut}");
        let cut = refusal("a.nii.gz", &gzip(&plain[..plain.len() - 1]));
        assert!(cut.contains("compressed pixels"), "{cut}");
    }
    let floats = pages(|l| f32::from(l).to_le_bytes()).concat();
    let (_folder, path) = stored("a.nii", &[nifti(false, 16, |_| {}), floats].concat());
    assert_test_volume("floats", &path, PLAIN);
    for (kind, change, said) in [
        (32, (0, 0), "data type is 32"),
        (2, (40, 2), "three axes"),
        (2, (42, 255), "truncated"),
        (2, (345, b'i'), ".img"),
        (2, (110, 0), "inside its header"),
    ] {
        let head = nifti(false, kind, |h| {
            if change.0 > 0 {
                h[change.0] = change.1;
            }
        });
        let sentence = refusal("a.nii", &[head, volume()].concat());
        assert!(sentence.contains(said), "{sentence}");
    }
    let sentence = refusal("a.txt.gz", &gzip(b"some text"));
    assert!(sentence.contains("gunzip"), "{sentence}");
}

/// An archive of `.npy` arrays by name and shape.
fn npz(arrays: &[(&str, &str, &[u8])]) -> Vec<u8> {
    let mut archive = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    for (name, shape, data) in arrays {
        let options = zip::write::SimpleFileOptions::default();
        archive.start_file(format!("{name}.npy"), options).unwrap();
        let header = format!("{{'descr': '|u1', 'fortran_order': False, 'shape': ({shape}), }}");
        let padded = format!("{header:<117}\n");
        archive.write_all(b"\x93NUMPY\x01\x00").unwrap();
        archive
            .write_all(&(padded.len() as u16).to_le_bytes())
            .unwrap();
        archive.write_all(padded.as_bytes()).unwrap();
        archive.write_all(data).unwrap();
    }
    archive.finish().unwrap().into_inner()
}

#[test]
fn the_only_volume_of_an_npz() {
    let [nx, ny, nz] = DIMS;
    let shape = format!("{nz}, {ny}, {nx}");
    let whole = npz(&[("voxel_m", "", &[1]), ("labels", &shape, &volume())]);
    let (_folder, path) = stored("a.npz", &whole);
    assert_test_volume("npz", &path, PLAIN);
    let two = npz(&[("a", &shape, &volume()), ("b", &shape, &volume())]);
    let said = refusal("a.npz", &two);
    assert!(
        said.contains("2 arrays of three axes: a.npy, b.npy"),
        "{said}"
    );
    let none = refusal("a.npz", &npz(&[("a", "3,", &[1, 2, 3])]));
    assert!(none.contains("0 arrays"), "{none}");
    refusal("a.npz", &whole[..whole.len() / 2]);
}

/// A directory of several planes by SGI's tag, in one strip or in one for each plane.
#[test]
fn planes_by_the_tag_image_depth() {
    let [nx, ny, nz] = DIMS;
    let depth = |page: Page| page.tag(32997, Value::Long(vec![nz as u32]));
    let whole = depth(Page::new(nx, ny, 8, volume()));
    let (_folder, path) = stored("a.tif", &tiff(CLASSIC, std::slice::from_ref(&whole)));
    assert_test_volume("one strip", &path, PLAIN);
    let mut parted = whole;
    parted.chunks = pages(|label| [label]);
    let (_folder, path) = stored("a.tif", &tiff(CLASSIC, &[parted]));
    assert_test_volume("a strip each", &path, PLAIN);
    let cut = depth(Page::new(nx, ny, 8, volume()[..nx * ny * 2].to_vec()));
    let said = refusal("a.tif", &tiff(CLASSIC, &[cut]));
    assert!(said.contains("bytes are stored"), "{said}");
    // Deflated in one piece it was said to be truncated.
    let packed = depth(Page::new(nx, ny, 8, vec![0x78; 60]).short(259, 8));
    let said = refusal("a.tif", &tiff(CLASSIC, &[packed]));
    assert!(said.contains("compressed in one piece"), "{said}");
    let many = Page::new(nx, ny, 8, volume()).tag(32997, Value::Long(vec![u32::MAX]));
    let said = refusal("a.tif", &tiff(CLASSIC, &[many]));
    assert!(said.contains("ImageDepth"), "{said}");
}

#[test]
fn a_stack_of_one_bit_may_be_wood_alone() {
    let [nx, ny, _] = DIMS;
    let bits: Vec<Page> = (0..DIMS[2])
        .map(|z| {
            let rows = page(z, |label| u8::from(label == 1));
            let packed = rows.chunks(nx).flat_map(|row| row.chunks(8)).map(|eight| {
                let bits = eight.iter().enumerate();
                bits.fold(0, |byte, (i, bit)| byte | bit << (7 - i))
            });
            Page::new(nx, ny, 1, packed.collect())
        })
        .collect();
    let (_folder, path) = stored("a.tif", &tiff(CLASSIC, &bits));
    let found = segmented(std::slice::from_ref(&path), &Phases::Guess).unwrap();
    let wood = volume().iter().filter(|l| **l == 1).count() as u64;
    assert_eq!((found.wood.count(), found.adhesive.count()), (wood, 0));
    assert_eq!(found.guessed, Some(&[0.0, 1.0][..]));
    let named = Phases::Labels("void=0,wood=1".parse().unwrap());
    assert_eq!(segmented(&[path], &named).unwrap().wood, found.wood);
}

#[test]
fn grey_values_are_counted_and_parted() {
    let grey = |l: u8| 1000 * u16::from(l) + 500;
    let words = pages(|l| grey(l).to_le_bytes()).concat();
    let (_folder, path) = stored("a.raw", &words);
    let dims = "21x13x4".parse().unwrap();
    let stack = Stack::open_raw(&path, dims, "u16".parse().unwrap()).unwrap();
    let histogram = Histogram::of(&stack, &Crop::whole(DIMS)).unwrap();
    let count = |l: u8| volume().iter().filter(|v| **v == l).count() as u64;
    for label in 0..3 {
        assert_eq!(histogram.counts[usize::from(grey(label))], count(label));
    }
    assert_eq!(histogram.counts.iter().sum::<u64>(), 21 * 13 * 4);
    let cropped = Histogram::of(&stack, &"0:5,0:13,1:3".parse().unwrap()).unwrap();
    assert_eq!(cropped.counts.iter().sum::<u64>(), 5 * 13 * 2);
    let phases = Phases::Grey(histogram.otsu().unwrap().grey);
    let found = segment(&stack, &phases, &Crop::whole(DIMS), || {}).unwrap();
    assert_eq!(
        (found.wood.count(), found.adhesive.count()),
        (count(1), count(2))
    );
}

#[test]
fn formats_that_are_not_read_name_a_conversion() {
    let dicom = [&[0; 128][..], b"DICM"].concat();
    for (name, bytes, said) in [
        ("a.h5", &b"\x89HDF\r\n\x1a\n...."[..], "h5py"),
        ("a.am", b"# AmiraMesh BINARY-LITTLE-ENDIAN 2.1\n", "3D TIFF"),
        ("a.dcm", &dicom, "dcm2niix"),
        ("a.txt", b"hello", "accepted are TIFF"),
    ] {
        let sentence = refusal(name, bytes);
        assert!(sentence.contains(said), "{sentence}");
    }
    let folder = tempfile::tempdir().unwrap();
    let opened = |path: &Path| Stack::open(&[PathBuf::from(path)]).unwrap_err().to_string();
    fs::write(folder.path().join("a.dcm"), dicom).unwrap();
    assert!(opened(folder.path()).contains("DICOM"));
    fs::write(folder.path().join(".zarray"), "{}").unwrap();
    assert!(opened(folder.path()).contains("numpy.save"));
}

/// Flipped bytes and cut ends are read or refused, never worse.
#[test]
fn damaged_volumes_do_not_panic() {
    let [nx, ny, nz] = DIMS;
    let shape = format!("{nz}, {ny}, {nx}");
    let mha = format!(
        "NDims = 3\nDimSize = {nx} {ny} {nz}\nElementType = MET_UCHAR\nCompressedData = True\nElementDataFile = LOCAL\n"
    );
    let deep = Page::new(nx, ny, 8, volume()).tag(32997, Value::Long(vec![nz as u32]));
    let sound = [
        [mha.as_bytes(), &zlib(&volume())].concat(),
        [nrrd("uchar", "raw", "\n").as_bytes(), &volume()].concat(),
        [nrrd("uchar", "gzip", "\n").as_bytes(), &gzip(&volume())].concat(),
        [nifti(false, 2, |_| {}), volume()].concat(),
        [nifti(true, 2, |_| {}), volume()].concat(),
        gzip(&[nifti(false, 2, |_| {}), volume()].concat()),
        npz(&[("labels", &shape, &volume())]),
        tiff(CLASSIC, &[deep]),
    ];
    assert!(damaged(&sound, "a.volume") > 300);
}

//! MetaImage and NRRD: text headers, and pixels behind or beside them, raw, compressed, as text, in many files.

use std::fs;
use std::io::Write;

use voxels::VoxelEdge;

use crate::build::*;
use crate::check::*;

fn bzip2(bytes: &[u8]) -> Vec<u8> {
    let mut packed = bzip2::write::BzEncoder::new(Vec::new(), bzip2::Compression::default());
    packed.write_all(bytes).unwrap();
    packed.finish().unwrap()
}

/// The volume as numbers, lines of a row each, `factor` times the labels.
fn text(factor: i32) -> Vec<u8> {
    let row = |row: &[u8]| {
        let numbers = row.iter().map(|l| (factor * i32::from(*l)).to_string());
        numbers.collect::<Vec<_>>().join(" ")
    };
    let rows: Vec<String> = volume().chunks(DIMS[0]).map(row).collect();
    rows.join(" \r\n").into()
}

/// As MetaImage, NRRD and NIfTI call them.
#[test]
fn elements_of_every_type() {
    for (kind, element, name, code) in [
        ("u8", "UCHAR", "uint8", 2),
        ("i8", "CHAR", "signed char", 256),
        ("u16", "USHORT", "unsigned short", 512),
        ("i16", "SHORT", "short int", 4),
        ("u32", "UINT", "uint32_t", 768),
        ("u32", "ULONG", "unsigned int", 768),
        ("i32", "INT", "signed int", 8),
        ("i32", "LONG", "int", 8),
        ("u64", "ULONG_LONG", "unsigned long long int", 1280),
        ("i64", "LONG_LONG", "longlong", 1024),
        ("f32", "FLOAT", "float", 16),
        ("f64", "DOUBLE", "double", 64),
    ] {
        let times = factor(kind);
        let labels = labels(|l| i32::from(l) * times);
        let [low, high] = [false, true].map(|big| numbers(kind, big, times, &volume()));
        assert_file("a.mha", &mha(element, "", &low), &labels);
        let more = "BinaryData = False\nElementByteOrderMSB = True\n";
        assert_file("a.mha", &mha(element, more, &text(times)), &labels);
        let nrrd = nrrd(name, "raw", "endian: big\n\n", &high);
        assert_file("a.nrrd", &nrrd, &labels);
        assert_file("a.nii", &nifti(false, code, &low), &labels);
    }
}

#[test]
fn numbers_written_as_text() {
    let (folder, path) = stored("a.mhd", &mhd("SHORT", "BinaryData = False\n", "a.txt"));
    fs::write(folder.path().join("a.txt"), text(-7)).unwrap();
    assert_volume("beside", &path, &labels(|l| -7 * i32::from(l)));
    for encoding in ["ascii", "text", "txt"] {
        let file = nrrd("short", encoding, "\n", &text(-7));
        assert_file("a.nrrd", &file, &labels(|l| -7 * i32::from(l)));
    }
}

#[test]
fn spacings_are_sizes_by_their_units_alone() {
    let spaced = |unit: &str| format!("ElementSpacing = 0.5 0.5 0.5\nDistanceUnits = {unit}\n");
    for (unit, edge) in [
        ("um", Some(0.5e-6)),
        ("inch", Some(12.7e-3)),
        ("pixel", None),
    ] {
        let (_folder, path) = stored("a.mha", &mha("UCHAR", &spaced(unit), &volume()));
        let found = stated_edge(&path).map(|edge| (edge.unwrap() * 1e9).round());
        assert_eq!(found, edge.map(|edge: f64| (edge * 1e9).round()));
        let stack = open(&path);
        let size = stack.voxel_size();
        assert!(size.is_none_or(|s| s.states_spacing() && s.from() == "MetaImage spacing"));
    }
    let (_folder, path) = stored(
        "a.mha",
        &mha("UCHAR", "ElementSpacing = 1 1 1\n", &volume()),
    );
    assert!(stated_edge(&path).is_none());
    for more in [
        "space directions: (1.45,0,0) (0,1.45,0) (0,0,1.45)\nspace units: \"um\" \"um\" \"um\"\n\n",
        "spacings: 1.45 1.45 1.45\nunits: \"um\" \"um\" \"um\"\n\n",
    ] {
        let (_folder, path) = stored("a.nrrd", &nrrd("uchar", "raw", more, &volume()));
        assert_volume("spaced", &path, PLAIN);
        assert_edge(&path, 1.45e-6);
    }
}

#[test]
fn a_spacing_that_no_voxel_has_is_told() {
    let large = "ElementSpacing = 1e12 1e12 1e12\nDistanceUnits = m\n";
    let (_folder, path) = stored("a.mhd", &mha("UCHAR", large, &volume()));
    let edge = VoxelEdge::resolve(None, open(&path).voxel_size(), "a.mhd");
    assert_says(edge, &["a voxel is 1e12 m"]);
}

#[test]
fn meta_images_beside_and_behind_their_header() {
    let (folder, path) = stored(
        "a.mhd",
        &mhd("USHORT", "ElementByteOrderMSB = True\n", "a.raw"),
    );
    let raw = numbers("u16", true, 300, &volume());
    fs::write(folder.path().join("a.raw"), raw).unwrap();
    assert_volume("beside", &path, "void=0,wood=300,adhesive=600");
    assert_file("a.mha", &mha("UCHAR", "", &volume()), PLAIN);

    let colours: Vec<u8> = volume().iter().flat_map(|l| [*l, 0, *l]).collect();
    let colours = mha("UCHAR", "ElementNumberOfChannels = 3\n", &colours);
    let (_folder, path) = stored("colours.mha", &colours);
    assert_volume("colours", &path, &labels(|l| format!("{l}:0:{l}")));
    let stack = open(&path);
    assert_eq!(stack.name(), format!("'{}'", path.display()));
    assert_eq!(stack.format().to_string(), "21 x 13, unsigned 8 bits x 3");

    let text = |more: &str, numbers: String| mha("UCHAR", more, numbers.as_bytes());
    let no = "BinaryData = False\n";
    for (bad, said) in [
        (text(no, "1 2 x".to_owned() + &" 1".repeat(1100)), "'x'"),
        (text(no, "1 256".to_owned() + &" 1".repeat(1100)), "'256'"),
        (text("BinaryData = 0\n", "1 ".repeat(700)), "700 numbers"),
        (b"NDims = 3\n".to_vec(), "ElementDataFile"),
    ] {
        assert_refused("a.mhd", &bad, &[said]);
    }
}

/// A header could name any file that its reader can read, and a device fills memory or disk.
#[test]
fn a_meta_image_reads_nothing_outside_its_folder() {
    let folder = tempfile::tempdir().unwrap();
    let inside = |name: &str| folder.path().join(name);
    fs::create_dir_all(inside("own/deeper")).unwrap();
    for name in ["secret.raw", "own/deeper/a.raw"] {
        fs::write(inside(name), volume()).unwrap();
    }
    std::os::unix::fs::symlink(inside("secret.raw"), inside("own/link.raw")).unwrap();
    std::os::unix::fs::symlink("deeper/a.raw", inside("own/fine.raw")).unwrap();
    let header = inside("own/a.mhd");
    let write = |file: &str| fs::write(&header, mhd("UCHAR", "", file)).unwrap();
    for good in ["deeper/a.raw", "./deeper/a.raw", "fine.raw"] {
        write(good);
        assert_eq!(open(&header).dims(), DIMS);
    }
    let absolute = inside("own/deeper/a.raw").display().to_string();
    for (bad, said) in [
        ("../secret.raw", "has '..' in it"),
        (&absolute, "absolute path"),
        ("/dev/zero", "absolute path"),
        ("link.raw", "a link that leaves the folder"),
        ("deeper", "no regular file"),
    ] {
        write(bad);
        assert_has(&refusal(&header), &[said, "header's own folder"]);
    }
}

#[test]
fn nrrd_raw_and_gzipped_behind_and_beside() {
    let words = numbers("u16", true, 300, &volume());
    let packed = |pixels: &[u8]| nrrd("ushort", "gzip", "endian: big\n\n", pixels);
    let wide = "void=0,wood=300,adhesive=600";
    assert_file("a.nrrd", &packed(&gzip(&words)), wide);
    let mut damaged = gzip(&words);
    let sum = damaged.len() - 8;
    damaged[sum] ^= 1;
    let longer = gzip(&[&words[..], &[0]].concat());
    for (pixels, said) in [(damaged, "cannot be read"), (longer, "unpacks to more")] {
        assert_refused("a.nrrd", &packed(&pixels), &[said]);
    }
    let colours: Vec<u8> = volume().iter().flat_map(|l| [*l, 0, 5]).collect();
    let file = String::from_utf8(nrrd("uchar", "raw", "\n", &colours)).unwrap();
    let file = file.replace("sizes:", "sizes: 3");
    assert_file("a.nrrd", file.as_bytes(), &labels(|l| format!("{l}:0:5")));
    let beside = "byte skip: 3\ndata file: a.raw\n";
    let (folder, path) = stored("a.nhdr", &nrrd("uchar", "raw", beside, &[]));
    let skipped = [b"abc", &volume()[..]].concat();
    fs::write(folder.path().join("a.raw"), skipped).unwrap();
    assert_volume("beside", &path, PLAIN);
}

#[test]
fn pixels_by_bzip2() {
    let words = numbers("u16", true, 300, &volume());
    let more = "endian: big\nbyte skip: 5\n\n";
    let packed = bzip2(&[b"skips", &words[..]].concat());
    let whole = nrrd("ushort", "bzip2", more, &packed);
    assert_file("a.nrrd", &whole, "void=0,wood=300,adhesive=600");
    let cut = &whole[..whole.len() - 30];
    assert_refused("a.nrrd", cut, &["compressed pixels cannot be read"]);
}

#[test]
fn pixels_at_the_end_of_their_file() {
    let raw = [b"a header of a camera", &volume()[..]].concat();
    let at_end = "byte skip: -1\ndata file: a.raw\n";
    for (name, head) in [
        ("a.mhd", mhd("UCHAR", "HeaderSize = -1\n", "a.raw")),
        ("a.nhdr", nrrd("uchar", "raw", at_end, &[])),
    ] {
        let (folder, path) = stored(name, &head);
        fs::write(folder.path().join("a.raw"), &raw).unwrap();
        assert_volume(name, &path, PLAIN);
        fs::write(folder.path().join("a.raw"), &raw[30..]).unwrap();
        assert_has(&refusal(&path), &["it is truncated"]);
    }
}

/// Headers that name a file for each page, or for two pages.
#[test]
fn volumes_in_many_files() {
    let data = pages();
    let names = ["p008.raw", "p010.raw", "p012.raw", "p014.raw"];
    let list = format!("LIST\n{}", names.join("\n"));
    for files in ["p%03d.raw 8 14 2", &list] {
        let data_file = format!("data file: {files}\n");
        for (name, head) in [
            ("a.mhd", mhd("UCHAR", "", files)),
            ("a.nhdr", nrrd("uchar", "raw", &data_file, &[])),
        ] {
            let (folder, path) = stored(name, &head);
            for (name, page) in names.iter().zip(&data) {
                fs::write(folder.path().join(name), page).unwrap();
            }
            assert_volume(files, &path, PLAIN);
            fs::write(folder.path().join(names[2]), &data[2][1..]).unwrap();
            assert_has(&refusal(&path), &[names[2], "end after 272 of 273"]);
        }
    }
    let (folder, path) = stored("a.mhd", &mhd("UCHAR", "", "half%d.raw 1 2 1"));
    fs::write(folder.path().join("half1.raw"), data[..2].concat()).unwrap();
    fs::write(folder.path().join("half2.raw"), data[2..].concat()).unwrap();
    assert_volume("two pages a file", &path, PLAIN);
    let three = mhd("UCHAR", "", "LIST\nhalf1.raw\nhalf2.raw\nhalf1.raw");
    fs::write(&path, three).unwrap();
    assert_has(&refusal(&path), &["4 pages are in 3 files"]);
}

#[test]
fn meta_images_that_are_compressed() {
    let packed = zlib(&volume());
    let more = format!(
        "CompressedData = True\nCompressedDataSize = {}\n",
        packed.len()
    );
    let behind = mha("UCHAR", &more, &packed);
    assert_file("a.mha", &behind, PLAIN);
    let (folder, path) = stored("a.mhd", &mhd("UCHAR", &more, "a.zraw"));
    fs::write(folder.path().join("a.zraw"), &packed).unwrap();
    assert_volume("mhd", &path, PLAIN);
    assert_eq!(open(&path).sources().len(), 2);
    let cut = &behind[..behind.len() - 40];
    assert_refused("a.mha", cut, &["compressed pixels"]);
    let head = String::from_utf8(mhd("UCHAR", &more, "LOCAL")).unwrap();
    let bomb = head.replace("21 13 4", "90000 90000 90000");
    let bomb = [bomb.as_bytes(), &packed].concat();
    assert_refused("a.mha", &bomb, &["compressed bytes are stored"]);
}

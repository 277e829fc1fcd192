//! Raw volumes, NumPy arrays, NIfTI; formats that are not read.

use std::fs;

use voxels::{Crop, Dims, RawType, Stack, segment};

use crate::build::*;
use crate::check::*;

#[test]
fn raw_volumes_by_size_and_type() {
    let (_folder, path) = stored("a.raw", &numbers("u16", true, 300, &volume()));
    let open = |dims: &str, kind: &str| {
        let (dims, kind): (Dims, RawType) = (dims.parse().unwrap(), kind.parse().unwrap());
        Stack::open_raw(&path, dims, kind)
    };
    let stack = open("21x13x4", "u16be").unwrap();
    let phases = by_labels("void=0,wood=300,adhesive=600");
    let found = segment(&stack, &phases, &Crop::whole(DIMS), || {}).unwrap();
    assert_eq!(found.wood.count(), count(1));
    for (dims, kind) in [
        ("21x13x4", "u8"),
        ("21x13x5", "u16"),
        ("1000000x1000000x1000000", "f64"),
    ] {
        assert_says(open(dims, kind), &["check --dims and --type"]);
    }
}

#[test]
fn arrays_of_every_type_and_order() {
    let [nx, ny, nz] = DIMS;
    // z fastest, then y.
    let fortran: Vec<u8> = (0..nx * ny * nz)
        .map(|i| label(i / (nz * ny), i / nz % ny, i % nz))
        .collect();
    for kind in NUMBERS {
        let bits: usize = kind[1..].parse().unwrap();
        let times = factor(kind);
        let labels = labels(|l| i32::from(l) * times);
        for (order, big_endian) in [('<', false), ('>', true)] {
            let descr = format!("{order}{}{}", &kind[..1], bits / 8);
            for (fortran, all) in [(false, &volume()), (true, &fortran)] {
                let data = numbers(kind, big_endian, times, all);
                let file = npy(1, &descr, fortran, &shape(), &data);
                assert_file("a.npy", &file, &labels);
            }
        }
    }
    // Python 2 wrote an L behind numbers.
    let old = "4L, 13L, 21L";
    for (version, descr, shape) in [
        (1, "|u1", &*shape()),
        (1, "|b1", old),
        (2, "|u1", old),
        (3, "=u1", "4,13,21,"),
    ] {
        let file = npy(version, descr, false, shape, &volume());
        assert_file("a.npy", &file, PLAIN);
    }
}

#[test]
fn an_axis_that_is_too_long_is_refused() {
    let long = npy(1, "|u1", false, "100001, 1, 1", &[0; 100_001]);
    assert_refused("a.npy", &long, &["more than 100000 along an axis"]);
}

#[test]
fn the_only_volume_of_an_npz() {
    let all = volume();
    let whole = npz(&[("voxel_m", "", &[1]), ("labels", &shape(), &all)]);
    assert_file("a.npz", &whole, PLAIN);
    let cut = &whole[..whole.len() - 9];
    assert_refused("a.npz", cut, &["cut or damaged ("]);
    let two = npz(&[("a", &shape(), &all), ("b", &shape(), &all)]);
    assert_refused("a.npz", &two, &["2 arrays of three axes: a.npy, b.npy"]);
    let none = npz(&[("a", "3,", &[1, 2, 3])]);
    assert_refused("a.npz", &none, &["0 arrays"]);
}

#[test]
fn nifti_of_both_versions_plain_and_gzipped() {
    for second in [false, true] {
        let plain = nifti(second, 2, &volume());
        for (name, bytes) in [("a.nii", plain.clone()), ("a.nii.gz", gzip(&plain))] {
            let (_folder, path) = stored(name, &bytes);
            assert_volume(name, &path, PLAIN);
            assert_edge(&path, 1.45e-6);
        }
        let cut = &plain[..plain.len() - 1];
        assert_refused("a.nii", cut, &["truncated"]);
        assert_refused("a.nii.gz", &gzip(cut), &["compressed pixels"]);
        assert_refused("a.nii.gz", &gzip(cut)[..20], &["cut or damaged ("]);
    }
    let colours: Vec<u8> = volume().iter().flat_map(|l| [*l, 0, 7]).collect();
    let labels = labels(|l| format!("{l}:0:7"));
    assert_file("a.nii", &nifti(false, 128, &colours), &labels);
    assert_refused("a.txt.gz", &gzip(b"some text"), &["gunzip"]);
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
        assert_refused(name, bytes, &[said]);
    }
    let (folder, _) = stored("a.dcm", &dicom);
    assert_has(&refusal(folder.path()), &["DICOM"]);
    fs::write(folder.path().join(".zarray"), "{}").unwrap();
    assert_has(&refusal(folder.path()), &["numpy.save"]);
}

//! Sizes and inputs that this machine's memory does not hold: a sentence with what is needed and what
//! there is, before anything is begun. Each aborted ("memory allocation of ... bytes failed", SIGABRT)
//! or was killed.

use std::fs::{self, File};
use std::io::Write;
use std::os::unix::process::ExitStatusExt;

use particle_file::{BitGrid, Block, Draft, Header, Kind, Material};

use crate::verdicts::changed;
use crate::workbench::{Workbench, npy, said};

const SENTENCE: &str = "of memory, and this process may have";

/// Runs `line` in `megabytes` of address space, for 20 s at most.
fn within(bench: &Workbench, megabytes: u32, line: &str) -> (Option<i32>, String) {
    let limits = format!("ulimit -c 0; ulimit -v {megabytes}000; timeout 20");
    let output = bench.shell(&format!("{limits} {line}"));
    let told = said(&output);
    assert_eq!(output.status.signal(), None, "{line}: {told}");
    assert!(!told.contains("panicked"), "{line}: {told}");
    (output.status.code(), told)
}

/// A line must end with `code` and the sentence, and leave nothing.
fn refused(bench: &Workbench, megabytes: u32, code: i32, line: &str) {
    let before = bench.names("");
    let (found, told) = within(bench, megabytes, line);
    println!("{line}: {}", told.trim());
    assert_eq!(found, Some(code), "{line}: {told}");
    assert!(told.contains(SENTENCE), "{line}: {told}");
    assert!(!told.contains("allocation"), "{line}: {told}");
    assert_eq!(bench.names(""), before, "{line}");
}

/// A file of `len` bytes that begins with `head`; all else is a hole that takes no disk.
fn sparse(bench: &Workbench, name: &str, head: &[u8], len: u64) {
    let mut file = File::create(bench.path(name)).unwrap();
    file.write_all(head).unwrap();
    file.set_len(head.len() as u64 + len).unwrap();
}

/// The header of an array of bytes.
fn array(shape: [u64; 3], fortran: bool) -> Vec<u8> {
    let [nz, ny, nx] = shape;
    let whole = npy([1, 1, 1], |_, _, _| 0);
    let order = if fortran { "True" } else { "False" };
    let header =
        format!("{{'descr': '|u1', 'fortran_order': {order}, 'shape': ({nz}, {ny}, {nx}), }}");
    [&whole[..10], format!("{header:<117}\n").as_bytes()].concat()
}

#[test]
fn a_specimen_that_does_not_fit_is_not_grown() {
    let bench = Workbench::new();
    let line = "synth-xct -q --adhesive none --size 2000x2000x2000 -o O.tif";
    refused(&bench, 1000, 2, line);
    // Larger than any machine that runs tests, without a limit of its own.
    if machine::available_bytes().is_some_and(|bytes| bytes < 17_000_000_000) {
        let output = bench.shell("synth-xct --adhesive pf --size 4096x4096x4096 -o O.tif");
        assert_eq!(output.status.code(), Some(2), "{}", said(&output));
    }
}

/// What is gone on with all the same, or not foreseen, ends with a documented status where the
/// allocator gives up: SIGABRT ended it.
#[test]
fn an_allocation_that_fails_is_a_failed_run() {
    let bench = Workbench::new();
    let line = "synth-xct -q --adhesive none --size 2000x2000x2000 --yes-really -o O.tif";
    let (code, told) = within(&bench, 1000, line);
    assert_eq!(code, Some(1), "{told}");
    assert!(
        told.contains("warning: a specimen of 2000 x 2000 x 2000"),
        "{told}"
    );
    assert!(
        told.contains("memory allocation of 2000000000 bytes failed"),
        "{told}"
    );
}

#[test]
fn stacks_that_do_not_fit_are_not_read() {
    let bench = Workbench::new();
    let huge = [4000, 4000, 4000];
    let bytes = 4000_u64.pow(3);
    sparse(&bench, "c.npy", &array(huge, false), bytes);
    sparse(&bench, "f.npy", &array(huge, true), bytes);
    let flat = 50_000_u64.pow(2);
    sparse(&bench, "flat.npy", &array([1, 50_000, 50_000], false), flat);
    sparse(&bench, "a.raw", &[], bytes);
    bench.write(
        "a.mhd",
        "NDims = 3\nDimSize = 4000 4000 4000\nElementType = MET_UCHAR\nElementDataFile = a.raw\n",
    );
    // 2.5e9 pixels in 310 kB: deflate can make as many of so few.
    let mut png = b"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR".to_vec();
    png.extend([50_000_u32.to_be_bytes(), 50_000_u32.to_be_bytes()].concat());
    png.extend(b"\x08\0\0\0\0\x6e\xc4\x62\x16\0\x04\0\0IDAT");
    sparse(&bench, "a.png", &png, 310_000);
    let mut bmp = b"BM\0\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0".to_vec();
    bmp.extend([50_000_u32.to_le_bytes(), 50_000_u32.to_le_bytes()].concat());
    bmp.extend(b"\x01\0\x08\0\0\0\0\0");
    sparse(&bench, "a.bmp", &bmp, flat + 64);
    let labels = "--voxel 1.45um --labels void=0,wood=1,adhesive=2 -o O";
    for line in [
        format!("xct2particles c.npy {labels}"),
        format!("xct2particles f.npy {labels}"),
        format!("xct2particles flat.npy {labels}"),
        format!("xct2particles flat.npy {labels} --crop 0:10,0:10,0:1"),
        format!("xct2particles a.raw --dims 4000x4000x4000 --type u8 {labels}"),
        format!("xct2particles a.mhd {labels}"),
        format!("xct2particles a.bmp {labels}"),
        format!("xct2particles a.png {labels}"),
        "xct2particles flat.npy --voxel 1um --grey auto -o O".into(),
        "xct2particles flat.npy --histogram O".into(),
        "wp-metrics a.mhd --voxel 1.45um".into(),
    ] {
        refused(&bench, 1000, 3, &line);
    }
    // What is wrong with a stack is said before it is read to its end, which takes minutes.
    let line = format!("xct2particles c.npy {labels} --crop 0:1,0:1,0:18446744073709551615");
    let (code, told) = within(&bench, 1000, &line);
    assert_eq!(code, Some(2), "{told}");
    // Without a limit: 1.5 TB of wood and adhesive.
    let deep = [60_000, 100_000, 1000];
    let path = bench.path("deep.npy");
    fs::write(&path, array(deep, false)).unwrap();
    let len = fs::metadata(&path).unwrap().len() + deep.iter().product::<u64>();
    // Not every file system has files so long.
    if File::options()
        .write(true)
        .open(&path)
        .unwrap()
        .set_len(len)
        .is_ok()
    {
        let output = bench.shell(&format!("timeout 20 xct2particles deep.npy {labels}"));
        assert_eq!(output.status.code(), Some(3), "{}", said(&output));
        assert!(said(&output).contains(SENTENCE), "{}", said(&output));
    }
}

/// A specimen of 512^3 voxels, half wood and half adhesive, in 34 MB.
fn specimen(bench: &Workbench, name: &str) {
    let dims = [512; 3];
    let voxel = 1.45e-6;
    let half = |low: bool| BitGrid::from_fn(dims, move |_, y, _| (y < 256) == low);
    let header = Header::new(Kind::Specimen, voxel, 1, [0.0; 3], [512.0 * voxel; 3]);
    let (wood, adhesive) = (half(true), half(false));
    let block = |name, material, bits| Block::new(name, material, [0.0; 3], voxel, bits);
    let draft = Draft::new(header)
        .block(block("wood", Material::Rigid, &wood), &wood)
        .block(block("adhesive", Material::Adhesive, &adhesive), &adhesive);
    draft
        .write_to(&mut File::create(bench.path(name)).unwrap())
        .unwrap();
}

/// A state of 4 million points in a box of a millimetre, in 80 MB.
fn state(bench: &Workbench, name: &str) {
    const POINTS: usize = 4_000_000;
    let mut header = Header::new(Kind::State, 1.45e-6, 1, [0.0; 3], [1e-3; 3]);
    header.particles = POINTS as u64;
    let place = |i: usize| [i % 200, i / 200 % 200, i / 40_000].map(|n| 5e-6 * n as f32);
    let position: Vec<f32> = (0..POINTS).flat_map(place).collect();
    let (volume, rate) = (vec![3e-18_f32; POINTS], vec![1_f32; POINTS]);
    let draft = Draft::new(header)
        .column("position", 3, &position)
        .column("volume", 1, &volume)
        .column("shear_rate", 1, &rate);
    draft
        .write_to(&mut File::create(bench.path(name)).unwrap())
        .unwrap();
}

#[test]
fn states_that_do_not_fit_are_not_used() {
    let bench = Workbench::new();
    state(&bench, "p.mpts");
    refused(&bench, 135, 3, "shear-stats --threads 1 p.mpts -o O.csv");
    for line in [
        "particles export p.mpts -f tiff -o O.tif",
        "particles export p.mpts -f vti -o O.vti",
        "bond-figures slice p.mpts -o O.svg",
        "bond-figures view p.mpts -o O.png",
    ] {
        refused(&bench, 600, 3, line);
    }
    let (code, told) = within(&bench, 600, "shear-stats p.mpts");
    assert_eq!(code, Some(0), "{told}");
}

#[test]
fn particle_files_that_do_not_fit_are_not_used() {
    let bench = Workbench::new();
    specimen(&bench, "s.mpts");
    for line in [
        "particles export s.mpts -f csv -o O.csv",
        "particles export s.mpts -f vtp -o O.vtp",
        "bond-figures view s.mpts -o O.png",
        "bond-report --state s.mpts -o O.html",
    ] {
        refused(&bench, 300, 3, line);
    }
    refused(&bench, 85, 3, "build-bondline --threads 1 s.mpts -o O");
}

/// Tables of 60 MB: lines without an end, rows without number.
#[test]
fn tables_that_do_not_fit_are_not_parsed() {
    let bench = Workbench::new();
    let n = 10_000_000;
    bench.write(
        "rows.csv",
        "x_um,z_um,wp_um\n".to_owned() + &"1,2,3\n".repeat(n),
    );
    bench.write("line.csv", "a.b,".repeat(2 * n));
    for name in ["rows.csv", "line.csv"] {
        for line in [
            format!("bond-figures map --map a={name} -o O.svg"),
            format!("bond-figures table2 --run pf:x={name} -o O.csv"),
            format!("bond-sweep plan {name} --case case.toml -o O"),
        ] {
            refused(&bench, 500, 3, &line);
        }
    }
    // Every column was held against every other.
    let names: Vec<_> = (0..400_000).map(|i| format!("a.b{i}")).collect();
    bench.write("wide.csv", names.join(",") + "\n");
    let (code, told) = within(
        &bench,
        2000,
        "bond-sweep plan wide.csv --case case.toml -o O",
    );
    assert_eq!(code, Some(2), "{told}");
    assert!(told.contains("400000 columns"), "{told}");
}

/// The memory of the machine was counted, and not what this process may have of it.
#[test]
fn a_run_that_does_not_fit_into_its_address_space_is_refused() {
    let bench = Workbench::new();
    let wide = changed(&[
        (
            "max = [\"24 um\", \"30 um\", \"2 um\"] }\n[adhesive]",
            "max = [\"5 mm\", \"8 mm\", \"2 um\"] }\n[adhesive]",
        ),
        ("max = [\"12 um\", \"14 um\"", "max = [\"5 mm\", \"8 mm\""),
        ("\"0 um\", \"16 um\"", "\"0 um\", \"8.1 mm\""),
        (
            "\"24 um\", \"30 um\", \"2 um\"]",
            "\"24 um\", \"10 mm\", \"2 um\"]",
        ),
        ("\"4 um\"", "\"0.2 mm\""),
    ]);
    bench.write("case.toml", wide);
    refused(&bench, 2000, 2, "mpm-run case.toml --threads 1 -o O");
}

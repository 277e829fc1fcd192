//! Sizes and inputs that this machine's memory does not hold: a sentence with what is needed and what
//! there is, before anything is begun. Each aborted ("memory allocation of ... bytes failed", SIGABRT)
//! or was killed.

use std::fs::File;
use std::io::Write;

use particle_file::{BitGrid, Block, Draft, Header, Kind, Material};

use crate::verdicts::widened;
use crate::workbench::{Workbench, npy_header};

const SENTENCE: &str = "of memory, but this process may use";

/// A line, in so many megabytes of address space and for 20 s at most, must end with `code` and a sentence.
fn within(bench: &Workbench, megabytes: u32, code: i32, line: &str, sentence: &str) -> String {
    let limits = format!("ulimit -c 0; ulimit -v {megabytes}000; timeout 20");
    let told = bench.ends(code, &format!("{limits} {line}"), sentence);
    println!("{line}: {}", told.trim());
    told
}

/// The line must end so before an allocation fails, and leave nothing.
fn refused(bench: &Workbench, megabytes: u32, code: i32, line: &str) {
    let before = bench.names("");
    let told = within(bench, megabytes, code, line, SENTENCE);
    assert!(!told.contains("allocation"), "{told}");
    assert_eq!(bench.names(""), before, "{line}");
}

/// A file of `len` bytes that begins with `head`; all else is a hole that takes no disk. Not every file
/// system has files as long as one likes.
fn sparse(bench: &Workbench, name: &str, head: &[u8], len: u64) -> bool {
    let mut file = File::create(bench.path(name)).unwrap();
    file.write_all(head).unwrap();
    file.set_len(head.len() as u64 + len).is_ok()
}

#[test]
fn a_specimen_that_does_not_fit_is_not_grown() {
    let bench = Workbench::new();
    let line = "synth-xct -q --adhesive none --size 2000x2000x2000";
    refused(&bench, 1000, 2, &format!("{line} -o O.tif"));
    // Gone on with all the same, or not foreseen, it is a failed run where the allocator gives up.
    let failed = "memory allocation of 2000000000 bytes failed";
    let anyway = format!("{line} --yes-really -o O.tif");
    let told = within(&bench, 1000, 1, &anyway, failed);
    let warning = "warning: a specimen of 2000 x 2000 x 2000";
    assert!(told.contains(warning), "{told}");
    // Larger than any machine that runs tests, without a limit of its own.
    if machine::available_bytes().is_some_and(|bytes| bytes < 17_000_000_000) {
        bench.ends(
            2,
            "synth-xct --adhesive pf --size 4096x4096x4096 -o O.tif",
            SENTENCE,
        );
    }
}

#[test]
fn stacks_that_do_not_fit_are_not_read() {
    let bench = Workbench::new();
    let (side, flat) = (50_000_u32, 50_000_u64.pow(2));
    let bytes = 4000_u64.pow(3);
    sparse(&bench, "c.npy", &npy_header([4000; 3], "False"), bytes);
    sparse(&bench, "f.npy", &npy_header([4000; 3], "True"), bytes);
    sparse(
        &bench,
        "flat.npy",
        &npy_header([50_000, 50_000, 1], "False"),
        flat,
    );
    sparse(&bench, "a.raw", &[], bytes);
    bench.write(
        "a.mhd",
        "NDims = 3\nDimSize = 4000 4000 4000\nElementType = MET_UCHAR\nElementDataFile = a.raw\n",
    );
    // 2.5e9 pixels in 310 kB: deflate can make as many of so few.
    let mut png = b"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR".to_vec();
    png.extend([side.to_be_bytes(), side.to_be_bytes()].concat());
    png.extend(b"\x08\0\0\0\0\x6e\xc4\x62\x16\0\x04\0\0IDAT");
    sparse(&bench, "a.png", &png, 310_000);
    let mut bmp = b"BM\0\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0".to_vec();
    bmp.extend([side.to_le_bytes(), side.to_le_bytes()].concat());
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
    let crop = format!("xct2particles c.npy {labels} --crop 0:1,0:1,0:18446744073709551615");
    within(&bench, 1000, 2, &crop, "");
    // Without a limit: 1.5 TB of wood and adhesive.
    let deep = [1000, 100_000, 60_000];
    if sparse(
        &bench,
        "deep.npy",
        &npy_header(deep, "False"),
        deep.iter().product::<usize>() as u64,
    ) {
        bench.ends(
            3,
            &format!("timeout 20 xct2particles deep.npy {labels}"),
            SENTENCE,
        );
    }
}

fn written(bench: &Workbench, name: &str, draft: &Draft) {
    let mut file = File::create(bench.path(name)).unwrap();
    draft.write_to(&mut file).unwrap();
}

/// A state of 4 million points in a box of a millimetre, in 80 MB; a specimen of 512^3 voxels, half wood and
/// half adhesive, in 34 MB.
#[test]
fn particle_files_that_do_not_fit_are_not_used() {
    const POINTS: usize = 4_000_000;
    let bench = Workbench::new();
    let voxel = 1.45e-6;
    let mut header = Header::new(Kind::State, voxel, 1, [0.0; 3], [1e-3; 3]);
    header.particles = POINTS as u64;
    let place = |i: usize| [i % 200, i / 200 % 200, i / 40_000].map(|n| 5e-6 * n as f32);
    let position: Vec<f32> = (0..POINTS).flat_map(place).collect();
    let (volume, rate) = (vec![3e-18_f32; POINTS], vec![1_f32; POINTS]);
    let state = Draft::new(header)
        .column("position", 3, &position)
        .column("volume", 1, &volume)
        .column("shear_rate", 1, &rate);
    written(&bench, "p.mpts", &state);

    let half = |low: bool| BitGrid::from_fn([512; 3], move |_, y, _| (y < 256) == low);
    let header = Header::new(Kind::Specimen, voxel, 1, [0.0; 3], [512.0 * voxel; 3]);
    let (wood, adhesive) = (half(true), half(false));
    let block = |name, material, bits| Block::new(name, material, [0.0; 3], voxel, bits);
    let specimen = Draft::new(header)
        .block(block("wood", Material::Rigid, &wood), &wood)
        .block(block("adhesive", Material::Adhesive, &adhesive), &adhesive);
    written(&bench, "s.mpts", &specimen);

    for (megabytes, line) in [
        (135, "shear-stats --threads 1 p.mpts -o O.csv"),
        (600, "particles export p.mpts -f tiff -o O.tif"),
        (600, "particles export p.mpts -f vti -o O.vti"),
        (600, "bond-figures slice p.mpts -o O.svg"),
        (600, "bond-figures view p.mpts -o O.png"),
        (300, "particles export s.mpts -f csv -o O.csv"),
        (300, "particles export s.mpts -f vtp -o O.vtp"),
        (300, "bond-figures view s.mpts -o O.png"),
        (300, "bond-report --state s.mpts -o O.html"),
        (85, "build-bondline --threads 1 s.mpts -o O"),
    ] {
        refused(&bench, megabytes, 3, line);
    }
    within(&bench, 600, 0, "shear-stats p.mpts", "");
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
    within(
        &bench,
        2000,
        2,
        "bond-sweep plan wide.csv --case case.toml -o O",
        "400000 columns",
    );
}

/// The memory of the machine was counted, and not what this process may have of it.
#[test]
fn a_run_that_does_not_fit_into_its_address_space_is_refused() {
    let bench = Workbench::new();
    bench.write("case.toml", widened("5 mm"));
    refused(&bench, 2000, 2, "mpm-run case.toml --threads 1 -o O");
}

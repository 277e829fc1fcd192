//! The command line of build-bondline: what it writes, refuses and passes on.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use particle_file::{BitGrid, Block, Draft, Header, Kind, Material, ParticleFile};
use tempfile::TempDir;

const VOXEL: f64 = 1.45e-6;
const DIMS: [usize; 3] = [40, 60, 16];

/// Wood below 24 and from 30 with grooves, adhesive between and in the lower grooves.
fn specimen(folder: &Path, with_adhesive: bool) -> PathBuf {
    let groove = |x: usize| x.is_multiple_of(4);
    let wood = BitGrid::from_fn(DIMS, |x, y, _| !(24..30).contains(&y) && !groove(x));
    let adhesive = BitGrid::from_fn(DIMS, |x, y, _| {
        with_adhesive && ((24..30).contains(&y) || (9..24).contains(&y) && groove(x))
    });
    let max = DIMS.map(|n| n as f64 * VOXEL);
    let mut header = Header::new(Kind::Specimen, VOXEL, 1, [0.0; 3], max);
    header.set_attribute("stack", "grooves");
    let path = folder.join("specimen.mpts");
    let block = |name, material, bits| Block::new(name, material, [0.0; 3], VOXEL, bits);
    Draft::new(header)
        .block(block("wood", Material::Rigid, &wood), &wood)
        .block(block("adhesive", Material::Adhesive, &adhesive), &adhesive)
        .write_to(&mut File::create(&path).unwrap())
        .unwrap();
    path
}

fn tool(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_build-bondline"))
        .args(arguments)
        .output()
        .unwrap()
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[test]
fn a_bond_keeps_the_wood_and_the_adhesive_volume() {
    let folder = TempDir::new().unwrap();
    let specimen = specimen(folder.path(), true);
    let bond = folder.path().join("bond.mpts");
    let run = tool(&[specimen.to_str().unwrap(), "-o", bond.to_str().unwrap()]);
    assert!(run.status.success(), "{}", said(&run));
    assert!(said(&run).contains("y = 39.150 um"), "{}", said(&run));

    let file = ParticleFile::open(&bond).unwrap();
    let header = file.header();
    assert_eq!((header.kind, header.normal), (Kind::Bond, 1));
    let number = |name| header.attribute(name).unwrap().parse::<f64>().unwrap();
    // 6 full layers and 15 layers of a quarter: 9.75 voxels, hence 5 cells (+2.56 %).
    assert_eq!(number("slab_cells"), 5.0);
    assert!((number("bond_plane_m") - 27.0 * VOXEL).abs() < 1e-12);
    assert!((number("gap_m") - 10.0 * VOXEL).abs() < 1e-12);
    assert_eq!(number("adhesive_voxels_in"), 9.75 * 640.0);
    assert_eq!(header.attribute("stack"), Some("grooves"));
    assert_eq!(header.provenance.last().unwrap().tool, "build-bondline");
    let count = |name| file.block_named(name).unwrap().0.count;
    assert_eq!(count("adhesive"), 6400);
    assert_eq!(count("wood-bottom"), 24 * 30 * 16);
    assert_eq!(count("wood-top"), 30 * 30 * 16);
    let top = file.block_named("wood-top").unwrap().0;
    assert!((top.origin_m[1] - 37.0 * VOXEL).abs() < 1e-12);
}

#[test]
fn standard_input_and_output_give_the_same_voxels() {
    let folder = TempDir::new().unwrap();
    let specimen = specimen(folder.path(), true);
    let run = Command::new(env!("CARGO_BIN_EXE_build-bondline"))
        .args(["-", "-q", "-o", "-"])
        .stdin(Stdio::from(File::open(&specimen).unwrap()))
        .output()
        .unwrap();
    assert!(
        run.status.success() && run.stderr.is_empty(),
        "{}",
        said(&run)
    );
    let file = ParticleFile::from_bytes(&run.stdout).unwrap();
    assert_eq!(file.block_named("adhesive").unwrap().0.count, 6400);
}

#[test]
fn what_does_not_fit_is_refused_in_a_sentence_and_leaves_no_file() {
    let folder = TempDir::new().unwrap();
    let good = specimen(folder.path(), true);
    let bond = folder.path().join("bond.mpts");
    let good = good.to_str().unwrap();
    let target = bond.to_str().unwrap();
    for (options, status, words) in [
        (&["--tolerance", "1%"][..], 2, "tolerance of 1.00 %"),
        (&["--tolerance", "0.05"], 2, "percentage"),
        (&["--plane", "26"], 2, "no unit"),
        (&["--plane", "90 um"], 2, "outside the specimen"),
        (&["--gap", "1 um"], 2, "no room"),
        (&["--normal", "z"], 2, "--normal"),
        (&["--normal", "w"], 2, "x, y and z"),
        (&["--voxels-per-cell", "0"], 2, "voxels-per-cell"),
    ] {
        let run = tool(&[&[good, "-o", target], options].concat());
        assert_eq!(
            run.status.code(),
            Some(status),
            "{options:?}: {}",
            said(&run)
        );
        assert!(said(&run).contains(words), "{options:?}: {}", said(&run));
        assert!(!bond.exists());
    }
}

#[test]
fn unfit_files_are_exit_3() {
    let folder = TempDir::new().unwrap();
    let bond = folder.path().join("bond.mpts");
    let target = bond.to_str().unwrap();
    let empty = specimen(folder.path(), false);
    let run = tool(&[empty.to_str().unwrap(), "-o", target]);
    assert_eq!(run.status.code(), Some(3), "{}", said(&run));
    assert!(said(&run).contains("no adhesive"), "{}", said(&run));

    let truncated = folder.path().join("truncated.mpts");
    let bytes = fs::read(&empty).unwrap();
    fs::write(&truncated, &bytes[..bytes.len() - 100]).unwrap();
    let run = tool(&[truncated.to_str().unwrap(), "-o", target]);
    assert_eq!(run.status.code(), Some(3), "{}", said(&run));
    let run = tool(&["/nonexistent.mpts", "-o", target]);
    assert_eq!(run.status.code(), Some(3), "{}", said(&run));
    assert!(!bond.exists());
}

#[test]
fn a_bond_is_not_a_specimen() {
    let folder = TempDir::new().unwrap();
    let specimen = specimen(folder.path(), true);
    let bond = folder.path().join("bond.mpts");
    let bond = bond.to_str().unwrap();
    let run = tool(&[specimen.to_str().unwrap(), "-o", bond]);
    assert!(run.status.success(), "{}", said(&run));
    let run = tool(&[bond, "-o", "-"]);
    assert_eq!(run.status.code(), Some(2), "{}", said(&run));
    assert!(said(&run).contains("not a specimen"), "{}", said(&run));
}

#[test]
fn a_full_disk_is_exit_1() {
    let folder = TempDir::new().unwrap();
    let specimen = specimen(folder.path(), true);
    if !Path::new("/dev/full").exists() {
        eprintln!("skipped: this system has no /dev/full");
        return;
    }
    let run = tool(&[specimen.to_str().unwrap(), "-o", "/dev/full"]);
    assert_eq!(run.status.code(), Some(1), "{}", said(&run));
}

//! The command line of build-bondline: what it writes and passes on.

mod wood;

use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use particle_file::{BitGrid, Block, Draft, Header, Kind, Material, ParticleFile};
use tempfile::TempDir;

const VOXEL: f64 = 1.45e-6;
const DIMS: [usize; 3] = [40, 60, 16];

/// Writes a specimen of wood and adhesive, with its low corner at the origin, as `name` into `folder`.
fn write(folder: &Path, name: &str, header: Header, wood: &BitGrid, adhesive: &BitGrid) -> PathBuf {
    let path = folder.join(name);
    let voxel_m = header.voxel_m;
    let block = |name, material, bits| Block::new(name, material, [0.0; 3], voxel_m, bits);
    Draft::new(header)
        .block(block("wood", Material::Rigid, wood), wood)
        .block(block("adhesive", Material::Adhesive, adhesive), adhesive)
        .write_to(&mut File::create(&path).unwrap())
        .unwrap();
    path
}

/// Wood below 24 and from 30 with grooves, adhesive between and in the lower grooves.
fn specimen(folder: &Path) -> PathBuf {
    let groove = |x: usize| x.is_multiple_of(4);
    let wood = BitGrid::from_fn(DIMS, |x, y, _| !(24..30).contains(&y) && !groove(x));
    let adhesive = BitGrid::from_fn(DIMS, |x, y, _| {
        (24..30).contains(&y) || (9..24).contains(&y) && groove(x)
    });
    let max = DIMS.map(|n| n as f64 * VOXEL);
    let mut header = Header::new(Kind::Specimen, VOXEL, 1, [0.0; 3], max);
    header.set_attribute("stack", "grooves");
    write(folder, "specimen.mpts", header, &wood, &adhesive)
}

/// The tool in a folder, with `stdin` and the words of `line`.
fn tool(folder: &Path, stdin: impl Into<Stdio>, line: &str) -> Output {
    Command::new(env!("CARGO_BIN_EXE_build-bondline"))
        .current_dir(folder)
        .args(line.split(' '))
        .stdin(stdin)
        .output()
        .unwrap()
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[test]
fn a_tilted_bond_plane_is_told_and_warned_of() {
    let folder = TempDir::new().unwrap();
    let max = DIMS.map(|n| n as f64 * VOXEL);
    for (rise, warned) in [(2, false), (4, true)] {
        // A gap of six voxels in wood that rises along x.
        let inside = |x: usize, y: usize| (24..30).contains(&(y - x * rise / DIMS[0]));
        let wood = BitGrid::from_fn(DIMS, |x, y, _| y < 6 || !inside(x, y));
        let adhesive = BitGrid::from_fn(DIMS, |x, y, _| y >= 6 && inside(x, y));
        let header = Header::new(Kind::Specimen, VOXEL, 1, [0.0; 3], max);
        write(folder.path(), "tilted.mpts", header, &wood, &adhesive);
        let run = tool(folder.path(), Stdio::null(), "tilted.mpts -o bond.mpts");
        assert!(run.status.success(), "{}", said(&run));
        // A line through n equal steps is less steep than they rise, by 1 - 1/n^2.
        let steps = rise as f64;
        let slope = (1.0 - steps.powi(-2)) * steps / DIMS[0] as f64;
        let angle = format!(" and {:.2} degrees", slope.atan().to_degrees());
        assert!(
            said(&run).contains("bond plane is turned by 0.00, 0.00"),
            "{}",
            said(&run)
        );
        assert!(said(&run).contains(&angle), "{}", said(&run));
        assert_eq!(said(&run).contains("xct2particles --level y"), warned);
    }
}

#[test]
fn a_bond_keeps_the_wood_and_the_adhesive_volume() {
    let folder = TempDir::new().unwrap();
    specimen(folder.path());
    let run = tool(folder.path(), Stdio::null(), "specimen.mpts -o bond.mpts");
    assert!(run.status.success(), "{}", said(&run));
    assert!(said(&run).contains("y = 39.150 um"), "{}", said(&run));

    let file = ParticleFile::open(folder.path().join("bond.mpts")).unwrap();
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
    let specimen = File::open(specimen(folder.path())).unwrap();
    let run = tool(folder.path(), specimen, "- -q -o -");
    assert!(
        run.status.success() && run.stderr.is_empty(),
        "{}",
        said(&run)
    );
    let file = ParticleFile::from_bytes(&run.stdout).unwrap();
    assert_eq!(file.block_named("adhesive").unwrap().0.count, 6400);
}

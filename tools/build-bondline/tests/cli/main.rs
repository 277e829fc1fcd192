//! The command line of build-bondline: what it writes and passes on.

mod wood;
#[path = "../../../workbench.rs"]
mod workbench;

use particle_file::{BitGrid, Header, Kind, ParticleFile};
use workbench::Bench;

const VOXEL: f64 = 1.45e-6;
const DIMS: [usize; 3] = [40, 60, 16];

fn bench() -> Bench {
    Bench::new(env!("CARGO_BIN_EXE_build-bondline"))
}

fn header(dims: [usize; 3]) -> Header {
    Header::new(
        Kind::Specimen,
        VOXEL,
        1,
        [0.0; 3],
        dims.map(|n| n as f64 * VOXEL),
    )
}

fn open(bench: &Bench, name: &str) -> ParticleFile {
    ParticleFile::open(bench.path(name)).unwrap()
}

fn number(file: &ParticleFile, name: &str) -> f64 {
    file.header().attribute(name).unwrap().parse().unwrap()
}

#[test]
fn a_tilted_bond_plane_is_told_and_warned_of() {
    let bench = bench();
    for (rise, warned) in [(2, false), (4, true)] {
        // A gap of six voxels in wood that rises along x.
        let inside = |x: usize, y: usize| (24..30).contains(&(y - x * rise / DIMS[0]));
        let wood = BitGrid::from_fn(DIMS, |x, y, _| y < 6 || !inside(x, y));
        let adhesive = BitGrid::from_fn(DIMS, |x, y, _| y >= 6 && inside(x, y));
        bench.write_specimen("tilted.mpts", header(DIMS), &wood, &adhesive);
        let said = bench.run("tilted.mpts -o bond.mpts").done().said;
        // A line through n equal steps is less steep than they rise, by 1 - 1/n^2.
        let steps = rise as f64;
        let slope = (1.0 - steps.powi(-2)) * steps / DIMS[0] as f64;
        let degrees = slope.atan().to_degrees();
        let turn = format!("bond plane is turned by 0.00, 0.00 and {degrees:.2} degrees");
        assert!(said.contains(&turn), "{said}");
        assert_eq!(said.contains("xct2particles --level y"), warned);
    }
}

/// Wood below 24 and from 30 with grooves, adhesive between and in the lower grooves.
#[test]
fn a_bond_keeps_the_wood_and_the_adhesive_volume() {
    let bench = bench();
    let groove = |x: usize| x.is_multiple_of(4);
    let wood = BitGrid::from_fn(DIMS, |x, y, _| !(24..30).contains(&y) && !groove(x));
    let adhesive = BitGrid::from_fn(DIMS, |x, y, _| {
        (24..30).contains(&y) || (9..24).contains(&y) && groove(x)
    });
    let mut named = header(DIMS);
    named.set_attribute("stack", "grooves");
    bench.write_specimen("specimen.mpts", named, &wood, &adhesive);
    let said = bench.run("specimen.mpts -o bond.mpts").done().said;
    assert!(said.contains("y = 39.150 um"), "{said}");

    let file = open(&bench, "bond.mpts");
    let header = file.header();
    assert_eq!((header.kind, header.normal), (Kind::Bond, 1));
    // 6 full layers and 15 layers of a quarter: 9.75 voxels, hence 5 cells (+2.56 %).
    assert_eq!(number(&file, "slab_cells"), 5.0);
    assert!((number(&file, "bond_plane_m") - 27.0 * VOXEL).abs() < 1e-12);
    assert!((number(&file, "gap_m") - 10.0 * VOXEL).abs() < 1e-12);
    assert_eq!(number(&file, "adhesive_voxels_in"), 9.75 * 640.0);
    assert_eq!(header.attribute("stack"), Some("grooves"));
    assert_eq!(header.provenance.last().unwrap().tool, "build-bondline");
    let count = |name| file.block_named(name).unwrap().0.count;
    let counts = ["adhesive", "wood-bottom", "wood-top"].map(count);
    assert_eq!(counts, [6400, 24 * 30 * 16, 30 * 30 * 16]);
    let top = file.block_named("wood-top").unwrap().0;
    assert!((top.origin_m[1] - 37.0 * VOXEL).abs() < 1e-12);

    let piped = bench.shell("$TOOL - -q -o - < specimen.mpts").done();
    assert!(piped.said.is_empty(), "{}", piped.said);
    let piped = ParticleFile::from_bytes(&piped.stdout).unwrap();
    assert_eq!(piped.sum().unwrap(), file.sum().unwrap());
}

//! Scenes from a bond file, against numbers worked out by hand, and bond files that are refused.

use particle_file::{BitGrid, Header, Kind, ParticleFile};
use run::RunFailure;

use crate::bench::{Bench, END, PLAIN, case, has};

/// Edge of a voxel, m.
const VOXEL: f64 = 2e-6;
/// Distance by which the upper adherend was moved away, m.
const GAP: f64 = 5e-6;

const TABLES: &str = r#"[contact]
law = "stick"
[clamp]
closing_speed = "1 m/s"
stop = "closed"
[integrator]
scheme = "implicit"
"#;

/// A bond along z of 4 x `wide` voxels: wood three voxels thick with a pit two deep, two layers of adhesive, and wood two
/// voxels thick. `change` edits the finished header.
fn bench(wide: usize, change: impl FnOnce(&mut Header)) -> Bench {
    let bench = Bench::with(&case("1 um", None, TABLES));
    let gap_voxels = GAP / VOXEL;
    let high = [4.0, wide as f64, 5.0 + gap_voxels].map(|n| n * VOXEL);
    let mut header = Header::new(Kind::Bond, VOXEL, 2, [0.0; 3], high);
    header.set_attribute("gap_m", GAP);
    change(&mut header);
    let pitted = BitGrid::from_fn([4, wide, 3], |x, y, z| !(x == 1 && y == 0 && z > 0));
    let full = || BitGrid::from_fn([4, wide, 2], |_, _, _| true);
    let top = (3.0 + gap_voxels) * VOXEL;
    bench.put_bond(
        header,
        [(0.0, pitted), (top, full()), (3.0 * VOXEL, full())],
    );
    bench
}

#[test]
fn the_bond_normal_is_turned_to_y_and_every_adhesive_voxel_filled() {
    let bench = bench(8, |_| {});
    let lines = [
        "grid 8 x 15 x 16 cells of 1.0000 um, 3D",
        // 4 x 8 x 2 voxels of 8 um3, four points along each of their edges.
        "liquid 4096 material points, 5.1200e-16 m3",
        "rigid body wood-bottom: 94 voxels, at rest",
        "rigid body wood-top: 64 voxels, driven by the clamp",
        "end closed after 4.80 um of travel",
    ];
    has(&bench.plan(&[]).unwrap(), &lines);
    let changes = ["clamp.travel=3 um", "grid.points_per_direction=3"];
    let lines = [
        "liquid 13824 material points, 5.1200e-16 m3",
        "end closed after 3.00 um of travel",
    ];
    has(&bench.plan(&changes).unwrap(), &lines);
}

/// A case with cells in voxels fits any specimen.
#[test]
fn cells_may_be_voxels_of_the_bond() {
    let bench = bench(8, |_| {});
    for (cell, grid) in [
        ("0.5 voxel", "grid 8 x 15 x 16 cells of 1.0000 um"),
        ("1voxel", "grid 4 x 8 x 8 cells of 2.0000 um"),
        ("2 voxels", "grid 2 x 4 x 4 cells of 4.0000 um"),
    ] {
        let plan = bench.plan(&[&format!("grid.cell={cell}")]);
        has(&plan.unwrap(), &[grid]);
    }
}

#[test]
fn plane_strain_is_one_voxel_thick_and_one_cell_deep() {
    let plan = bench(1, |_| {}).plan(&["grid.dimensions=2"]);
    let lines = [
        "grid 8 x 15 x 1 cells of 1.0000 um, plane strain",
        // 4 x 2 voxels of 4 um2, 1 um deep.
        "liquid 128 material points, 3.2000e-17 m3",
        "rigid body wood-bottom: 10 voxels, at rest",
    ];
    has(&plan.unwrap(), &lines);
}

/// A state is written in the axes of its bond file, with the upper adherend at its current place.
#[test]
fn states_are_written_in_the_axes_of_the_bond() {
    let bench = bench(1, |_| {});
    let changes = ["grid.dimensions=2", "clamp.stop=0.3 us"];
    let summary = bench.run("run", PLAIN, END, &changes).unwrap().unwrap();
    assert!((summary.travel_m - 3e-7).abs() < 1e-15);
    let state = ParticleFile::open(bench.path("run/final.mpts")).unwrap();
    assert_eq!(state.header().normal, 2);
    let (top, bits) = state.block_named("wood-top").unwrap();
    assert_eq!(bits.dims(), [4, 1, 2]);
    let low = 11e-6 - summary.travel_m;
    assert!((top.origin_m[2] - low).abs() < 1e-12, "{:?}", top.origin_m);
    let (bottom, bits) = state.block_named("wood-bottom").unwrap();
    assert_eq!((bottom.origin_m, bits.count()), ([0.0; 3], 10));
    let places = state.vectors("position").unwrap();
    assert!(!places.is_empty());
    let (low, high) = (places.iter()).fold((f32::MAX, f32::MIN), |(low, high), at| {
        (low.min(at[2]), high.max(at[2]))
    });
    // Points are the centres of liquid voxels, in rows between 5 um, in a lumen, and the upper adherend.
    assert!(low > 5e-6 && high < 10.7e-6, "{low} to {high}");
}

#[test]
fn bonds_and_cells_that_do_not_fit_are_refused() {
    let bench = bench(8, |_| {});
    let domain =
        r#"grid.domain={ min = ["0 um", "0 um", "0 um"], max = ["8 um", "8 um", "8 um"] }"#;
    let points = "grid={ cell = \"4 um\", points_per_direction = 1 }";
    let body = r#"body=[{ material = "rigid", box = { min = ["0 m", "0 m", "0 m"], max = ["1 m", "1 m", "1 m"] } }]"#;
    for (change, sentence) in [
        ("grid.cell=1.6 um", "2.500 points along a voxel of 2.0000"),
        (points, "puts 0.500 points along a voxel"),
        ("grid.cell=2 voxel s", "or voxels, such as \"2 voxels\""),
        (domain, "a bond file has its own box"),
        (body, "only one of them can describe the scene"),
        // 4e6 cells are accepted however small the file.
        ("grid.cell=0.05 um", "160 x 300 x 320 cells; accepted are"),
    ] {
        has(&bench.refusal(&[change]), &[sentence]);
    }
    bench.remove("bond.mpts");
    has(&bench.refusal(&[]), &["nothing describes the scene"]);
}

#[test]
fn a_file_that_is_no_bond_is_refused() {
    type Change = fn(&mut Header);
    let read = |change: Change| bench(8, change).read(&[]);
    // The box may be larger by a cell, 64 voxels at most, and rounding.
    read(|header| header.box_max_m[0] += 64.0 * VOXEL).unwrap();
    let corrupt: [(&str, Change); 4] = [
        ("gap_m is missing", |header| header.attributes.clear()),
        ("not a length", |header| {
            header.set_attribute("gap_m", -1e-6)
        }),
        ("the same to a cell", |header| {
            header.box_max_m[0] += 66.0 * VOXEL
        }),
        ("the same to a cell", |header| {
            header.box_min_m[2] -= 66.0 * VOXEL
        }),
    ];
    for (sentence, change) in corrupt {
        let said = read(change).unwrap_err();
        assert!(matches!(said, RunFailure::Data(_)), "{said}");
        has(&said.to_string(), &[sentence]);
    }
}

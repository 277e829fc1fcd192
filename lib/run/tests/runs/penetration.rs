//! Penetration in the history and the summary of a run, against straight grooves filled by a known volume, and against
//! the same measures of its state files.

use std::fs;

use metrics::{Datum, Reference, Sealed, State, bond_line, penetration};
use particle_file::{BitGrid, Header, Kind, ParticleFile};
use run::RunFailure;

use crate::bench::{Bench, END, PLAIN, case, has};
use crate::stopped::ends_the_same;

/// Edge of a voxel and of a cell, um.
const VOXEL: f64 = 2.0;
/// Voxels across the bond line before pressing: its gap, filled by adhesive.
const GAP: usize = 12;
/// Voxels of each adherend along the normal.
const WOOD: usize = 40;
/// Voxels along x: half a groove, a land twice as wide, half a groove.
const WIDE: usize = 12;

const TABLES: &str = r#"[contact]
law = "frictionless"
[clamp]
closing_speed = "1 m/s"
stop = "20 us"
[integrator]
scheme = "implicit"
[output]
penetration = true
snapshots = 3
"#;

/// A bond with grooves over half of its area, which leave three voxels of wood behind them, and with a sealed lumen in the
/// land of the lower adherend.
fn bench() -> Bench {
    bench_of(TABLES)
}

fn bench_of(tables: &str) -> Bench {
    let thick = 2 * WOOD + GAP;
    let high = [WIDE, thick, 2].map(|n| n as f64 * VOXEL * 1e-6);
    let mut header = Header::new(Kind::Bond, VOXEL * 1e-6, 1, [0.0; 3], high);
    header.set_attribute("gap_m", GAP as f64 * VOXEL * 1e-6);
    let groove = |x: usize| !(3..9).contains(&x);
    let bottom = BitGrid::from_fn([WIDE, WOOD, 2], |x, y, _| {
        let lumen = (30..35).contains(&y) && (5..7).contains(&x);
        y < 3 || !(groove(x) || lumen)
    });
    let top = BitGrid::from_fn([WIDE, WOOD, 2], |x, y, _| y >= WOOD - 3 || !groove(x));
    let adhesive = BitGrid::from_fn([WIDE, GAP, 2], |_, _, _| true);
    let bench = Bench::with(&case("2 um", None, tables));
    let parts = [(0, bottom), (WOOD + GAP, top), (WOOD, adhesive)];
    let parts = parts.map(|(layer, bits)| (layer as f64 * VOXEL * 1e-6, bits));
    bench.put_bond(header, parts);
    bench
}

/// The last field of a column of the history.
fn last(bench: &Bench, name: &str) -> String {
    bench.column(name).pop().unwrap()
}

/// At the end the clamp has moved 20 of 24 um. Of 12 voxels of adhesive, 2 are left between the lands; each side's half of
/// the rest fills 10 voxels of its grooves, to a depth of 11 from the middle.
#[test]
fn grooves_filled_by_a_known_volume_are_told_within_a_voxel() {
    let bench = bench();
    let summary = bench.ran("run", PLAIN, END);
    let told = |name: &str| last(&bench, name);
    let number = |name: &str| told(name).parse::<f64>().unwrap();
    // 72 square voxels a side: 12 wide to a depth of 1, then 6 wide to 11.
    let wp = ((12.0 + 6.0 * (11_f64.powi(3) - 1.0)) / 3.0 / 72.0).sqrt() * VOXEL;
    let face = VOXEL.powi(2);
    let known = [
        ("wp", "um", wp, VOXEL),
        ("ep", "um", 6.0 * VOXEL, 0.5 * VOXEL),
        ("p95_depth", "um", (11.0 - 0.05 * 72.0 / 6.0) * VOXEL, VOXEL),
        ("half_filled_depth", "um", 11.0 * VOXEL, 1.01 * VOXEL),
        // Walls 10 voxels high and the land, all 2 voxels along z; tolerance: two voxels of both walls.
        ("wetted_area", "um2", 52.0 * face, 8.0 * face),
    ];
    for (name, unit, wanted, tolerance) in known {
        for side in ["bottom", "top"] {
            let found = number(&format!("{name}_{side}_{unit}"));
            let error = found - wanted;
            println!("{name} {side}: {found:.3} {unit}, known {wanted:.3}, error {error:+.3}");
            assert!(error.abs() <= tolerance, "{name} {side}: {found} {wanted}");
        }
    }
    let filled = number("bond_line_filled");
    println!("bond line filled: {filled:.4}, known 1");
    assert!((filled - 1.0).abs() < 0.1, "{filled}");
    assert_eq!(told("bond_line"), "filled");
    // The filled fraction of the open lumens is 1 up to the front and 0 beyond. Markers are off by up to a voxel, so the fill
    // up to any depth is exact to a layer.
    let answers = summary.penetration.unwrap();
    assert!(!answers.outer_face_reached);
    let by_depth = &answers.filled_by_depth;
    for shares in [&by_depth.bottom, &by_depth.top] {
        let (mut filled, mut most) = (0.0_f64, 0.0_f64);
        for (layer, share) in shares.iter().enumerate() {
            filled += share;
            most = most.max((filled - (layer as f64 + 1.0).min(11.0)).abs());
        }
        let layers = shares.len();
        println!("filled to any depth: largest error {most:.3} of a layer; {layers} with adhesive");
        assert!(most < 1.0 && layers <= 13, "{shares:?}");
    }
    let of_history = format!("{:.6}", 1e6 * answers.wp_m.total);
    assert_eq!(of_history, told("wp_total_um"));
}

/// The gap means the same in history, summary and states; with flat surfaces it is also their distance.
#[test]
fn the_gap_is_the_way_left_wherever_it_is_told() {
    let bench = bench();
    let summary = bench.ran("run", PLAIN, END);
    let told = |name: &str| last(&bench, name);
    // A bond with a gap of a tenth of a voxel is closed.
    let (wanted, closed) = (3.8e-6, 0.2e-6);
    let file = ParticleFile::open(bench.path("run/final.mpts")).unwrap();
    let noted: f64 = file.header().attribute("gap_m").unwrap().parse().unwrap();
    let state = State::of_file(&file).unwrap();
    let middle = Datum::find(Reference::Mid, &state).unwrap();
    let line = bond_line(&state, 0.0, &Sealed::of(&state, &middle)).unwrap();
    let history: f64 = told("gap_m").parse().unwrap();
    let surfaces = line.surfaces_m - closed;
    for gap in [history, summary.gap_m.unwrap(), noted, surfaces] {
        println!("gap {:.6} um, known {:.6}", 1e6 * gap, 1e6 * wanted);
        assert!((gap - wanted).abs() < 1e-12, "{gap}");
    }
    // The history agrees with the state file.
    let sides = penetration(&state, &middle);
    for (side, name) in sides.iter().zip(["bottom", "top", "total"]) {
        let um = |metres: f64| format!("{:.6}", 1e6 * metres);
        assert_eq!(um(side.wp_m), told(&format!("wp_{name}_um")));
        assert_eq!(um(side.p95_depth_m), told(&format!("p95_depth_{name}_um")));
    }
    let wetted = format!("{:.4}", 1e12 * line.wetted_m2[1]);
    assert_eq!(wetted, told("wetted_area_top_um2"));
}

/// Water taken by the walls does not count as liquid that left.
#[test]
fn only_what_left_through_open_sides_squeezes_a_bond_line_out() {
    let water = "[adhesive.water]\nsolids = 0.45\nuptake = \"0.2 m/s\"\ndiffusivity = \"1e-5 m2/s\"\nviscosity_by_solids = [[0.45, 1.0], [0.6, 30.0]]\n";
    for (more, squeezed_out) in [(water, false), ("[boundary]\nz = \"open\"\n", true)] {
        let bench = bench_of(&format!("{TABLES}{more}"));
        let summary = bench.run("run", PLAIN, END, &[]).unwrap().unwrap();
        let share = summary.points_left as f64 / summary.liquid_points as f64;
        let volumes = bench.column("adhesive_volume_m3");
        let [first, end] = [&volumes[0], &volumes[volumes.len() - 1]];
        let [first, end]: [f64; 2] = [first, end].map(|volume| volume.parse().unwrap());
        println!("{share:.3} left; volume {first:.3e} to {end:.3e} m3");
        assert!(end < 0.95 * first && (share > 0.05) == squeezed_out);
        assert_eq!(last(&bench, "bond_line") == "squeezed-out", squeezed_out);
        let file = ParticleFile::open(bench.path("run/final.mpts")).unwrap();
        let noted = file.header().attribute("left_through_open_sides").unwrap();
        assert!(
            (noted.parse::<f64>().unwrap() - share).abs() < 1e-12,
            "{noted}"
        );
    }
}

#[test]
fn a_run_that_tells_penetration_stopped_on_its_way_ends_the_same() {
    ends_the_same(&bench(), 4);
}

/// After a release, air may push the adhesive back: the summary also gives the WP before it.
#[test]
fn what_a_press_came_to_is_told_of_before_its_release() {
    let stages = "[[clamp.stage]]\nkind = \"approach\"\nspeed = \"1 m/s\"\npressure = \"1 MPa\"\ntravel = \"20 um\"\n[[clamp.stage]]\nkind = \"release\"\ntime = \"0.1 ms\"\n[air]\npressure = \"101.325 kPa\"\n";
    let pressed = "[clamp]\nclosing_speed = \"1 m/s\"\nstop = \"20 us\"\n";
    let bench = bench_of(&TABLES.replace(pressed, stages));
    let said = bench.ran("run", PLAIN, END).sentence();
    let stages: Vec<String> = bench.column("stage");
    let rows = stages.iter().filter(|stage| *stage == "1").count();
    let held: f64 = bench.column("wp_total_um")[rows - 1].parse().unwrap();
    let end: f64 = last(&bench, "wp_total_um").parse().unwrap();
    println!("{said}");
    assert!((end / held - 1.0).abs() > 0.1, "{held} {end}");
    let wp = format!(
        "WP {end:.2} um ({held:.2} um before the release; with an error of up to its difference"
    );
    assert!(said.contains(&wp), "{said}");
}

#[test]
fn a_run_that_fails_leaves_its_sentence() {
    let bench = Bench::new("scheme = \"explicit\"\ncfl = 1.5", "1.4 us", "0.01 us");
    let Err(RunFailure::Unstable { said, .. }) = bench.run("run", PLAIN, END, &[]) else {
        panic!("the run did not fail");
    };
    let summary = fs::read_to_string(bench.path("run/summary.json")).unwrap();
    let told: serde_json::Value = serde_json::from_str(&summary).unwrap();
    assert_eq!(told["end"], "failed");
    assert_eq!(told["verdict"]["reasons"][0], said.as_str());
    assert!(told["steps"].as_u64().unwrap() > 0 && told["time_s"].as_f64().unwrap() > 0.0);
    assert!(told["left_out"].is_array() && told["provenance"]["tool"] == "mpm-run");
}

#[test]
fn rows_tell_it_where_asked_and_scenes_without_a_bond_are_refused() {
    let bench = bench();
    let changes = ["output.penetration=false", "clamp.stop=1 us"];
    let summary = bench.run("run", PLAIN, END, &changes);
    assert!(summary.unwrap().unwrap().penetration.is_some());
    let history = fs::read_to_string(bench.path("run/history.csv")).unwrap();
    assert!(!history.contains("wp_"), "{history}");
    let plates = Bench::explicit();
    let said = plates.refusal(&["output.penetration=true"]);
    has(&said, &["measured of the bond of a bond file"]);
}

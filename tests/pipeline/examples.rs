//! The scripts of pipelines/examples/ as they are.

use std::path::PathBuf;

use crate::workbench::{VOXEL, Workbench, said};

fn script(name: &str) -> String {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../pipelines/examples");
    path.join(name).display().to_string()
}

#[test]
fn an_experiment_is_measured() {
    let bench = Workbench::with_bond();
    let script = script("measure-an-experiment.sh");
    let output = bench.shell(&format!("'{script}' specimen.npy '{VOXEL}' 'out folder'"));
    assert!(output.status.success(), "{}", said(&output));
    let table = String::from_utf8(output.stdout).unwrap();
    // Four layers of adhesive about the plane: WP = sqrt((0.5^2 + 1.5^2) / 2) voxels.
    let wp = 1.25_f64.sqrt() * 1.45;
    assert!(
        table.contains(&format!(",total,mid,2.320000000e-5,{wp:.6},")),
        "{table}"
    );
    for file in ["wp.csv", "map.csv", "depth.csv", "map.svg"] {
        assert!(bench.path("out folder").join(file).is_file(), "{file}");
    }
}

#[test]
fn a_specimen_is_pressed() {
    let bench = Workbench::with_bond();
    let script = script("press-a-specimen.sh");
    let output = bench.shell(&format!(
        "'{script}' specimen.npy '{VOXEL}' case.toml out --set 'clamp.stop=0.2 us'"
    ));
    assert!(output.status.success(), "{}", said(&output));
    let table = String::from_utf8(output.stdout).unwrap();
    assert!(table.lines().next().unwrap().contains("dice"), "{table}");
    assert!(table.contains(",total,"), "{table}");
    for file in ["run/final.mpts", "shear.csv", "pressure.svg", "final.png"] {
        assert!(bench.path("out").join(file).is_file(), "{file}");
    }
}

#[test]
fn viscosities_are_swept_and_a_second_sweep_only_adds() {
    let bench = Workbench::with_bond();
    let script = script("sweep-viscosity.sh");
    let line = |values: &str| format!("'{script}' bond.mpts case.toml out {values}");
    let first = bench.shell(&line("'200 cP' '400 cP'"));
    assert!(first.status.success(), "{}", said(&first));
    let state = bench.read("out/200cP/final.mpts");
    let second = bench.shell(&line("'200 cP' '400 cP' '800 cP'"));
    assert!(second.status.success(), "{}", said(&second));
    let table = String::from_utf8(second.stdout).unwrap();
    // A header and three sides of three runs.
    assert_eq!(table.lines().count(), 10, "{table}");
    assert!(table.starts_with("viscosity,file,side"), "{table}");
    assert!(bench.read("out/200cP/final.mpts") == state, "run again");
}

/// `bond.mpts` of a small synthetic specimen of so many voxels.
fn small_bond(size: &str) -> Workbench {
    let bench = Workbench::new();
    let size = ["--size", size, "--slab", "14.5 um", "--seed", "1"];
    let wood = [
        &["--adhesive", "pf", "--voxel", VOXEL, "-o", "wood.tif"],
        &size[..],
    ]
    .concat();
    bench.done("synth-xct", &wood);
    bench.done(
        "xct2particles",
        &["wood.tif", "--voxel", VOXEL, "-o", "wood.mpts"],
    );
    bench.done(
        "build-bondline",
        &["wood.mpts", "--normal", "y", "-o", "bond.mpts"],
    );
    bench
}

/// Liquid that dries a million times as thick in the corners of cells at its walls is solved as other liquid is: those corners do not
/// make their neighbours as thick, and what drags them along is not what the solver's tolerance is relative to.
#[test]
fn liquid_that_dries_at_once_at_its_walls_is_solved() {
    let bench = small_bond("40x96x40");
    let case = std::fs::read_to_string(script("../cases/pf-implicit.toml")).unwrap();
    let water = "[adhesive.water]\nsolids = 0.45\nuptake = \"20 um/s\"\ndiffusivity = \"1e-10 m2/s\"\n\
                 viscosity_by_solids = [[0.45, 1.0], [0.55, 100.0], [0.65, 1e6]]\n";
    bench.write("case.toml", case + water);
    let run = [
        "case.toml",
        "--particles",
        "bond.mpts",
        "-o",
        "run",
        "--set",
        "clamp.closing_speed=\"10 mm/s\"",
        "--set",
        "output.history_every=\"0.01 ms\"",
    ];
    bench.done("mpm-run", &run);
    let history = String::from_utf8(bench.read("run/history.csv")).unwrap();
    for row in history.lines().skip(1) {
        let pressures = row.split(',').skip(6).take(2);
        let pressures: Vec<f64> = pressures.map(|p| p.parse().unwrap()).collect();
        let apart = (pressures[1] / pressures[0] - 1.0).abs();
        assert!(apart < 0.02, "one side bears more than the other: {row}");
    }
}

/// Contact lines that turn around in the solves of a step hold and go as its flow asks for.
#[test]
fn contact_lines_settle_in_wood() {
    let bench = small_bond("24x64x24");
    let case = std::fs::read_to_string(script("wicking-pf.toml")).unwrap();
    assert!(case.contains("time = \"4 ms\""));
    bench.write(
        "case.toml",
        case.replace("time = \"4 ms\"", "time = \"2 ms\""),
    );
    let angle = "adhesive.receding_angle=\"20 deg\"";
    let run = [
        "case.toml",
        "--particles",
        "bond.mpts",
        "-o",
        "run",
        "--set",
        angle,
    ];
    bench.done("mpm-run", &run);
    let summary = String::from_utf8(bench.read("run/summary.json")).unwrap();
    let settled = "\"steps whose contact lines did not settle\": 0,";
    assert!(summary.contains(settled), "{summary}");
}

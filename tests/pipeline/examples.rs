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

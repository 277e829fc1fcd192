//! The scripts of pipelines/examples/ as they are.

use crate::workbench::{VOXEL, Workbench, root};

fn script(bench: &Workbench, name: &str, arguments: &str) -> String {
    let script = root().join("pipelines/examples").join(name);
    bench.done(&format!("'{}' {arguments}", script.display()))
}

fn assert_files(bench: &Workbench, folder: &str, files: &[&str]) {
    for file in files {
        assert!(bench.path(folder).join(file).is_file(), "{file}");
    }
}

#[test]
fn an_experiment_is_measured() {
    let bench = Workbench::with_bond();
    let arguments = format!("specimen.npy {VOXEL} 'out folder'");
    let table = script(&bench, "measure-an-experiment.sh", &arguments);
    // Four layers of adhesive about the plane: WP = sqrt((0.5^2 + 1.5^2) / 2) voxels.
    let wp = 1.25_f64.sqrt() * 1.45;
    let row = format!(",total,mid,2.320000000e-5,{wp:.6},");
    assert!(table.contains(&row), "{table}");
    assert_files(
        &bench,
        "out folder",
        &["wp.csv", "map.csv", "depth.csv", "map.svg"],
    );
}

#[test]
fn a_specimen_is_pressed() {
    let bench = Workbench::with_bond();
    let arguments = format!("specimen.npy {VOXEL} case.toml out --set 'clamp.stop=0.2 us'");
    let table = script(&bench, "press-a-specimen.sh", &arguments);
    assert!(table.lines().next().unwrap().contains("dice"), "{table}");
    assert!(table.contains(",total,"), "{table}");
    assert_files(
        &bench,
        "out",
        &["run/final.mpts", "shear.csv", "pressure.svg", "final.png"],
    );
}

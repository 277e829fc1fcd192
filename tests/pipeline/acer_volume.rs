//! The acer volumes: a real cross-section extruded by a program, its adhesive flooded in by a program
//! (docs/results/README.md#what-the-acer-volumes-are). They are not in the repository, so that these
//! tests are ignored; `make test` runs them where the folder is present.

use crate::workbench::{IMPLICIT, METHODS, Table, Workbench, root};

/// The tool's line on a file of the folder of shared data beside the repository.
fn converted(name: &str, more: &str) -> String {
    let stack = root().join("../shared/data").join(name);
    format!(
        "xct2particles '{}' -q --voxel 1.45um {more}",
        stack.display()
    )
}

/// The reference numbers of bondline-acer-240.json about y = 156 voxels, by an independent
/// program: all their four decimals.
#[test]
#[ignore = "needs the shared volumes, which are not in the repository"]
fn shared_data_has_the_known_penetration() {
    let stack = converted("bondline-acer-240.tif", "-o -");
    let bench = Workbench::new();
    let table = Table::new(&bench.done(&format!(
        "{stack} | wp-metrics - -q --reference plane=226.2um"
    )));
    let (sides, depths) = (["bottom", "top", "total"], table.column("wp_um"));
    let found = [depths[2], depths[1], depths[0], table.last("ep_um")];
    println!("WP total, top, bottom, EP (um): {found:?}");
    assert!(
        table
            .rows
            .iter()
            .zip(sides)
            .all(|(row, side)| row[1] == side)
    );
    for (found, known) in found.iter().zip([17.1586, 16.7128, 17.5810, 40.6666]) {
        assert!((found - known).abs() <= 0.5e-4, "{found} {known}");
    }
    assert_eq!(table.rows[2][10], "1615446");
}

/// Invariants of a short run in the acer volume, by both schemes. The crop of the crop keeps the
/// test cheap; the whole one is run by the studies.
#[test]
#[ignore = "needs the shared volumes, which are not in the repository"]
fn shared_data_keeps_liquid_out_of_wood_and_of_sealed_voids() {
    let bench = Workbench::with_bond();
    let crop = converted(
        "bondline-acer-64x192x128.tif",
        "--crop 30:62,66:126,0:24 -o -",
    );
    bench.done(&format!("{crop} | build-bondline - -q -o bond.mpts"));
    for method in [METHODS[1], &[IMPLICIT]] {
        bench.press("run", method, "--overwrite --set 'clamp.stop=0.9 us'");
        let number = |key: &str| bench.summary("run", key);
        let (in_wood, deepest) = (number("points_in_wood"), number("deepest_m"));
        let sealed = number("points_in_unreachable_voids");
        let change = number("volume_change");
        println!(
            "{method:?}: {in_wood} in wood, deepest {deepest:e} m; {sealed} in sealed voids; volume {change:+.5}"
        );
        // The explicit scheme resolves walls to about half a cell (docs/methods.md section 2.6).
        assert!(deepest <= 0.5 * 2.9e-6, "{method:?}: {deepest}");
        assert_eq!(sealed, 0.0, "{method:?}");
        assert!(change.abs() <= 0.005, "{method:?}: {change}");
    }
}

/// The maple as undamaged wood: its adhesive taken for air, the two pieces laid up again, and one
/// of them cut and turned to plywood.
#[test]
#[ignore = "needs the shared volumes, which are not in the repository"]
fn shared_data_is_bonded_as_undamaged_wood() {
    let bench = Workbench::with_bond();
    let labels = "--labels 'void=0|255,wood=128' --crop 30:62,66:126,0:32 -o wood.mpts";
    bench.done(&converted("bondline-acer-64x192x128.tif", labels));
    for options in ["--plane 43.5um", "--plane 24um --turn-top 90"] {
        bench.done(&format!(
            "build-bondline wood.mpts {options} --slab 8.7um -o bond.mpts"
        ));
        bench.press("run", &[IMPLICIT, "clamp.stop=0.9 us"], "--overwrite");
        assert_eq!(bench.measured("run/final.mpts").rows[2][1], "total");
        assert_eq!(bench.summary("run", "points_in_unreachable_voids"), 0.0);
    }
}

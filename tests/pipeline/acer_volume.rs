//! The acer volumes: a real cross-section extruded by a program, its adhesive flooded in by a program
//! (docs/results/README.md#what-the-acer-volumes-are). They are not in the repository, so that these
//! tests are ignored; `make test` runs them where the folder is present.

use crate::workbench::{IMPLICIT, METHODS, Workbench, root};

/// The tool's line on a file of the folder of shared data beside the repository.
fn converted(name: &str, more: &str) -> String {
    let stack = root().join("../shared/data").join(name);
    format!(
        "xct2particles '{}' -q --voxel 1.45um {more}",
        stack.display()
    )
}

/// Short runs end sound, without liquid in voids that no path connects to the bond: of a crop of the crop by both schemes, of
/// the maple as undamaged wood, its adhesive taken for air and the two pieces laid up again, and of plywood of one of them.
#[test]
#[ignore = "needs the shared volumes, which are not in the repository"]
fn shared_data_is_pressed_and_keeps_sealed_voids_free() {
    let bench = Workbench::with_bond();
    let stack = "bondline-acer-64x192x128.tif";
    let crop = converted(stack, "--crop 30:62,66:126,0:24 -o bonded.mpts");
    let labels = "--labels 'void=0|255,wood=128'";
    let wood = converted(
        stack,
        &format!("{labels} --crop 30:62,66:126,0:32 -o wood.mpts"),
    );
    bench.done(&format!("{crop}; {wood}"));
    for (build, method) in [
        ("bonded.mpts", METHODS[1]),
        ("bonded.mpts", &[IMPLICIT]),
        ("wood.mpts --plane 43.5um --slab 8.7um", &[IMPLICIT]),
        (
            "wood.mpts --plane 24um --turn-top 90 --slab 8.7um",
            &[IMPLICIT],
        ),
    ] {
        bench.done(&format!("build-bondline -q {build} -o bond.mpts"));
        bench.press("run", method, "--overwrite --set 'clamp.stop=0.9 us'");
        let of = |key| bench.summary("run", key);
        let (deepest, change) = (of("deepest_m"), of("volume_change"));
        assert_eq!(of("points_in_unreachable_voids"), 0.0, "{build}");
        // The explicit scheme resolves walls to about half a cell (docs/methods.md section 2.6).
        assert!(deepest <= 0.5 * 2.9e-6, "{build}: {deepest}");
        assert!(change.abs() <= 0.005, "{build}: {change}");
        assert!(bench.measured("run/final.mpts").last("wp_um") > 0.0);
    }
}

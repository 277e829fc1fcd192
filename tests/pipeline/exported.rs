//! The stack that a pressed state is exported to says what the state says.

use voxels::Stack;

use crate::workbench::{CASE, METHODS, Workbench};

/// The labels of a stack.
fn labels(bench: &Workbench, file: &str) -> Vec<u8> {
    let stack = Stack::open(&[bench.path(file)]).unwrap();
    let (mut all, mut page) = (Vec::new(), Vec::new());
    for z in 0..stack.dims()[2] {
        stack.read_page(z, &mut page).unwrap();
        all.extend_from_slice(&page);
    }
    all
}

/// Counting the voxels that hold a point loses a fifth to a quarter of the volume here.
#[test]
fn a_pressed_state_keeps_volume_wp_and_ep_in_its_stack() {
    let bench = Workbench::with_wood("--adhesive pf --size 24x64x24 --slab 14.5um --seed 7", CASE);
    for method in &METHODS[1..] {
        bench.press("run", method, "--overwrite");
        let state = "run/final.mpts";
        bench.done(&format!("particles export -q {state} -o a.tif"));
        let [ours, theirs] = [state, "a.tif"].map(|file| bench.measured(file));
        let error = ["wp_um", "ep_um", "volume_um3"].map(|c| theirs.last(c) / ours.last(c) - 1.0);
        println!("{method:?}: WP, EP, volume off by {error:.5?}");
        // Voxels are full or void: those of a front that are filled in part fall to the fullest, which lie nearer to the bond.
        assert!(error[0].abs() < 0.025, "{error:?}");
        assert!(
            error[1].abs() < 0.005 && error[2].abs() < 0.005,
            "{error:?}"
        );

        // The .vti holds the very same labels.
        bench.done(&format!("particles export -q {state} -o a.vti"));
        let vti = bench.read("a.vti");
        let arrays = vti.strip_suffix(b"\n</AppendedData>\n</VTKFile>\n");
        assert!(
            arrays.unwrap().ends_with(&labels(&bench, "a.tif")),
            "{method:?}"
        );
    }
}

//! The stack that a pressed state is exported to says what the state says.

use std::collections::HashMap;

use voxels::{Stack, VOID, WOOD};

use crate::workbench::{CASE, METHODS, Workbench};

/// Numbers of voxels along x, y, z and the labels of a stack.
fn labels(bench: &Workbench, file: &str) -> ([usize; 3], Vec<u8>) {
    let stack = Stack::open(&[bench.path(file)]).unwrap();
    let (mut all, mut page) = (Vec::new(), Vec::new());
    for z in 0..stack.dims()[2] {
        stack.read_page(z, &mut page).unwrap();
        all.extend_from_slice(&page);
    }
    (stack.dims(), all)
}

/// The voxels of the cube of this reach about one.
fn around([x, y, z]: [i64; 3], reach: i64) -> impl Iterator<Item = [i64; 3]> {
    let side = move || -reach..=reach;
    side().flat_map(move |k| side().flat_map(move |j| side().map(move |i| [x + i, y + j, z + k])))
}

/// Void voxels of the export about which the points' density in the open voxels of 5 x 5 x 5,
/// counted by the voxel that holds a point, is within 1 % of the liquid's own, and of 3 x 3 x 3
/// no less: holes in what is full.
fn holes(bench: &Workbench, state: &str, stack: &str) -> usize {
    let file = bench.particles(state);
    let (dims, labels) = labels(bench, stack);
    // Outside is wood.
    let at = |voxel: [i64; 3]| {
        let inside = (0..3).all(|a| (0..dims[a] as i64).contains(&voxel[a]));
        let [x, y, z] = voxel.map(|i| i as usize);
        if inside {
            labels[(z * dims[1] + y) * dims[0] + x]
        } else {
            WOOD
        }
    };
    let voxel = file.header().voxel_m;
    let (position, volume) = file.liquid().unwrap();
    let mut held: HashMap<[i64; 3], f64> = HashMap::new();
    for (p, &v) in position.iter().zip(volume) {
        let place = p.map(|x| (f64::from(x) / voxel).floor() as i64);
        *held.entry(place).or_default() += f64::from(v) / voxel.powi(3);
    }
    let density = |voxel: [i64; 3], reach: i64| {
        let volume: f64 = around(voxel, reach).filter_map(|v| held.get(&v)).sum();
        let open = around(voxel, reach).filter(|&v| at(v) != WOOD).count();
        volume / open as f64
    };
    let reached = held.keys().flat_map(|&voxel| around(voxel, 1));
    let mut void: Vec<[i64; 3]> = reached.filter(|&voxel| at(voxel) == VOID).collect();
    void.sort_unstable();
    void.dedup();
    let full =
        |&voxel: &[i64; 3]| (density(voxel, 2) - 1.0).abs() < 0.01 && density(voxel, 1) >= 0.99;
    void.into_iter().filter(full).count()
}

/// Counting the voxels that hold a point loses a fifth to a quarter of the volume here.
#[test]
fn a_pressed_state_keeps_volume_wp_and_ep_in_its_stack() {
    let bench = Workbench::with_wood("--adhesive pf --size 32x80x32 --slab 14.5um --seed 7", CASE);
    for method in &METHODS[1..] {
        bench.press("run", method, "--overwrite");
        let state = "run/final.mpts";
        bench.done(&format!("particles export -q {state} -o a.tif"));
        let [ours, theirs] = [state, "a.tif"].map(|file| bench.measured(file));
        let error = ["wp_um", "ep_um", "volume_m3"].map(|c| theirs.last(c) / ours.last(c) - 1.0);
        let holes = holes(&bench, state, "a.tif");
        println!("{method:?}: WP, EP, volume off by {error:.5?}, {holes} holes");
        // Voxels are full or void: those of a front that are filled in part fall to the fullest, which lie nearer to the bond.
        assert!(error[0].abs() < 0.025, "{error:?}");
        assert!(
            error[1].abs() < 0.005 && error[2].abs() < 0.005,
            "{error:?}"
        );
        assert_eq!(holes, 0);

        // The .vti holds the very same labels.
        bench.done(&format!("particles export -q {state} -o a.vti"));
        let vti = bench.read("a.vti");
        let arrays = vti.strip_suffix(b"\n</AppendedData>\n</VTKFile>\n");
        assert!(
            arrays.unwrap().ends_with(&labels(&bench, "a.tif").1),
            "{method:?}"
        );
    }
}

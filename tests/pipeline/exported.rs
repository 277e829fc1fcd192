//! The stack that a pressed state is exported to says what the state says.

use std::collections::HashMap;

use voxels::{Stack, VOID, WOOD};

use crate::workbench::{CASE, METHODS, Workbench};

/// Side `total` of a table of wp-metrics: WP, EP and volume.
fn total(bench: &Workbench, file: &str) -> [f64; 3] {
    let table = bench.done("wp-metrics", &["-q", file]);
    let row: Vec<&str> = table.lines().last().unwrap().split(',').collect();
    assert_eq!(row[1], "total");
    [4, 6, 9].map(|i| row[i].parse().unwrap())
}

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
    let density = |[x, y, z]: [i64; 3], reach: i64| {
        let (mut volume, mut open) = (0.0, 0.0);
        for k in z - reach..=z + reach {
            for j in y - reach..=y + reach {
                for i in x - reach..=x + reach {
                    volume += held.get(&[i, j, k]).copied().unwrap_or(0.0);
                    open += f64::from(u8::from(at([i, j, k]) != WOOD));
                }
            }
        }
        volume / open
    };
    let reached = held.keys().flat_map(|&[x, y, z]| {
        (-1..=1).flat_map(move |k| {
            (-1..=1).flat_map(move |j| (-1..=1).map(move |i| [x + i, y + j, z + k]))
        })
    });
    let mut void: Vec<[i64; 3]> = reached.filter(|&voxel| at(voxel) == VOID).collect();
    void.sort_unstable();
    void.dedup();
    let full =
        |&voxel: &[i64; 3]| (density(voxel, 2) - 1.0).abs() < 0.01 && density(voxel, 1) >= 0.99;
    void.iter().copied().filter(full).count()
}

/// Counting the voxels that hold a point loses a fifth to a quarter of the volume here.
#[test]
fn a_pressed_state_keeps_volume_wp_and_ep_in_its_stack() {
    let bench = Workbench::new();
    bench.write("case.toml", CASE);
    let made = bench.shell(
        "synth-xct -q --adhesive pf --size 32x80x32 --slab '14.5 um' --seed 7 -o - |
         xct2particles - -q -o - | build-bondline - -q -o bond.mpts",
    );
    assert!(made.status.success());
    for method in &METHODS[1..] {
        bench.pressed("run", method, &["--overwrite"]);
        let state = "run/final.mpts";
        bench.done("particles", &["export", "-q", state, "-o", "a.tif"]);
        let [ours, theirs] = [state, "a.tif"].map(|file| total(&bench, file));
        let error = [0, 1, 2].map(|i| theirs[i] / ours[i] - 1.0);
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
        bench.done("particles", &["export", "-q", state, "-o", "a.vti"]);
        let vti = bench.read("a.vti");
        let labels = labels(&bench, "a.tif").1;
        let arrays = vti.strip_suffix(b"\n</AppendedData>\n</VTKFile>\n");
        assert!(arrays.unwrap().ends_with(&labels), "{method:?}");
    }
}

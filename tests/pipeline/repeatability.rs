//! The same bytes for any number of threads, across repeats and for any bond normal.

use std::fs;

use crate::workbench::{METHODS, VOXEL, Workbench, grooved, npy, press};

#[test]
fn a_run_is_the_same_for_any_threads_and_every_time() {
    let bench = Workbench::with_bond();
    for method in METHODS {
        let results = [("one", 1), ("two", 2), ("again", 2)].map(|(folder, threads)| {
            bench.press(folder, method, &format!("--threads {threads} --overwrite"));
            let states = bench.names(&format!("{folder}/snapshots")).into_iter();
            let states = states
                .map(|name| format!("snapshots/{name}"))
                .chain(["final.mpts".into()]);
            let sums = states.map(|state| (bench.sum(&format!("{folder}/{state}")), state));
            (
                sums.collect::<Vec<_>>(),
                bench.read(&format!("{folder}/history.csv")),
            )
        });
        let (sums, rows) = &results[0];
        assert!(sums.len() >= 4 && rows.len() > 500, "{method:?}: {sums:?}");
        // A sum that did not see the state would be the same for the first snapshot.
        assert_ne!(sums.first().unwrap().0, sums.last().unwrap().0);
        assert!(
            results[1] == results[0] && results[2] == results[0],
            "{method:?}"
        );
    }
}

#[test]
fn every_tool_writes_the_same_bytes_for_any_threads() {
    let bench = Workbench::with_bond();
    bench.press("run", &["clamp.stop=0.05 us"], "");
    for line in [
        "synth-xct --adhesive pf --size 64x96x40 -o -",
        "synth-xct --adhesive none --species spruce --size 40x60x30 --voxel 200nm -o -",
        &format!("xct2particles specimen.npy --voxel {VOXEL} -o -"),
        "build-bondline specimen.mpts -o -",
        "wp-metrics run/final.mpts --compare specimen.mpts",
        "shear-stats run/final.mpts",
        "bond-figures slice run/final.mpts -o -",
        "particles export -f vtp run/final.mpts -o -",
    ] {
        // The command line, which the provenance holds, must be the same: threads by environment.
        let bytes = ["1", "2", "2"].map(|threads| {
            let output = bench
                .command(line)
                .env("RAYON_NUM_THREADS", threads)
                .output();
            output.unwrap().stdout
        });
        assert!(bytes[0].len() > 100, "{line}");
        assert!(bytes[0] == bytes[1] && bytes[1] == bytes[2], "{line}");
    }
}

/// More threads than are of use are not started: a run would take hours.
#[test]
fn threads_are_limited_by_the_cores() {
    let bench = Workbench::with_bond();
    let short = ["clamp.stop=0.05 us"];
    bench.press("one", &short, "--threads 1");
    bench.ends(0, &press("many", &short, "--threads 4096"), "4096 threads");
    assert_eq!(bench.sum("many/final.mpts"), bench.sum("one/final.mpts"));
}

/// The same specimen lying on its side gives the same metrics and the same run, to the last
/// bit: solvers know one frame only.
#[test]
fn the_axis_across_the_bond_does_not_matter() {
    let bench = Workbench::with_bond();
    let table = |specimen: &str, normal: &str| {
        let measured = bench.measured(&format!("--normal {normal} {specimen}"));
        let named = |mut row: Vec<String>| row.split_off(1);
        measured.rows.into_iter().map(named).collect::<Vec<_>>()
    };
    let turned = [
        ("x", npy([32, 16, 16], |x, y, z| grooved(y, x, z))),
        ("z", npy([16, 16, 32], |x, y, z| grooved(x, z, y))),
    ];
    for (normal, stack) in &turned {
        bench.write("turned.npy", stack);
        bench.convert("turned.npy", "turned.mpts");
        assert_eq!(table("turned.mpts", normal), table("specimen.mpts", "y"));
        bench.done(&format!(
            "build-bondline -q turned.mpts --normal {normal} -o {normal}.mpts"
        ));
    }
    fs::copy(bench.path("bond.mpts"), bench.path("y.mpts")).unwrap();
    for scheme in ["explicit", "implicit"] {
        let pressed = ["x", "y", "z"].map(|normal| {
            bench.done(&format!(
                "mpm-run -q case.toml --particles {normal}.mpts --set integrator.scheme={scheme} -o {normal} --overwrite"
            ));
            let state = table(&format!("{normal}/final.mpts"), normal);
            (bench.read(&format!("{normal}/history.csv")), state)
        });
        assert!(pressed[0] == pressed[1], "{scheme}, x and y differ");
        assert!(pressed[2] == pressed[1], "{scheme}, z and y differ");
    }
}

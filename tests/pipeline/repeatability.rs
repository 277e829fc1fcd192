//! The same bytes for any number of threads, across repeats and for any bond normal.

use std::fs;

use crate::workbench::{METHODS, VOXEL, Workbench, grooved, npy, said};

#[test]
fn a_run_is_the_same_for_any_threads_and_every_time() {
    let bench = Workbench::with_bond();
    for method in METHODS {
        let runs = [("one", "1"), ("two", "2"), ("again", "2")];
        for (folder, threads) in runs {
            bench.pressed(folder, method, &["--threads", threads, "--overwrite"]);
        }
        let sum = bench.sum("one/final.mpts");
        let names = bench.names("one/snapshots");
        let rows = bench.read("one/history.csv");
        assert!(
            names.len() >= 3 && rows.len() > 500,
            "{method:?}: {names:?}"
        );
        for folder in ["two", "again"] {
            assert_eq!(
                bench.sum(&format!("{folder}/final.mpts")),
                sum,
                "{method:?}"
            );
            assert_eq!(
                bench.read(&format!("{folder}/history.csv")),
                rows,
                "{method:?}"
            );
            assert_eq!(
                bench.names(&format!("{folder}/snapshots")),
                names,
                "{method:?}"
            );
            for name in &names {
                let [a, b] = ["one", folder].map(|f| bench.sum(&format!("{f}/snapshots/{name}")));
                assert_eq!(a, b, "{method:?} {name}");
            }
        }
        // A sum that did not see the state would be the same for the first snapshot.
        assert_ne!(bench.sum(&format!("one/snapshots/{}", names[0])), sum);
    }
}

#[test]
fn every_tool_writes_the_same_bytes_for_any_threads() {
    let bench = Workbench::with_bond();
    bench.pressed("run", &[], &[]);
    let commands: [&[&str]; 7] = [
        &[
            "synth-xct",
            "--adhesive",
            "pf",
            "--size",
            "32x64x32",
            "-o",
            "-",
        ],
        &["xct2particles", "specimen.npy", "--voxel", VOXEL, "-o", "-"],
        &["build-bondline", "specimen.mpts", "-o", "-"],
        &["wp-metrics", "run/final.mpts", "--compare", "specimen.mpts"],
        &["shear-stats", "run/final.mpts"],
        &["bond-figures", "slice", "run/final.mpts", "-o", "-"],
        &[
            "particles",
            "export",
            "-f",
            "vtp",
            "run/final.mpts",
            "-o",
            "-",
        ],
    ];
    for command in commands {
        // The command line, which the provenance holds, must be the same: threads by environment.
        let bytes = ["1", "2", "2"].map(|threads| {
            let mut run = bench.command(command[0], &command[1..]);
            let output = run.env("RAYON_NUM_THREADS", threads).output().unwrap();
            assert!(output.status.success(), "{command:?}");
            output.stdout
        });
        assert!(bytes[0].len() > 100, "{command:?}");
        assert!(bytes[0] == bytes[1] && bytes[1] == bytes[2], "{command:?}");
    }
}

/// More threads than are of use are not started: a run would take hours.
#[test]
fn threads_are_limited_by_the_cores() {
    let bench = Workbench::with_bond();
    let short = ["clamp.stop=0.05 us"];
    bench.pressed("one", &short, &["--threads", "1"]);
    let output = bench.press("many", &short, &["--threads", "4096"]);
    assert!(output.status.success(), "{}", said(&output));
    assert!(said(&output).contains("4096 threads"), "{}", said(&output));
    assert_eq!(bench.sum("many/final.mpts"), bench.sum("one/final.mpts"));
}

/// The same specimen lying on its side gives the same metrics and the same run, to the last
/// bit: solvers know one frame only.
#[test]
fn the_axis_across_the_bond_does_not_matter() {
    let bench = Workbench::with_bond();
    let table = |specimen: &str, normal: &str| {
        let csv = bench.done("wp-metrics", &["--normal", normal, specimen]);
        csv.lines()
            .map(|line| line.split_once(',').unwrap().1.to_owned())
            .collect::<Vec<_>>()
    };
    let turned = [
        ("x", npy([32, 16, 16], |x, y, z| grooved(y, x, z))),
        ("z", npy([16, 16, 32], |x, y, z| grooved(x, z, y))),
    ];
    for (normal, stack) in &turned {
        bench.write("turned.npy", stack);
        bench.convert("turned.npy", "turned.mpts");
        assert_eq!(table("turned.mpts", normal), table("specimen.mpts", "y"));
        let bond = format!("{normal}.mpts");
        let arguments = ["-q", "turned.mpts", "--normal", normal, "-o", &bond];
        bench.done("build-bondline", &arguments);
    }
    fs::copy(bench.path("bond.mpts"), bench.path("y.mpts")).unwrap();
    for scheme in ["explicit", "implicit"] {
        let scheme = format!("integrator.scheme={scheme}");
        let pressed = ["x", "y", "z"].map(|normal| {
            let bond = format!("{normal}.mpts");
            let mut arguments = vec!["-q", "case.toml", "--particles", &bond, "--set", &scheme];
            arguments.extend(["-o", normal, "--overwrite"]);
            bench.done("mpm-run", &arguments);
            let state = table(&format!("{normal}/final.mpts"), normal);
            (bench.read(&format!("{normal}/history.csv")), state)
        });
        assert!(pressed[0] == pressed[1], "{scheme}, x and y differ");
        assert!(pressed[2] == pressed[1], "{scheme}, z and y differ");
    }
}

//! Runs that `make` starts and keeps: runs that are killed, twice at once, found not sound, or too long to be
//! started unasked.

use std::os::unix::process::CommandExt;
use std::process::Stdio;
use std::thread::sleep;
use std::time::Duration;

use crate::clone::{clone, command, make, table};
use crate::workbench::{Workbench, grooved, npy, said};

const STACK: [&str; 3] = [
    "XCT_PF=a.npy",
    "VOXEL=1.45 um",
    "SET=output.history_every=1 ns",
];

/// The copy with a stack.
fn with_stack() -> Workbench {
    let bench = clone();
    bench.write("a.npy", npy([16, 32, 16], grooved));
    bench
}

/// Ends a make and all that it has started, at a moment.
fn killed(bench: &Workbench, milliseconds: u64) {
    let mut make = command(bench, &[&STACK[..], &["OUT=killed", "table2"]].concat())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .process_group(0)
        .spawn()
        .unwrap();
    sleep(Duration::from_millis(milliseconds));
    bench.shell(&format!("kill -KILL -- -{}", make.id()));
    make.wait().unwrap();
}

#[test]
fn kills_at_any_moment_and_another_make_change_nothing() {
    let bench = with_stack();
    let whole = table(&bench, "whole", &STACK).unwrap();
    for moment in [150, 300, 450, 600, 800, 1000] {
        killed(&bench, moment);
    }
    assert_eq!(table(&bench, "killed", &STACK).as_ref(), Some(&whole));
    // Two at once, of other variables: each shows its own.
    let other = [&STACK[..2], &["SET=adhesive.viscosity=5 Pa s"]].concat();
    let variables = [&STACK[..], &other];
    let both = variables.map(|arguments| {
        let mut make = command(
            &bench,
            &[arguments, &["OUT=both", "V=1", "table2"]].concat(),
        );
        let make = make.stdout(Stdio::piped()).stderr(Stdio::piped());
        make.spawn().unwrap()
    });
    for (made, arguments) in both.into_iter().zip(variables) {
        let made = made.wait_with_output().unwrap();
        assert!(made.status.success(), "{}", said(&made));
        let anew = table(&bench, "alone", arguments).unwrap();
        let shown = String::from_utf8_lossy(&made.stdout);
        assert!(shown.contains(&anew), "{anew}{shown}");
    }
}

/// A goal of a run that takes a minute.
const LONG: &str = "XCT_PF=a.npy VOXEL='1.45 um' SET='clamp.closing_speed=1 mm/s' RUNS=flip YES=1";

/// Runs of `mpm-run` into a folder of the bench.
fn at_work(bench: &Workbench, out: &str) -> usize {
    let found = bench.done(&format!("pgrep -fc '[m]pm-run .*-o {out}/pf/flip' || true"));
    found.trim().parse().unwrap()
}

fn within(seconds: u64, what: impl Fn() -> bool) -> bool {
    let tries = seconds * 10;
    (0..tries).any(|_| {
        sleep(Duration::from_millis(100));
        what()
    })
}

/// SIGTERM to make left its runs at work, and the next make waited without a word of whom for.
#[test]
fn a_make_that_is_told_to_end_ends_its_runs_and_one_that_waits_says_for_whom() {
    let bench = with_stack();
    // A terminal signals all of its processes, a batch system one.
    for (signal, to) in [("TERM", ""), ("INT", "-"), ("HUP", "-"), ("KILL", "-")] {
        // A name that no other test's runs have.
        let name = bench.folder().file_name().unwrap().to_string_lossy();
        let out = format!("{signal}{name}");
        // The tests themselves may have been begun with signals ignored.
        let make =
            "exec env -u MAKEFLAGS --default-signal=INT,TERM,HUP make -s CARGO=true ERROR=no";
        let mut make = bench
            .command(&format!("{make} {LONG} OUT={out} runs"))
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .process_group(0)
            .spawn()
            .unwrap();
        assert!(within(60, || at_work(&bench, &out) > 0), "{signal}: no run");
        if signal == "TERM" {
            let waits = format!("env -u MAKEFLAGS timeout 5 make -s CARGO=true OUT={out} table2");
            let told = said(&bench.shell(&waits));
            assert!(
                told.contains(&format!("waiting for what is at work in {out}")),
                "{told}"
            );
            assert!(
                told.contains("mpm-run pipelines/cases/pf-flip.toml"),
                "{told}"
            );
        }
        bench.shell(&format!("kill -{signal} -- {to}{}", make.id()));
        let status = make.wait().unwrap();
        assert!(!status.success(), "{signal}");
        assert!(
            within(10, || at_work(&bench, &out) == 0),
            "{signal}: at work"
        );
    }
}

/// A record of a target that was removed by an interrupted make kept every later make from making it.
#[test]
fn a_record_without_its_target_is_none() {
    let bench = with_stack();
    let whole = table(&bench, "o", &STACK).unwrap();
    for target in [
        "pf/bond.mpts",
        "pf/experiment.mpts",
        "pf/implicit/final.mpts",
        "table2.csv",
    ] {
        let (folder, name) = target.rsplit_once('/').unwrap_or((".", target));
        // As it was left: all that the target was made of, and not the target.
        bench.done(&format!(
            "cd o/{folder}; rm {name}; sed -i '2,${{/\t[^\t]*{name}$/d}}' .made/{name}; test -s .made/{name}"
        ));
        assert_eq!(
            table(&bench, "o", &STACK).as_ref(),
            Some(&whole),
            "{target}"
        );
    }
    // One that is removed while it is made is not recorded.
    let script = "echo x >t; rm t";
    let line = format!("BIN=target/release pipelines/made.sh make o/t '{script}' '' a.npy");
    bench.ends(1, &line, "o/t was removed meanwhile");
    assert!(!bench.path("o/.made/t").exists());
}

/// Interrupted at any moment, by Ctrl-C or a batch system, make goes on.
#[test]
fn a_make_that_was_interrupted_goes_on() {
    let bench = with_stack();
    let whole = table(&bench, "whole", &STACK).unwrap();
    for (i, signal) in ["INT", "TERM", "INT", "HUP", "INT", "TERM", "INT"]
        .iter()
        .enumerate()
    {
        let after = 0.15 + 0.17 * i as f64;
        bench.shell(&format!(
            "env -u MAKEFLAGS --default-signal=INT,TERM,HUP timeout -s {signal} {after} make -s CARGO=true RUNS=implicit ERROR=no '{}' '{}' '{}' OUT=int table2",
            STACK[0], STACK[1], STACK[2]
        ));
    }
    assert_eq!(table(&bench, "int", &STACK).as_ref(), Some(&whole));
}

/// The user's table was replaced by its results, and two tables of one name shared theirs.
#[test]
fn a_sweep_by_make_replaces_no_table() {
    let bench = with_stack();
    let sweep = |table: &str| {
        let (goal, table) = ("sweep", format!("SWEEP={table}"));
        make(&bench, &[&table, "RESPONSE=", goal])
    };
    let rows = "clamp.stop,specimen.size\n0.05 us,24x64x24\n";
    bench.done("mkdir -p out/sweep a b");
    for name in [
        "out/sweep/mine.csv",
        "a/t.csv",
        "b/t.csv",
        "b/u.csv",
        "out/sweep/u-cost.csv",
    ] {
        bench.write(name, rows);
    }
    for (table, kept) in [
        ("out/sweep/mine.csv", "out/sweep/mine.csv"),
        ("b/u.csv", "out/sweep/u-cost.csv"),
    ] {
        let refused = sweep(table);
        assert!(
            !refused.status.success() && said(&refused).contains("is no result of a sweep"),
            "{}",
            said(&refused)
        );
        assert_eq!(bench.text(kept), rows);
    }
    let first = sweep("a/t.csv");
    assert!(first.status.success(), "{}", said(&first));
    let results = bench.read("out/sweep/t.csv");
    let second = sweep("b/t.csv");
    assert!(
        !second.status.success() && said(&second).contains("holds the sweep of"),
        "{}",
        said(&second)
    );
    assert!(bench.read("out/sweep/t.csv") == results);
    let again = sweep("a/t.csv");
    assert!(again.status.success(), "{}", said(&again));
}

/// A press that ends with more than its pressure: its clamp gives way more slowly than the ramp falls.
const UNSOUND: &str = include_str!("../unsound.toml");

/// make removed what the run had said that it keeps.
#[test]
fn a_run_that_is_not_sound_stays_and_is_told_again() {
    let bench = with_stack();
    bench.write("pipelines/cases/pf-implicit.toml", UNSOUND);
    let pressed = || {
        let goal = ["XCT_PF=a.npy", "VOXEL=1.45 um", "SET=", "OUT=o", "table2"];
        let made = make(&bench, &goal);
        let told = said(&made);
        assert!(!made.status.success(), "{told}");
        assert!(told.contains("not sound (kept, but marked"), "{told}");
        (told, String::from_utf8(made.stdout).unwrap())
    };
    let (_, planned) = pressed();
    assert!(planned.contains("1 run,"), "{planned}");
    let state = bench.read("o/pf/implicit/final.mpts");
    let (told, planned) = pressed();
    assert!(
        told.contains("has ended already") && planned.is_empty(),
        "{told}{planned}"
    );
    assert!(bench.read("o/pf/implicit/final.mpts") == state);
    // Another run takes its place.
    let other = ["XCT_PF=a.npy", "VOXEL=1.45 um", "SET=", "CELL=1 voxel"];
    table(&bench, "o", &other);
    assert!(bench.read("o/pf/implicit/final.mpts") != state);
}

#[test]
fn runs_of_more_than_an_hour_are_not_started_unasked() {
    let bench = with_stack();
    let slow = "SET=clamp.closing_speed=1 um/s";
    let long = ["RUNS=flip", slow, "OUT=o", "runs"];
    let refused = make(&bench, &[&STACK[..2], &long].concat());
    let plan = String::from_utf8_lossy(&refused.stdout);
    assert!(
        plan.contains("o/pf/flip") && plan.contains("1 run, "),
        "{plan}"
    );
    let told = said(&refused);
    assert!(
        !refused.status.success() && told.contains("YES=1 starts it"),
        "{told}"
    );
    assert!(!bench.path("o/pf/flip").exists());
}

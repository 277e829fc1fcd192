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

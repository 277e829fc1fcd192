//! Run folders: what one may replace, and what it may not.

use std::fs;

use studies::crash::{campaign, chains, faults, full_disk, together};

use crate::workbench::{Workbench, said};

const FAST: [&str; 2] = ["clamp.stop=0.05 us", "output.snapshots=2"];

/// Runs side by side ended in lines of which none said whose it was.
#[test]
fn the_closing_line_names_the_run() {
    let bench = Workbench::with_bond();
    let arguments = [
        "case.toml",
        "--particles",
        "bond.mpts",
        "-o",
        "third",
        "--set",
    ];
    let output = bench.run(
        "mpm-run",
        &[&arguments[..], &["clamp.stop=0.05 us"]].concat(),
    );
    let said = said(&output);
    assert!(said.contains("third: The run reached its time"), "{said}");
}

/// A folder of a version without marks is refused, and replaced where its owner says so.
#[test]
fn a_run_folder_without_a_mark_is_replaced_only_when_vouched_for() {
    let bench = Workbench::with_bond();
    bench.pressed("run", &FAST, &[]);
    fs::remove_file(bench.path("run/bondline-run.toml")).unwrap();
    let other = ["clamp.stop=0.04 us"];
    for more in [&["--overwrite"][..], &["--resume"], &[]] {
        let refused = bench.press("run", &other, more);
        assert_eq!(refused.status.code(), Some(2));
        assert!(
            said(&refused).contains("not marked as a run folder"),
            "{}",
            said(&refused)
        );
    }
    // Nor is it vouched for that it ended well.
    let refused = bench.press("run", &FAST, &["--resume"]);
    assert_eq!(refused.status.code(), Some(2), "{}", said(&refused));
    assert!(!bench.path("run/bondline-run.toml").exists());
    bench.write("run/bondline-run.toml", "");
    bench.pressed("run", &other, &["--overwrite"]);
}

/// 314e630 made the folder anew and ended well, without a history.
#[test]
fn a_run_whose_folder_is_moved_away_fails() {
    let bench = Workbench::with_bond();
    let removed = bench.shell(
        "mpm-run -q case.toml --particles bond.mpts -o run --set output.history_every=1ns \
         --set integrator.cfl=0.05 & until test -s run/history.csv; do sleep 0.01; done; \
         mv run gone; wait $! && exit 9 || exit $?",
    );
    assert_eq!(removed.status.code(), Some(1), "{}", said(&removed));
    assert!(
        said(&removed).contains("cannot write run"),
        "{}",
        said(&removed)
    );
    assert!(!bench.path("run").exists());
}

/// 314e630 let both end well, with the files of either.
#[test]
fn the_second_of_two_runs_into_a_folder_is_refused() {
    for row in [
        together::at_once(10).unwrap(),
        together::meanwhile(10).unwrap(),
    ] {
        println!("{}", row.line());
        assert!(row.wrong.is_empty(), "{:?}", row.wrong);
    }
}

/// `make crash` in short: every 19th kill and failing call, every 29th byte.
#[test]
fn a_run_killed_anywhere_goes_on_to_the_same_end() {
    let mut rows = Vec::new();
    if faults::available() {
        rows.extend(campaign::rows(19, |_| {}).unwrap());
        rows.extend(chains::rows(4, |_| {}).unwrap());
    } else {
        println!("skipped: strace is not installed or may not trace");
    }
    if full_disk::available() {
        rows.extend(full_disk::rows(29, |_| {}).unwrap());
    } else {
        println!("skipped: prlimit is not installed");
    }
    for row in rows {
        println!("{}", row.line());
        assert!(row.wrong.is_empty(), "{}: {:?}", row.series, row.wrong);
    }
}

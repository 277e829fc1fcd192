//! Run folders: what one may replace, and what it may not.

use studies::crash::{campaign, faults, full_disk, together};

use crate::workbench::{Workbench, press};

const FAST: [&str; 2] = ["clamp.stop=0.05 us", "output.snapshots=2"];

/// The closing line names the run: those side by side ended in lines of which none said whose it was.
#[test]
fn a_run_says_which_it_is_and_where_it_starts() {
    let bench = Workbench::with_bond();
    let line = press("run", &FAST, "").replace(" -q ", " ");
    bench.ends(0, &line, "run: The run reached its time");
    let mistyped = press("rnu", &FAST, "--resume").replace(" -q ", " ");
    let said = "'rnu' holds no run to continue: a new one starts";
    bench.ends(0, &mistyped, said);
    for name in ["final.mpts", "summary.json"] {
        std::fs::remove_file(bench.path("rnu").join(name)).unwrap();
    }
    let said = "'rnu' holds no checkpoint of this run: it starts again";
    bench.ends(0, &mistyped, said);
}

/// 314e630 made the folder anew and ended well, without a history.
#[test]
fn a_run_whose_folder_is_moved_away_fails() {
    let bench = Workbench::with_bond();
    let run = press(
        "run",
        &["output.history_every=1 ns", "integrator.cfl=0.05"],
        "",
    );
    let moved = "until test -s run/history.csv; do sleep 0.01; done; mv run gone; wait $! && exit 9 || exit $?";
    bench.ends(1, &format!("{run} & {moved}"), "cannot write run");
    assert!(!bench.path("run").exists());
}

/// 314e630 let both end well, with the files of either.
#[test]
fn the_second_of_two_runs_into_a_folder_is_refused() {
    for row in [together::at_once(10), together::meanwhile(10)] {
        let row = row.unwrap();
        assert!(row.wrong.is_empty(), "{:?}", row.wrong);
    }
}

/// `make crash` in short: every 19th kill and failing call, every 29th byte.
#[test]
fn a_run_killed_anywhere_goes_on_to_the_same_end() {
    let mut rows = Vec::new();
    if faults::available() {
        rows.extend(campaign::rows(19).unwrap());
        rows.extend(campaign::interrupted(4).unwrap());
    } else {
        println!("skipped: strace is not installed or may not trace");
    }
    if full_disk::available() {
        rows.extend(full_disk::rows(29).unwrap());
    } else {
        println!("skipped: prlimit is not installed");
    }
    for row in rows {
        assert!(row.wrong.is_empty(), "{}: {:?}", row.series, row.wrong);
    }
}

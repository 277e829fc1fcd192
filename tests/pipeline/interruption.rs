//! Stopped, killed and repeated runs.

use std::fs;
use std::process::{Child, Command};
use std::thread::sleep;
use std::time::{Duration, Instant};

use studies::stability::instability;

use crate::workbench::{Workbench, press};

/// Long enough that a signal arrives in the middle: several thousand steps.
const SLOW: [&str; 3] = [
    "clamp.stop=0.6 us",
    "integrator.cfl=0.05",
    "output.history_every=1 ns",
];

/// Starts a run and waits until its history has `rows` lines. `how` stands before the tool's name.
fn started(bench: &Workbench, how: &str, folder: &str, rows: usize) -> Child {
    let line = format!("{how} {}", press(folder, &SLOW, "--resume"));
    let child = bench.command(&line).spawn().unwrap();
    with_rows(bench, folder, child, rows)
}

/// `child` once the history of its run has `rows` lines.
fn with_rows(bench: &Workbench, folder: &str, mut child: Child, rows: usize) -> Child {
    let history = bench.path(folder).join("history.csv");
    let begun = Instant::now();
    while fs::read_to_string(&history).map_or(0, |text| text.lines().count()) < rows {
        assert!(
            child.try_wait().unwrap().is_none(),
            "{folder} ended too early"
        );
        assert!(begun.elapsed() < Duration::from_secs(60), "no history");
        sleep(Duration::from_millis(2));
    }
    child
}

/// Sends a signal so many times; the exit status.
fn sent(mut child: Child, signal: &str, times: u32) -> Option<i32> {
    for _ in 0..times {
        let id = child.id().to_string();
        let sent = Command::new("kill").args(["-s", signal, &id]).status();
        assert!(sent.unwrap().success());
    }
    child.wait().unwrap().code()
}

/// What clusters send before the end ended a run without a checkpoint. GNU `timeout` and batch systems send
/// SIGTERM more than once.
#[test]
fn every_warning_of_a_batch_system_stops_a_run_with_a_checkpoint() {
    let bench = Workbench::with_bond();
    for (signal, times) in [
        ("USR1", 1),
        ("USR2", 1),
        ("HUP", 1),
        ("XCPU", 1),
        ("TERM", 3),
    ] {
        // The tests themselves may have been begun by nohup.
        let how = format!("exec env --default-signal={signal}");
        let child = started(&bench, &how, signal, 20);
        assert_eq!(sent(child, signal, times), Some(75), "{signal}");
        assert!(
            bench.path(signal).join("checkpoint.mpts").is_file(),
            "{signal}"
        );
    }
}

/// `nohup` has a program begin with SIGHUP ignored.
#[test]
fn a_run_that_was_begun_to_ignore_a_signal_goes_on() {
    let bench = Workbench::with_bond();
    let child = started(&bench, "trap '' HUP; exec", "run", 20);
    let id = child.id();
    bench.done(&format!("kill -s HUP {id}"));
    let child = with_rows(&bench, "run", child, 120);
    assert_eq!(sent(child, "TERM", 1), Some(75));
}

/// A run that becomes unstable leaves its last checkpoint and results, and goes on from there at
/// a smaller Courant number; a liquid that flies apart stops again with a sentence. `make stability` does it
/// later in the press and by XPIC(5), too.
#[test]
fn an_unstable_run_leaves_its_checkpoint_and_goes_on_at_a_smaller_step() {
    for trial in instability::trials().into_iter().step_by(3) {
        let bench = Workbench::new();
        let row = trial.run(bench.folder()).unwrap();
        println!("{row:?}");
        assert!(row.checkpoint < row.unstable, "{row:?}");
        let named = "from the last checkpoint, run/checkpoint.mpts";
        assert!(row.said.contains(named), "{}", row.said);
        match (&row.then, trial.scene) {
            (Ok(steps), "press") => {
                assert!(*steps > row.unstable);
                let kept = format!("\"after_step\": {},", row.checkpoint);
                assert!(bench.text("run/summary.json").contains(&kept), "{kept}");
            }
            (Err(said), "torn apart, 150 m/s") => assert!(said.contains(named), "{said}"),
            (then, scene) => panic!("{scene}: {then:?}"),
        }
        let cfl = format!("cfl = {}", row.cfl[1]);
        assert!(bench.text("run/resolved.toml").contains(&cfl));
    }
}

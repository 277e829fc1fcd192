//! Stopped, killed and repeated runs.

use std::fs;
use std::process::{Child, Command};
use std::thread::sleep;
use std::time::{Duration, Instant};

use studies::stability::instability;

use crate::workbench::{Workbench, press_arguments};

/// Long enough that a signal arrives in the middle: several thousand steps.
const SLOW: [&str; 3] = [
    "clamp.stop=0.6 us",
    "integrator.cfl=0.05",
    "output.history_every=1 ns",
];

/// Starts a run and waits until its history has `rows` lines.
fn started(bench: &Workbench, folder: &str, changes: &[&str], more: &[&str], rows: usize) -> Child {
    let arguments = press_arguments(folder, changes, more);
    let child = bench.command("mpm-run", &arguments).spawn().unwrap();
    with_rows(bench, folder, child, rows)
}

/// `child` once the history of its run has `rows` lines.
fn with_rows(bench: &Workbench, folder: &str, mut child: Child, rows: usize) -> Child {
    let history = bench.path(folder).join("history.csv");
    let begun = Instant::now();
    while fs::read_to_string(&history).map_or(0, |text| text.lines().count()) < rows {
        assert!(
            child.try_wait().unwrap().is_none(),
            "the run ended too early"
        );
        assert!(begun.elapsed() < Duration::from_secs(60), "no history");
        sleep(Duration::from_millis(2));
    }
    child
}

fn send(child: &Child, signal: &str) {
    let sent = Command::new("kill")
        .args(["-s", signal, &child.id().to_string()])
        .status();
    assert!(sent.unwrap().success());
}

/// Sends SIGTERM more than once, as GNU `timeout` and batch systems do.
fn terminate(child: &mut Child) -> Option<i32> {
    for _ in 0..3 {
        send(child, "TERM");
    }
    child.wait().unwrap().code()
}

/// What clusters send before the end ended a run without a checkpoint.
#[test]
fn every_warning_of_a_batch_system_stops_a_run_with_a_checkpoint() {
    let bench = Workbench::with_bond();
    for signal in ["USR1", "USR2", "HUP", "XCPU"] {
        let arguments = press_arguments(signal, &SLOW, &[]).join("' '");
        // The tests themselves may have been begun by nohup.
        let line = format!("exec env --default-signal={signal} mpm-run '{arguments}'");
        let child = bench.shell_command(&line).spawn().unwrap();
        let mut child = with_rows(&bench, signal, child, 20);
        send(&child, signal);
        assert_eq!(child.wait().unwrap().code(), Some(75), "{signal}");
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
    let arguments = press_arguments("run", &SLOW, &[]).join("' '");
    let mut command = bench.shell_command(&format!("trap '' HUP; exec mpm-run '{arguments}'"));
    let mut child = with_rows(&bench, "run", command.spawn().unwrap(), 20);
    send(&child, "HUP");
    child = with_rows(&bench, "run", child, 120);
    assert_eq!(terminate(&mut child), Some(75));
}

#[test]
fn a_killed_run_leaves_nothing_half_written_and_runs_again() {
    let bench = Workbench::with_bond();
    bench.pressed("whole", &SLOW, &[]);
    for rows in [2, 100, 300] {
        let mut child = started(&bench, "killed", &SLOW, &["--resume"], rows);
        child.kill().unwrap();
        child.wait().unwrap();
        assert!(!bench.path("killed/final.mpts").exists());
        for entry in fs::read_dir(bench.path("killed/snapshots"))
            .into_iter()
            .flatten()
        {
            let path = entry.unwrap().path();
            if path.extension().is_some_and(|e| e == "mpts") {
                bench.done("particles", &["check", path.to_str().unwrap()]);
            }
        }
    }
    bench.pressed("killed", &SLOW, &["--resume"]);
    assert_eq!(
        bench.sum("killed/final.mpts"),
        bench.sum("whole/final.mpts")
    );
    assert_eq!(
        bench.read("killed/history.csv"),
        bench.read("whole/history.csv")
    );
}

/// A run that becomes unstable leaves its last checkpoint and results, and goes on from there at
/// a smaller Courant number; a liquid that flies apart stops again with a sentence.
#[test]
fn an_unstable_run_leaves_its_checkpoint_and_goes_on_at_a_smaller_step() {
    for trial in instability::trials() {
        let bench = Workbench::new();
        let row = trial.run(bench.folder()).unwrap();
        println!("{row:?}");
        assert!(row.checkpoint < row.unstable, "{row:?}");
        let named = "last good checkpoint, run/checkpoint.mpts";
        assert!(row.said.contains(named), "{}", row.said);
        match (&row.then, trial.scene) {
            (Ok(steps), "press") => assert!(*steps > row.unstable),
            (Err(said), "torn apart, 150 m/s") => assert!(said.contains(named), "{said}"),
            (then, scene) => panic!("{scene}: {then:?}"),
        }
        let changes = bench.read("run/resolved.toml");
        let cfl = format!("cfl = {}", row.cfl[1]);
        assert!(String::from_utf8(changes).unwrap().contains(&cfl));
        for entry in fs::read_dir(bench.path("run/snapshots")).unwrap() {
            bench.done(
                "particles",
                &["check", entry.unwrap().path().to_str().unwrap()],
            );
        }
        if row.then.is_ok() {
            let summary = String::from_utf8(bench.read("run/summary.json")).unwrap();
            let kept = format!("\"after_step\": {},", row.checkpoint);
            assert!(summary.contains(&kept), "{summary}");
        }
    }
}

//! A run stopped after any of its steps, the last one too, and continued ends as one in one piece.

use std::cell::Cell;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use particle_file::Provenance;
use run::{End, Mode, Request, Summary};

/// Liquid between two plates; a row of the history and a snapshot now and then.
const CASE: &str = r#"[grid]
cell = "2 um"
dimensions = 2
domain = { min = ["0 um", "0 um", "0 um"], max = ["24 um", "30 um", "2 um"] }
[adhesive]
density = "1200 kg/m3"
bulk_modulus = "1 GPa"
viscosity = "1.3 Pa s"
[contact]
law = "stick"
[clamp]
closing_speed = "1 m/s"
max_pressure = "2.5 MPa"
travel = "4 um"
stop = "STOP"
[integrator]
INTEGRATOR
[output]
history_every = "EVERY"
snapshots = 3
[[body]]
material = "rigid"
name = "bottom"
box = { min = ["0 um", "0 um", "0 um"], max = ["24 um", "6 um", "2 um"] }
[[body]]
material = "rigid"
name = "top"
velocity = "clamp"
box = { min = ["0 um", "16 um", "0 um"], max = ["24 um", "30 um", "2 um"] }
[[body]]
material = "adhesive"
box = { min = ["0 um", "6 um", "0 um"], max = ["4 um", "16 um", "2 um"] }
"#;

/// Runs `case` in `folder`, stopped after `steps` steps of this process.
fn pressed(case: &Path, folder: &Path, steps: usize) -> Summary {
    let by = Provenance {
        tool: "mpm-run".into(),
        version: "test".into(),
        command: Vec::new(),
        inputs: Vec::new(),
    };
    let (left, mode) = (
        Cell::new(steps),
        Mode {
            resume: true,
            overwrite: false,
        },
    );
    let stop = || {
        left.set(left.get() - 1);
        left.get() == 0
    };
    let request = Request::read(case, None, &[]).unwrap();
    let ended = request.execute(folder, mode, by, &stop, &mut |_, _| {}, &|said| {
        panic!("{said}")
    });
    ended.unwrap().expect("a run that has not ended")
}

fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    for within in [folder.to_owned(), folder.join("snapshots")] {
        for entry in fs::read_dir(within).unwrap() {
            let path = entry.unwrap().path();
            // The summary has the costs of the run and is compared by its values.
            if path.is_file() && !path.ends_with("summary.json") {
                files.insert(
                    path.strip_prefix(folder).unwrap().display().to_string(),
                    fs::read(&path).unwrap(),
                );
            }
        }
    }
    files
}

/// All of a summary but the costs.
fn facts(summary: &Summary) -> String {
    let mut value = serde_json::to_value(summary).unwrap();
    for cost in [
        "stepping_wall_s",
        "cpu_s",
        "particle_steps_per_s",
        "peak_memory_bytes",
        "stages",
    ] {
        value.as_object_mut().unwrap().remove(cost);
    }
    value.to_string()
}

/// On 314e630 a run stopped in its last step ended at 0 Pa, without its last row.
fn stopped_after_any_step(integrator: &str, stop: &str, every: &str) {
    let place = tempfile::tempdir().unwrap();
    let case = place.path().join("case.toml");
    let text = CASE.replace("INTEGRATOR", integrator).replace("STOP", stop);
    fs::write(&case, text.replace("EVERY", every)).unwrap();
    let whole = place.path().join("whole");
    let summary = pressed(&case, &whole, usize::MAX);
    assert!(
        summary.steps > 9 && summary.final_pressure_pa > 1.0,
        "{summary:?}"
    );
    let rows = fs::read_to_string(whole.join("history.csv")).unwrap();
    assert!(
        rows.lines().count() < summary.steps as usize,
        "a row for each step shows less"
    );
    for steps in 1..=summary.steps as usize {
        let parts = place.path().join(format!("parts-{steps}"));
        assert_eq!(pressed(&case, &parts, steps).end, End::Interrupted);
        let resumed = pressed(&case, &parts, usize::MAX);
        assert_eq!(facts(&resumed), facts(&summary), "stopped after {steps}");
        assert!(files(&parts) == files(&whole), "stopped after {steps}");
    }
}

#[test]
fn an_explicit_run_stopped_after_any_step_ends_the_same() {
    stopped_after_any_step("scheme = \"explicit\"", "0.007 us", "0.001 us");
}

#[test]
fn an_implicit_run_stopped_after_any_step_ends_the_same() {
    stopped_after_any_step("scheme = \"implicit\"\ncfl = 0.05", "1.45 us", "0.4 us");
}

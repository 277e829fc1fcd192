//! A run that is stopped after any step, the last one included, and continued ends like an uninterrupted one.

use run::{End, Summary};

use crate::bench::{Bench, END, RESUME, files};

/// The summary without the costs.
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

/// Runs `bench` uninterrupted and stopped after every `apart`th step, and compares the two; returns the summary.
pub fn ends_the_same(bench: &Bench, apart: usize) -> Summary {
    let summary = bench.ran("run", RESUME, END);
    let whole = files(&bench.path("run"));
    for steps in (1..=summary.steps as usize).step_by(apart) {
        let parts = format!("parts-{steps}");
        assert_eq!(bench.ran(&parts, RESUME, steps).end, End::Interrupted);
        let resumed = bench.ran(&parts, RESUME, END);
        assert_eq!(facts(&resumed), facts(&summary), "stopped after {steps}");
        let same = files(&bench.path(&parts)) == whole;
        assert!(same, "stopped after {steps}");
    }
    summary
}

/// Plates, stopped after every `apart`th step; a run stopped in its last step keeps pressure and row.
fn plates(apart: usize, integrator: &str, stop: &str, every: &str) -> Summary {
    let bench = Bench::new(integrator, stop, every);
    let summary = ends_the_same(&bench, apart);
    assert!(summary.steps > 9 && summary.final_pressure_pa > 1.0);
    let rows = bench.column("step").len() as u64;
    assert!(rows < summary.steps, "a row for each step shows less");
    summary
}

#[test]
fn an_explicit_run_stopped_after_any_step_ends_the_same() {
    plates(1, "scheme = \"explicit\"", "0.007 us", "0.001 us");
}

#[test]
fn an_implicit_run_stopped_after_any_step_ends_the_same() {
    plates(1, "scheme = \"implicit\"\ncfl = 0.05", "1.45 us", "0.4 us");
}

/// The time of the run determines viscosity and end.
#[test]
fn a_run_of_an_adhesive_that_sets_stopped_after_any_step_ends_the_same() {
    let cure = "scheme = \"implicit\"\n[adhesive.cure]\ngel_time = \"2 us\"\nexponent = 2.0";
    let summary = plates(7, cure, "4 us", "0.2 us");
    assert_eq!(summary.end, End::Set);
    let set = summary.time_s / 2e-6;
    assert!((set - 0.999).abs() < 1e-5, "{set}");
    assert!(summary.sentence().contains("because the adhesive has set"));
}

/// The water in each point and the water balance are part of the state.
#[test]
fn a_run_of_an_adhesive_that_dries_stopped_after_any_step_ends_the_same() {
    let water = "scheme = \"implicit\"\ncfl = 0.05\n[adhesive.water]\nsolids = 0.45\nuptake = \"0.2 m/s\"\ndiffusivity = \"1e-5 m2/s\"\nviscosity_by_solids = [[0.45, 1.0], [0.6, 30.0]]";
    let summary = plates(5, water, "1.45 us", "0.4 us");
    let account = summary.invariants.water.expect("an account of water");
    assert!(account.solids_content > 0.4505, "{account:?}");
    assert!(account.water_missing.abs() < 1e-12, "{account:?}");
}

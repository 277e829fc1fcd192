//! Press programmes: what they do, what is refused, and runs stopped in the middle of any stage.

use std::fs;

use run::End;

use crate::bench::{Bench, PLAIN, RESUME, files, plates};

/// Approach, ramp, hold until next to nothing flows, release: from microseconds to minutes.
const STAGES: &str = r#"
[[clamp.stage]]
kind = "approach"
speed = "10 mm/s"
pressure = "1 kPa"
[[clamp.stage]]
kind = "ramp"
pressure = "10 kPa"
time = "1 ms"
[[clamp.stage]]
kind = "hold"
time = "5 min"
slower = "500 um/s"
[[clamp.stage]]
kind = "ramp"
pressure = "1 kPa"
time = "0.1 ms"
[[clamp.stage]]
kind = "release"
time = "1 min"
"#;

/// A drop under a clamp of these stages and this way.
fn case(travel: &str, stages: &str) -> String {
    let tables = format!(
        r#"[clamp]
travel = "{travel}"
{stages}
[integrator]
scheme = "implicit"
[output]
snapshots = 4"#
    );
    plates(32, 12, 12, &tables)
}

fn bench(stages: &str) -> Bench {
    Bench::with(&case("8 um", stages))
}

fn column(history: &str, name: &str) -> Vec<f64> {
    let mut lines = history.lines();
    let names = lines.next().unwrap().split(',');
    let place = names.into_iter().position(|n| n == name).unwrap();
    lines
        .map(|line| line.split(',').nth(place).unwrap().parse().unwrap())
        .collect()
}

#[test]
fn stages_follow_one_another_in_steps_that_follow_the_flow() {
    let bench = bench(STAGES);
    let summary = bench.ran("run", PLAIN, usize::MAX);
    assert_eq!(summary.end, End::Programme);
    let ended: Vec<_> = summary
        .programme
        .iter()
        .map(|s| (s.kind, s.ended_by))
        .collect();
    println!(
        "{} steps, {:.3} s: {:?}",
        summary.steps, summary.time_s, summary.programme
    );
    let wanted = [
        ("approach", "pressure"),
        ("ramp", "time"),
        ("hold", "slower"),
        ("ramp", "time"),
        ("release", "time"),
    ];
    assert_eq!(ended, wanted);
    assert!(summary.steps < 200, "{} steps", summary.steps);
    assert!(summary.verdict.sound, "{:?}", summary.verdict);
    let history = fs::read_to_string(bench.path("run").join("history.csv")).unwrap();
    let [time, pressure, stage] =
        ["time_s", "pressure_top_Pa", "stage"].map(|name| column(&history, name));
    assert_eq!(time.len() as u64, summary.steps, "a row for each step");
    // The pressure of a step is that which is set in its middle.
    let ends: Vec<f64> = summary.programme.iter().map(|s| s.end_s).collect();
    let mut before = 0.0;
    for ((&t, &p), &stage) in time.iter().zip(&pressure).zip(&stage) {
        let middle = 0.5 * (before + t);
        before = t;
        let part = |from: usize, length: f64| ((middle - ends[from]) / length).clamp(0.0, 1.0);
        let set = match stage as usize {
            2 => 1e3 + 9e3 * part(0, 1e-3),
            3 => 1e4,
            4 => 1e4 - 9e3 * part(2, 1e-4),
            5 => 0.0,
            _ => continue,
        };
        assert!(
            (p - set).abs() < 0.01 * 1e4,
            "{p} Pa at {t} s, not {set} Pa"
        );
    }
    // Four in the way of 8 um that it goes, and one at each end of a stage.
    let snapshots = files(&bench.path("run"));
    let snapshots = snapshots
        .keys()
        .filter(|name| name.starts_with("snapshots/"));
    assert!((5..=9).contains(&snapshots.count()));
}

#[test]
fn a_programme_stopped_after_any_step_ends_the_same() {
    let bench = bench(STAGES);
    let summary = bench.ran("whole", RESUME, usize::MAX);
    let whole = files(&bench.path("whole"));
    for steps in (1..=summary.steps as usize).step_by(3) {
        let parts = format!("parts-{steps}");
        assert_eq!(bench.ran(&parts, RESUME, steps).end, End::Interrupted);
        bench.ran(&parts, RESUME, usize::MAX);
        assert!(files(&bench.path(&parts)) == whole, "stopped after {steps}");
    }
}

/// The clamp has gone all its way before the press does: wood on wood bears the rest.
#[test]
fn a_closed_clamp_stands_until_the_programme_is_over() {
    let stages = STAGES.replace("slower = \"500 um/s\"\n", "");
    let bench = Bench::with(&case("6 um", &stages.replace("10 kPa", "1 MPa")));
    let summary = bench.ran("run", PLAIN, usize::MAX);
    assert_eq!(summary.end, End::Programme);
    let hold = &summary.programme[2];
    assert_eq!((hold.ended_by, hold.end_s > 300.0), ("time", true));
    assert!((hold.travel_m / 6e-6 - 1.0).abs() < 1e-6, "{hold:?}");
    assert!(summary.steps < 300 && summary.verdict.sound, "{summary:?}");
}

#[test]
fn stages_that_contradict_one_another_are_refused() {
    let approach = "[[clamp.stage]]\nkind = \"approach\"\nspeed = \"1 mm/s\"\n";
    let next = |kind: &str, keys: &str| {
        format!("{approach}pressure = \"1 MPa\"\n[[clamp.stage]]\nkind = \"{kind}\"\n{keys}")
    };
    let after_hold = |kind: &str, keys: &str| {
        let held = next("hold", "time = \"1 s\"\n");
        format!("{held}[[clamp.stage]]\nkind = \"{kind}\"\n{keys}")
    };
    let cases = [
        (
            format!("closing_speed = \"1 m/s\"\n{approach}"),
            "closing_speed is for a clamp without",
        ),
        (
            format!("stop = \"closed\"\n{approach}"),
            "stop is for a clamp without",
        ),
        (
            approach.replace("speed = \"1 mm/s\"\n", ""),
            "needs a speed",
        ),
        (
            approach.to_owned() + "slower = \"1 nm/s\"\n",
            "slower ends a hold",
        ),
        (
            approach.to_owned() + "travel = \"9 um\"\n",
            "at most the 8.0000 um",
        ),
        (next("ramp", "time = \"1 s\"\n"), "a pressure to go to"),
        (next("ramp", "pressure = \"2 MPa\"\n"), "needs a time"),
        (
            next("hold", "contact = true\n"),
            "contact ends an approach only",
        ),
        (
            next("release", "pressure = \"1 MPa\"\ntime = \"1 s\"\n"),
            "a release has no pressure",
        ),
        (
            after_hold("hold", "pressure = \"2 MPa\"\ntime = \"1 s\"\n"),
            "a ramp between them",
        ),
        (
            after_hold("ramp", "pressure = \"1 MPa\"\ntime = \"1 s\"\n"),
            "1.0000 MPa already",
        ),
        (
            format!("{approach}[[clamp.stage]]\nkind = \"hold\"\ntime = \"1 s\"\n"),
            "ends at none",
        ),
        (
            "[[clamp.stage]]\nkind = \"release\"\nspeed = \"1 mm/s\"\ntime = \"1 s\"\n".into(),
            "ends at no pressure",
        ),
        (
            "[[clamp.stage]]\nkind = \"press\"\n".into(),
            "\"hold\" or \"release\" is needed",
        ),
        (
            String::new(),
            "needs closing_speed, or a list of [[clamp.stage]]",
        ),
    ];
    for (stages, wanted) in cases {
        let said = bench(&stages).read(&[]).unwrap_err().to_string();
        assert!(said.contains(wanted), "{said}\nnot: {wanted}");
        assert!(!said.contains('\n'), "{said}");
    }
    let explicit = bench(STAGES).run_changed("run", PLAIN, 1, &["integrator.scheme=explicit"]);
    let said = explicit.unwrap_err().to_string();
    assert!(said.contains("scheme = \"implicit\" only"), "{said}");
}

/// The clamp has long gone its way when the adhesive sets in the hold: as many steps as change its viscosity.
#[test]
fn the_plan_counts_the_steps_of_cure_in_all_stages() {
    let cured = case("8 um", &STAGES.replace("slower = \"500 um/s\"\n", ""));
    let cure = "[adhesive.cure]\ngel_time = \"100 s\"\nexponent = 2.0\n[contact]";
    let bench = Bench::with(&cured.replace("[contact]", cure));
    let plan = bench.read(&[]).unwrap().explain().unwrap();
    let line = plan
        .lines()
        .find(|line| line.starts_with("  steps"))
        .unwrap();
    let told: f64 = line.split_whitespace().nth(2).unwrap().parse().unwrap();
    let summary = bench.ran("run", PLAIN, usize::MAX);
    println!("{line}; taken {}", summary.steps);
    assert_eq!(summary.end, End::Set);
    assert!((told / summary.steps as f64 - 1.0).abs() < 0.5, "{line}");
    assert!(line.contains("9.9900e1 s"), "{line}");
}

//! Press programmes: their stages, refused programmes, and runs stopped within any stage.

use run::End;

use crate::bench::{Bench, END, PLAIN, files, has, plates};
use crate::stopped::ends_the_same;

/// Approach, ramp, hold until almost nothing flows, release: from microseconds to minutes.
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

/// A drop under a clamp with these stages and this travel.
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

#[test]
fn stages_follow_one_another_in_steps_that_follow_the_flow() {
    let bench = bench(STAGES);
    let summary = bench.ran("run", PLAIN, END);
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
    let [time, pressure, stage] =
        ["time_s", "pressure_top_Pa", "stage"].map(|name| bench.numbers(name));
    assert_eq!(time.len() as u64, summary.steps, "a row for each step");
    // The pressure of a row is the set pressure at its time.
    let ends: Vec<f64> = summary.programme.iter().map(|s| s.end_s).collect();
    for ((&t, &p), &stage) in time.iter().zip(&pressure).zip(&stage) {
        let part = |from: usize, length: f64| ((t - ends[from]) / length).clamp(0.0, 1.0);
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
    // Four over the travel of 8 um, and one at the end of each stage.
    let snapshots = files(&bench.path("run"));
    let snapshots = snapshots
        .keys()
        .filter(|name| name.starts_with("snapshots/"));
    assert!((5..=9).contains(&snapshots.count()));
}

#[test]
fn a_programme_stopped_after_any_step_ends_the_same() {
    ends_the_same(&bench(STAGES), 3);
}

/// The clamp closes before the programme is over: wood on wood bears the remaining pressure.
#[test]
fn a_closed_clamp_stands_until_the_programme_is_over() {
    let stages = STAGES.replace("slower = \"500 um/s\"\n", "");
    let bench = Bench::with(&case("6 um", &stages.replace("10 kPa", "1 MPa")));
    let summary = bench.ran("run", PLAIN, END);
    assert_eq!(summary.end, End::Programme);
    let hold = &summary.programme[2];
    assert_eq!((hold.ended_by, hold.end_s > 300.0), ("time", true));
    assert!((hold.travel_m / 6e-6 - 1.0).abs() < 1e-6, "{hold:?}");
    let said = "went through its press programme and closed below its pressure in stage";
    assert!(summary.sentence().contains(said), "{}", summary.sentence());
    assert!(summary.steps < 300 && summary.verdict.sound, "{summary:?}");
}

/// Keys of the clamp or stages, and words of the refusal.
const REFUSED: &str = "\
clamp; closing_speed=1 m/s | approach; speed=1 mm/s => closing_speed is for a clamp without
clamp; stop=closed | approach; speed=1 mm/s => stop is for a clamp without
approach => needs a speed
approach; speed=1 mm/s; slower=1 nm/s => a hold or a release can end
approach; speed=1 mm/s; travel=9 um => at most the 8.0000 um
approach; speed=1 mm/s; pressure=1 MPa | ramp; time=1 s => it needs a pressure
approach; speed=1 mm/s; pressure=1 MPa | ramp; pressure=2 MPa => needs a time
approach; speed=1 mm/s; pressure=1 MPa | hold; contact=true => only an approach can end with contact
approach; speed=1 mm/s; pressure=1 MPa | release; pressure=1 MPa; time=1 s => a release has no pressure
approach; speed=1 mm/s; pressure=1 MPa | hold; time=1 s | hold; pressure=2 MPa; time=1 s => a ramp between them
approach; speed=1 mm/s; pressure=1 MPa | hold; time=1 s | ramp; pressure=1 MPa; time=1 s => 1.0000 MPa already
approach; speed=1 mm/s | hold; time=1 s => ends without one
release; speed=1 mm/s; time=1 s => ends without a pressure
press => \"hold\" or \"release\" is needed
clamp => needs closing_speed, or a list of [[clamp.stage]]";

#[test]
fn stages_that_contradict_one_another_are_refused() {
    let table = |text: &str| {
        let mut words = text.split("; ");
        let head = match words.next().unwrap() {
            "clamp" => String::new(),
            kind => format!("[[clamp.stage]]\nkind = \"{kind}\"\n"),
        };
        let key = |key: &str| match key.split_once('=').unwrap() {
            (key, "true") => format!("{key} = true\n"),
            (key, value) => format!("{key} = \"{value}\"\n"),
        };
        head + &words.map(key).collect::<String>()
    };
    for line in REFUSED.lines() {
        let (stages, wanted) = line.split_once(" => ").unwrap();
        let stages: String = stages.split(" | ").map(table).collect();
        let said = bench(&stages).refusal(&[]);
        has(&said, &[wanted]);
        assert!(!said.contains('\n'), "{said}");
    }
    let said = ["scheme = \"implicit\" only"];
    bench(STAGES).refuses(PLAIN, &["integrator.scheme=explicit"], &said);
}

/// The number of steps of a hot press does not follow from its travel.
#[test]
fn the_plan_of_a_programme_forecasts_no_steps() {
    let plan = bench(STAGES).plan(&[]).unwrap();
    has(
        &plan,
        &["\nsteps no forecast for a press programme", " s a step on "],
    );
}

//! Exit status 0 is a claim: what goes wrong ends with 1, and a sentence says what to change.

use std::process::Output;

use crate::workbench::{Workbench, said};

/// A drop between two plates, the upper of which the clamp drives.
pub const SMALL: &str = r#"
[grid]
cell = "2 um"
dimensions = 2
domain = { min = ["0 um", "0 um", "0 um"], max = ["24 um", "30 um", "2 um"] }
[adhesive]
density = "1200 kg/m3"
bulk_modulus = "1 GPa"
viscosity = "1.3 Pa s"
[contact]
law = "stick"
[gravity]
acceleration = ["0 m/s2", "0 m/s2", "0 m/s2"]
[clamp]
closing_speed = "1 m/s"
max_pressure = "2.5 MPa"
travel = "4 um"
[integrator]
scheme = "implicit"
cfl = 0.5
[output]
history_every = "0.02 us"
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
box = { min = ["0 um", "6 um", "0 um"], max = ["12 um", "14 um", "2 um"] }
"#;

/// [`SMALL`] with texts replaced.
pub fn changed(changes: &[(&str, &str)]) -> String {
    changes.iter().fold(SMALL.to_owned(), |text, (from, to)| {
        assert!(text.contains(from), "{from}");
        text.replace(from, to)
    })
}

pub fn run(bench: &Workbench, case: &str, more: &[&str]) -> Output {
    bench.write("case.toml", case);
    bench.run(
        "mpm-run",
        &[&["-q", "case.toml", "-o", "run"], more].concat(),
    )
}

pub const NO_LIMIT: (&str, &str) = ("max_pressure = \"2.5 MPa\"\n", "");
pub const EXPLICIT: (&str, &str) = ("\"implicit\"", "\"explicit\"");
/// Before, both schemes ended with exit status 0 and the volume 29 and 39 % off.
#[test]
fn a_sealed_liquid_that_is_crushed_stops_the_run() {
    let sealed = [
        NO_LIMIT,
        ("max = [\"12 um\", \"14 um\"", "max = [\"24 um\", \"16 um\""),
    ];
    let bench = Workbench::new();
    for scheme in [&[][..], &[EXPLICIT]] {
        let output = run(
            &bench,
            &changed(&[&sealed[..], scheme].concat()),
            &["--overwrite"],
        );
        let said = said(&output);
        assert_eq!(output.status.code(), Some(1), "{said}");
        assert!(
            said.contains("the liquid is compressed by") && said.contains("max_pressure"),
            "{said}"
        );
    }
    // Held at its pressure limit the same liquid is sound.
    let output = run(&bench, &changed(&[sealed[1]]), &["--overwrite"]);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
}

/// A run that has ended is judged the same when it is asked for again.
#[test]
fn a_summary_has_the_verdict_and_a_run_not_sound_stays_so() {
    let bench = Workbench::new();
    let output = run(&bench, SMALL, &[]);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let summary = String::from_utf8(bench.read("run/summary.json")).unwrap();
    assert!(summary.contains("\"sound\": true"), "{summary}");
    let worse = summary
        .replace("\"sound\": true", "\"sound\": false")
        .replace("\"reasons\": []", "\"reasons\": [\"it is forged\"]");
    bench.write("run/summary.json", worse);
    let again = bench.run("mpm-run", &["case.toml", "-o", "run", "--resume"]);
    assert_eq!(again.status.code(), Some(1), "{}", said(&again));
    assert!(said(&again).contains("not sound") && said(&again).contains("it is forged"));
}

/// Before, all of these said "has ended already" with exit status 0.
#[test]
fn a_run_that_ended_is_sound_only_if_its_files_say_so() {
    let bench = Workbench::new();
    let output = run(&bench, SMALL, &[]);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let asked = |status, sentence: &str| {
        let again = bench.run("mpm-run", &["case.toml", "-o", "run", "--resume"]);
        assert_eq!(again.status.code(), Some(status), "{}", said(&again));
        assert!(said(&again).contains(sentence), "{}", said(&again));
    };
    asked(0, "has ended already");
    let summary = bench.read("run/summary.json");
    bench.write("run/summary.json", "{}");
    asked(3, "does not say whether the results are sound");
    std::fs::remove_file(bench.path("run/summary.json")).unwrap();
    asked(3, "does not say whether the results are sound");
    bench.write("run/summary.json", summary);
    let whole = bench.read("run/final.mpts");
    let mut flipped = whole.clone();
    let middle = flipped.len() / 2;
    flipped[middle] ^= 4;
    bench.write("run/final.mpts", flipped);
    asked(3, "its final state is damaged");
    bench.write("run/final.mpts", whole);
    std::fs::remove_file(bench.path("run/bondline-run.toml")).unwrap();
    asked(2, "is not marked as a run folder");
}

/// A slit whose clamp meets its limit in the very step that ends its way: the held speed then follows the
/// length of the step, by inertia or in a closed space, and no attempt at ending exactly comes nearer.
#[test]
fn a_clamp_that_meets_its_limit_in_its_last_step_closes() {
    let bench = Workbench::new();
    let text = include_str!("../../pipelines/gate/pins/slit.toml")
        .replace(
            "[stop]\ntime = \"12 us\"",
            "[clamp]\nclosing_speed = \"1 m/s\"\nmax_pressure = \"0.3 MPa\"\ntravel = \"0.1 um\"",
        )
        .replace("[\"0 m/s\", \"-0.5 m/s\", \"0 m/s\"]", "\"clamp\"");
    bench.write("slit.toml", text);
    for viscosity in ["1 cP", "10 cP", "100 cP"] {
        let set = format!("adhesive.viscosity={viscosity}");
        let folder = viscosity.replace(' ', "");
        let said = bench.run(
            "mpm-run",
            &["-q", "slit.toml", "--set", &set, "-o", &folder],
        );
        assert!(said.status.success(), "{viscosity}: {said:?}");
        let history = String::from_utf8(bench.read(&format!("{folder}/history.csv"))).unwrap();
        let names = history.lines().next().unwrap().split(',');
        let row: Vec<&str> = history.lines().last().unwrap().split(',').collect();
        let last = |name: &str| {
            let place = names.clone().position(|n| n == name).unwrap();
            row[place].parse::<f64>().unwrap()
        };
        assert!(
            (last("displacement_m") / 1e-7 - 1.0).abs() < 1e-6,
            "{viscosity}: {history}"
        );
        assert!(
            last("pressure_top_Pa") < 0.3e6 * 1.005,
            "{viscosity}: {history}"
        );
    }
}

//! Exit status 0 is a claim: what goes wrong ends with 1, what cannot be right is refused, and a sentence says what to change; a
//! pressure limit holds for as long as one likes, or the run says that it does not.

use crate::workbench::Workbench;

/// A drop between two plates, the upper of which the clamp drives.
pub const SMALL: &str = include_str!("../plates.toml");

const NO_LIMIT: (&str, &str) = ("max_pressure = \"2.5 MPa\"\n", "");
const EXPLICIT: (&str, &str) = ("\"implicit\"", "\"explicit\"");
/// Liquid that fills all between the plates.
const SEALED: (&str, &str) = ("max = [\"12 um\", \"14 um\"", "max = [\"24 um\", \"16 um\"");

const RUN: &str = "mpm-run -q case.toml -o run --overwrite";
const AGAIN: &str = "mpm-run case.toml -o run --resume";

/// [`SMALL`] with texts replaced.
fn changed(changes: &[(&str, &str)]) -> String {
    changes.iter().fold(SMALL.to_owned(), |text, (from, to)| {
        assert!(text.contains(from), "{from}");
        text.replace(from, to)
    })
}

/// [`SMALL`] so wide and 10 mm high, the plates 8 mm apart.
pub fn widened(width: &str) -> String {
    let [domain, drop] = ["8 mm\", \"2 um\"] }\n[adhesive]", "8 mm\""]
        .map(|rest| format!("max = [\"{width}\", \"{rest}"));
    changed(&[
        (
            "max = [\"24 um\", \"30 um\", \"2 um\"] }\n[adhesive]",
            &domain,
        ),
        ("max = [\"12 um\", \"14 um\"", &drop),
        ("\"0 um\", \"16 um\"", "\"0 um\", \"9 mm\""),
        (
            "\"24 um\", \"30 um\", \"2 um\"]",
            "\"24 um\", \"10 mm\", \"2 um\"]",
        ),
        ("\"4 um\"", "\"2 mm\""),
    ])
}

/// Before, both schemes ended with exit status 0 and the volume 29 and 39 % off.
#[test]
fn a_sealed_liquid_that_is_crushed_stops_the_run() {
    let bench = Workbench::new();
    for scheme in [&[][..], &[EXPLICIT]] {
        bench.write(
            "case.toml",
            changed(&[&[NO_LIMIT, SEALED], scheme].concat()),
        );
        let said = bench.ends(1, RUN, "the liquid is compressed by");
        assert!(said.contains("max_pressure"), "{said}");
    }
    // Held at its pressure limit the same liquid is sound.
    bench.write("case.toml", changed(&[SEALED]));
    bench.done(RUN);
}

/// Before, a run that had ended was said to have done so with exit status 0 whatever its files say.
#[test]
fn a_run_that_ended_is_sound_only_if_its_files_say_so() {
    let bench = Workbench::new();
    bench.write("case.toml", SMALL);
    bench.done(RUN);
    bench.ends(0, AGAIN, "has ended already");
    let summary = bench.text("run/summary.json");
    let worse = summary
        .replace("\"sound\": true", "\"sound\": false")
        .replace(
            "\"reasons\": []",
            "\"reasons\": [\"it is forged\", \"twice\"]",
        );
    bench.write("run/summary.json", worse);
    let said = bench.ends(1, AGAIN, "not sound");
    assert!(said.contains(": it is forged; twice"), "{said}");
    let silent = "does not say whether the results are sound";
    bench.write("run/summary.json", "{}");
    bench.ends(3, AGAIN, silent);
    std::fs::remove_file(bench.path("run/summary.json")).unwrap();
    bench.ends(3, AGAIN, silent);
    bench.write("run/summary.json", summary);
    let whole = bench.read("run/final.mpts");
    bench.damage("run/final.mpts", "run/final.mpts", whole.len() / 2);
    bench.ends(3, AGAIN, "its final state is damaged");
    bench.write("run/final.mpts", whole);
    std::fs::remove_file(bench.path("run/bondline-run.toml")).unwrap();
    bench.ends(2, AGAIN, "is not marked as a run folder");
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
    bench.write("case.toml", text);
    for viscosity in ["1 cP", "10 cP", "100 cP"] {
        bench.done(&format!("{RUN} --set 'adhesive.viscosity={viscosity}'"));
        let history = bench.table("run/history.csv");
        let [way, pressure] = ["displacement_m", "pressure_top_Pa"].map(|name| history.last(name));
        assert!((way / 1e-7 - 1.0).abs() < 1e-6, "{viscosity}: {way} m");
        assert!(pressure < 0.3e6 * 1.005, "{viscosity}: {pressure} Pa");
    }
}

/// A chamber full of liquid that has no way out, pressed for a time.
fn chamber(time_limit: &str, changes: &[(&str, &str)]) -> String {
    let time = format!("travel = \"4 um\"\ntime_limit = \"{time_limit}\"");
    changed(&[&[SEALED, ("travel = \"4 um\"", &time)], changes].concat())
}

/// Before, the clamp went on at a millionth of its speed: 13 and 78 MPa within a second, "sound".
#[test]
fn sealed_liquid_is_held_at_the_limit_for_a_second() {
    let bench = Workbench::new();
    for (modulus, most) in [("0.1 GPa", 0.02), ("1 GPa", 1e-3)] {
        bench.write("case.toml", chamber("1 s", &[("1 GPa", modulus)]));
        bench.done(RUN);
        let pressures = bench.table("run/history.csv").column("pressure_top_Pa");
        let over = pressures.into_iter().fold(0.0, f64::max) / 2.5e6 - 1.0;
        println!("sealed at {modulus}: {over:+.1e} of the limit at most");
        assert!(over < most, "{modulus}: {over}");
    }
}

/// A PID slows the clamp down step by step, too late for sealed liquid, and does not open it: 127, 13 and
/// 3.4 MPa were "sound".
#[test]
fn sealed_liquid_above_the_limit_by_a_pid_is_no_sound_run() {
    let bench = Workbench::new();
    let limit = "max_pressure = \"2.5 MPa\"";
    let pid = format!("{limit}\npid = {{ kp = 0.0, ki = 0.02, kd = 0.0 }}");
    for case in [
        chamber("1 ms", &[(limit, &pid), ("cfl = 0.5", "cfl = 0.02")]),
        chamber("1 ms", &[(limit, &pid), ("cfl = 0.5", "cfl = 0.002")]),
        chamber("0.5 us", &[EXPLICIT]),
    ] {
        bench.write("case.toml", case);
        bench.ends(1, RUN, "above its max_pressure");
    }
}

const ENDLESS: (&str, &str) = ("\"1.3 Pa s\"", "\"1e9 Pa s\"");

/// Before, the plan was printed with NaN in it, and every point of a plan was made only to be
/// counted.
#[test]
fn a_plan_says_what_would_be_refused_and_needs_no_memory() {
    let bench = Workbench::new();
    bench.write("case.toml", changed(&[("cfl = 0.5", "cfl = nan")]));
    bench.ends(2, "mpm-run case.toml --explain", "cfl");
    bench.write("case.toml", changed(&[ENDLESS, EXPLICIT]));
    let plan = bench.done("mpm-run case.toml --explain");
    assert!(
        plan.contains("refused            unless --yes-really"),
        "{plan}"
    );
    let run = "mpm-run -q case.toml -o run";
    bench.ends(2, run, "--yes-really runs it anyway");
    bench.write("case.toml", changed(&[("velocity = \"clamp\"\n", "")]));
    bench.ends(2, run, "[clamp] has nothing to move");
    assert!(!bench.path("run").exists());
    bench.write("case.toml", widened("0.2 m"));
    let plan = bench.done("ulimit -v 2000000; mpm-run case.toml --explain --threads 1");
    assert!(plan.contains("1598800000 material points"), "{plan}");
}

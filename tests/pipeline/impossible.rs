//! Refusal before it starts of what cannot be right, in a sentence that says what to change.

use crate::verdicts::{EXPLICIT, NO_LIMIT, SMALL, changed, run};
use crate::workbench::{Workbench, said};

const FIXED_PLATES: &str = "[[body]]\nmaterial = \"rigid\"\nname = \"bottom\"";

/// On commit 314e630 all of these ran, most to exit status 0.
#[test]
fn what_cannot_be_right_is_refused_before_it_starts() {
    let through = ("travel = \"4 um\"", "travel = \"20 um\"");
    let start = SMALL.find(FIXED_PLATES).unwrap();
    let end = SMALL.rfind("[[body]]").unwrap();
    let plates = &SMALL[start..end];
    let cases: &[(&[(&str, &str)], &str)] = &[
        (&[through], "meets 'bottom' after 10.0000 um"),
        (&[through, EXPLICIT], "meets 'bottom' after 10.0000 um"),
        (
            &[NO_LIMIT, ("travel = \"4 um\"", "stop = \"11 us\"")],
            "meets 'bottom'",
        ),
        (&[("\"1 m/s\"", "\"1e30 m/s\""), EXPLICIT], "speed of sound"),
        (&[("\"1 GPa\"", "\"1e-20 Pa\"")], "speed of sound"),
        (
            &[("[\"0 m/s2\", \"0 m/s2\"", "[\"0 m/s2\", \"-1e15 m/s2\"")],
            "smaller acceleration",
        ),
        (&[(plates, "")], "[clamp] has nothing to move"),
        (
            &[("[\"0 um\", \"16 um\"", "[\"18 um\", \"16 um\"")],
            "does not come near the adhesive",
        ),
        (
            &[
                ("[clamp]\nclosing_speed = \"1 m/s\"\n", "[stop]\n"),
                NO_LIMIT,
                ("travel = \"4 um\"", "time = \"12 us\""),
                ("\"clamp\"", "[\"0 m/s\", \"-1 m/s\", \"0 m/s\"]"),
            ],
            "would overlap from 1.0000e-5 s on",
        ),
        (
            &[("\"1.3 Pa s\"", "\"1e9 Pa s\""), EXPLICIT],
            "--yes-really runs it all the same",
        ),
        (
            &[("max = [\"12 um\"", "max = [\"12 m\"")],
            "reaches out of the domain",
        ),
    ];
    let bench = Workbench::new();
    for (changes, sentence) in cases {
        let output = run(&bench, &changed(changes), &[]);
        let said = said(&output);
        assert_eq!(output.status.code(), Some(2), "{changes:?}: {said}");
        assert!(said.contains(sentence), "{changes:?}: {said}");
        assert!(!bench.path("run").exists(), "{changes:?}");
    }
}

/// Before, the plan was printed with NaN in it, and every point of a plan was made only to be
/// counted.
#[test]
fn a_plan_says_what_would_be_refused_and_needs_no_memory() {
    let bench = Workbench::new();
    let nan = run(
        &bench,
        &changed(&[("cfl = 0.5", "cfl = nan")]),
        &["--explain"],
    );
    assert_eq!(nan.status.code(), Some(2), "{}", said(&nan));
    let endless = changed(&[("\"1.3 Pa s\"", "\"1e9 Pa s\""), EXPLICIT]);
    let output = run(&bench, &endless, &["--explain"]);
    let plan = String::from_utf8_lossy(&output.stdout).into_owned();
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    assert!(
        plan.contains("refused            unless --yes-really"),
        "{plan}"
    );

    let large = changed(&[
        (
            "max = [\"24 um\", \"30 um\", \"2 um\"] }\n[adhesive]",
            "max = [\"0.2 m\", \"8 mm\", \"2 um\"] }\n[adhesive]",
        ),
        ("max = [\"12 um\", \"14 um\"", "max = [\"0.2 m\", \"8 mm\""),
        ("\"0 um\", \"16 um\"", "\"0 um\", \"9 mm\""),
        (
            "\"24 um\", \"30 um\", \"2 um\"]",
            "\"24 um\", \"10 mm\", \"2 um\"]",
        ),
        ("\"4 um\"", "\"2 mm\""),
    ]);
    bench.write("case.toml", large);
    let output = bench.shell("ulimit -v 2000000; mpm-run case.toml --explain --threads 1");
    let plan = String::from_utf8_lossy(&output.stdout).into_owned();
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    assert!(plan.contains("1598800000 material points"), "{plan}");
}

/// Before, bodies went through each other with exit status 0.
#[test]
fn bodies_do_not_pass_through_each_other() {
    let body = |name: &str, more: &str, low: &str, high: &str| {
        format!(
            "[[body]]\nmaterial = \"rigid\"\nname = \"{name}\"\n{more}\nbox = {{ min = {low}, max = {high} }}\n"
        )
    };
    let last = SMALL.rfind("[[body]]").unwrap();
    let with = |case: &str, bodies: &str| format!("{}{bodies}{}", &case[..last], &case[last..]);
    let riser = body(
        "riser",
        "velocity = [\"0 m/s\", \"1 m/s\", \"0 m/s\"]",
        "[\"18 um\", \"6 um\", \"0 um\"]",
        "[\"22 um\", \"10 um\", \"2 um\"]",
    );
    let post = body(
        "post",
        "",
        "[\"16 um\", \"6 um\", \"0 um\"]",
        "[\"20 um\", \"16.1 um\", \"2 um\"]",
    );
    let start = SMALL.find(FIXED_PLATES).unwrap();
    let through_a_side = format!(
        "{}[boundary]\nx = \"periodic\"\n{}{}{}",
        SMALL[..start]
            .replace("[clamp]\nclosing_speed = \"1 m/s\"\n", "[stop]\n")
            .replace("max_pressure = \"2.5 MPa\"\n", "")
            .replace("travel = \"4 um\"", "time = \"8 us\""),
        body(
            "plate",
            "velocity = [\"-1 m/s\", \"0 m/s\", \"0 m/s\"]",
            "[\"2 um\", \"6 um\", \"0 um\"]",
            "[\"6 um\", \"24 um\", \"2 um\"]"
        ),
        body(
            "pillar",
            "",
            "[\"19 um\", \"6 um\", \"0 um\"]",
            "[\"20 um\", \"24 um\", \"2 um\"]"
        ),
        SMALL[last..].replace(
            "[\"0 um\", \"6 um\", \"0 um\"], max = [\"12 um\"",
            "[\"10 um\", \"6 um\", \"0 um\"], max = [\"12 um\""
        ),
    );
    // It comes round four times before it is as low as the pillar.
    let after_periods = through_a_side
        .replace(
            "\"-1 m/s\", \"0 m/s\", \"0 m/s\"",
            "\"-10 m/s\", \"-0.5 m/s\", \"0 m/s\"",
        )
        .replace("[\"2 um\", \"6 um\"", "[\"2 um\", \"28 um\"")
        .replace("[\"6 um\", \"24 um\"", "[\"6 um\", \"29 um\"")
        .replace("time = \"8 us\"", "time = \"12 us\"");
    let through_a_mirror = through_a_side.replace("x = \"periodic\"", "x = \"symmetry\"");
    let bench = Workbench::new();
    for (case, sentence) in [
        (after_periods, "'plate' and 'pillar' would overlap"),
        (
            through_a_mirror,
            "'plate' would go through the symmetry side at the lower end of x",
        ),
        (with(SMALL, &riser), "when 'riser' of given velocity comes"),
        (with(SMALL, &post), "its body meets 'post'"),
        (through_a_side, "'plate' and 'pillar' would overlap"),
    ] {
        let output = run(&bench, &case, &[]);
        let said = said(&output);
        assert_eq!(output.status.code(), Some(2), "{sentence}: {said}");
        assert!(said.contains(sentence), "{said}");
    }
}

/// Before, a file for each of four thousand million was begun.
#[test]
fn more_snapshots_than_anyone_reads_are_refused() {
    let bench = Workbench::new();
    let output = run(&bench, SMALL, &["--set", "output.snapshots=4000000000"]);
    assert_eq!(output.status.code(), Some(2), "{}", said(&output));
    assert!(
        said(&output).contains("more than 1000000"),
        "{}",
        said(&output)
    );
}

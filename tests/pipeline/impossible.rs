//! Refusal before it starts of what cannot be right, in a sentence that says what to change.

use crate::verdicts::{EXPLICIT, SMALL, changed, run};
use crate::workbench::{Workbench, said};

const FIXED_PLATES: &str = "[[body]]\nmaterial = \"rigid\"\nname = \"bottom\"";

/// On commit 314e630 all of these ran, most to exit status 0.
#[test]
fn what_cannot_be_right_is_refused_before_it_starts() {
    let start = SMALL.find(FIXED_PLATES).unwrap();
    let end = SMALL.rfind("[[body]]").unwrap();
    let plates = &SMALL[start..end];
    let cases: &[(&[(&str, &str)], &str)] = &[
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
            &[("\"1.3 Pa s\"", "\"1e9 Pa s\""), EXPLICIT],
            "--yes-really runs it all the same",
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

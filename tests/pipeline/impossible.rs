//! Refusal before it starts of what cannot be right, in a sentence that says what to change.

use crate::verdicts::{EXPLICIT, SMALL, changed, widened};
use crate::workbench::Workbench;

const ENDLESS: (&str, &str) = ("\"1.3 Pa s\"", "\"1e9 Pa s\"");

/// On commit 314e630 all of these ran, most to exit status 0.
#[test]
fn what_cannot_be_right_is_refused_before_it_starts() {
    let bench = Workbench::new();
    let start = SMALL.find("[[body]]").unwrap();
    let end = SMALL.rfind("[[body]]").unwrap();
    let plates = &SMALL[start..end];
    for (changes, sentence) in [
        (
            &[("[\"0 m/s2\", \"0 m/s2\"", "[\"0 m/s2\", \"-1e15 m/s2\"")][..],
            "smaller acceleration",
        ),
        (&[(plates, "")], "[clamp] has nothing to move"),
        (
            &[("[\"0 um\", \"16 um\"", "[\"18 um\", \"16 um\"")],
            "does not come near the adhesive",
        ),
        (&[ENDLESS, EXPLICIT], "--yes-really runs it all the same"),
    ] {
        bench.write("case.toml", changed(changes));
        bench.ends(2, "mpm-run -q case.toml -o run", sentence);
        assert!(!bench.path("run").exists(), "{changes:?}");
    }
}

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
    bench.write("case.toml", widened("0.2 m"));
    let plan = bench.done("ulimit -v 2000000; mpm-run case.toml --explain --threads 1");
    assert!(plan.contains("1598800000 material points"), "{plan}");
}

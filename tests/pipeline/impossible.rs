//! Refusal before it starts of what cannot be right, in a sentence that says what to change.

use crate::verdicts::{EXPLICIT, changed, widened};
use crate::workbench::Workbench;

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
    bench.ends(2, run, "--yes-really runs it all the same");
    bench.write("case.toml", changed(&[("velocity = \"clamp\"\n", "")]));
    bench.ends(2, run, "[clamp] has nothing to move");
    assert!(!bench.path("run").exists());
    bench.write("case.toml", widened("0.2 m"));
    let plan = bench.done("ulimit -v 2000000; mpm-run case.toml --explain --threads 1");
    assert!(plan.contains("1598800000 material points"), "{plan}");
}

//! A pressure limit holds: in sealed liquid for as long as one likes, or the run says that it does not.

use crate::verdicts::SMALL;
use crate::workbench::{Workbench, said};

/// A chamber full of liquid that has no way out.
fn chamber(time_limit: &str, more: &str) -> String {
    SMALL
        .replace("max = [\"12 um\", \"14 um\"", "max = [\"24 um\", \"16 um\"")
        .replace(
            "travel = \"4 um\"",
            &format!("travel = \"4 um\"\ntime_limit = \"{time_limit}\""),
        )
        + more
}

/// Largest pressure on the upper body, Pa.
fn largest_pressure(bench: &Workbench) -> f64 {
    let history = std::fs::read_to_string(bench.path("run/history.csv")).unwrap();
    let mut lines = history.lines();
    let column = (lines.next().unwrap().split(','))
        .position(|name| name == "pressure_top_Pa")
        .unwrap();
    lines
        .map(|line| line.split(',').nth(column).unwrap().parse().unwrap())
        .fold(0.0, f64::max)
}

/// Before, the clamp went on at a millionth of its speed: 13 and 78 MPa within a second, "sound".
#[test]
fn sealed_liquid_is_held_at_the_limit_for_a_second() {
    let bench = Workbench::new();
    for (modulus, most) in [("0.1 GPa", 0.02), ("1 GPa", 1e-3)] {
        let case = chamber("1 s", "").replace("1 GPa", modulus);
        bench.write("case.toml", &case);
        let output = bench.run("mpm-run", &["-q", "case.toml", "-o", "run", "--overwrite"]);
        assert_eq!(output.status.code(), Some(0), "{}", said(&output));
        let over = largest_pressure(&bench) / 2.5e6 - 1.0;
        println!("sealed at {modulus}: {over:+.1e} of the limit at most");
        assert!(over < most, "{modulus}: {over}");
    }
}

/// A PID slows the clamp down step by step, too late for sealed liquid, and does not open it: 127, 13 and
/// 3.4 MPa were "sound".
#[test]
fn sealed_liquid_above_the_limit_by_a_pid_is_no_sound_run() {
    let bench = Workbench::new();
    let pid = "max_pressure = \"2.5 MPa\"\npid = { kp = 0.0, ki = 0.02, kd = 0.0 }";
    let implicit = |cfl: &str| {
        chamber("1 ms", "")
            .replace("max_pressure = \"2.5 MPa\"", pid)
            .replace("cfl = 0.5", cfl)
    };
    let explicit = chamber("0.5 us", "").replace("\"implicit\"", "\"explicit\"");
    for case in [implicit("cfl = 0.02"), implicit("cfl = 0.002"), explicit] {
        bench.write("case.toml", &case);
        let output = bench.run("mpm-run", &["-q", "case.toml", "-o", "run", "--overwrite"]);
        let said = said(&output);
        assert_eq!(output.status.code(), Some(1), "{said}");
        assert!(said.contains("above its max_pressure"), "{said}");
    }
}

//! A pressure limit holds: in sealed liquid for as long as one likes, or the run says that it does not.

use crate::verdicts::{EXPLICIT, SEALED, changed};
use crate::workbench::Workbench;

const RUN: &str = "mpm-run -q case.toml -o run --overwrite";

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

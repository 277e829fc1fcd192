//! Numbers of a sound case made extreme, by a seed: whatever they are, a run ends with a documented
//! status and a sentence, and with 0 only when its numbers are finite and its liquid is whole.
//!
//! `BONDLINE_SWEEP=2000` makes that many cases instead of the few of `make test`.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::verdicts::SMALL;
use crate::workbench::{Workbench, said};

/// Numbers of the case: the text around them, and their value there.
const NUMBERS: [(&str, &str, f64); 11] = [
    ("density = \"", " kg/m3\"", 1200.0),
    ("bulk_modulus = \"", " GPa\"", 1.0),
    ("viscosity = \"", " Pa s\"", 1.3),
    ("acceleration = [\"0 m/s2\", \"", " m/s2\"", -9.8),
    ("closing_speed = \"", " m/s\"", 1.0),
    ("max_pressure = \"", " MPa\"", 2.5),
    ("travel = \"", " um\"", 4.0),
    ("cfl = ", "\n", 0.5),
    ("history_every = \"", " us\"", 0.02),
    ("adhesive\"\nbox = { min = [\"", " um\"", 0.0),
    ("\"6 um\", \"0 um\"], max = [\"", " um\"", 12.0),
];

const SPECIAL: [&str; 6] = ["nan", "inf", "-inf", "0", "-1", "1e400"];

fn extreme(random: &mut ChaCha8Rng, value: f64) -> String {
    let decades = match random.random_range(0..20) {
        0..3 => return SPECIAL[random.random_range(0..SPECIAL.len())].into(),
        3..11 => 30.0,
        _ => 3.0,
    };
    format!(
        "{:e}",
        value * 10_f64.powf(random.random_range(-decades..decades))
    )
}

/// The case with one to three of its numbers changed, by one of the schemes.
fn mutated(random: &mut ChaCha8Rng) -> String {
    let mut text = SMALL.to_owned();
    // The last plate's corner is not the one meant below.
    for _ in 0..=random.random_range(0..3) {
        let (before, after, value) = NUMBERS[random.random_range(0..NUMBERS.len())];
        let start = text.rfind(before).expect(before) + before.len();
        let end = start + text[start..].find(after).expect(after);
        text.replace_range(start..end, &extreme(random, value));
    }
    if random.random_range(0..2) == 0 {
        text = text.replace("\"implicit\"", "\"explicit\"");
    }
    if random.random_range(0..4) == 0 {
        let limit = text.find("max_pressure").unwrap();
        let end = limit + text[limit..].find('\n').unwrap();
        text.replace_range(limit..=end, "");
    }
    text
}

#[test]
fn no_number_of_a_case_makes_a_run_lie_panic_or_hang() {
    let count = std::env::var("BONDLINE_SWEEP").map_or(60, |n| n.parse().unwrap());
    let mut random = ChaCha8Rng::seed_from_u64(2026);
    let bench = Workbench::new();
    let mut ends = std::collections::BTreeMap::<i32, u32>::new();
    for _ in 0..count {
        let case = mutated(&mut random);
        bench.write("case.toml", &case);
        // What is not over by then is told to stop; a hang is killed.
        let output = bench.shell(
            "timeout --preserve-status -k 60 1 mpm-run -q case.toml -o run --overwrite --threads 1",
        );
        let (code, said) = (output.status.code().unwrap_or(-1), said(&output));
        *ends.entry(code).or_default() += 1;
        assert!(
            // 143: told to stop before it had begun to listen.
            [0, 1, 2, 75, 143].contains(&code) && !said.contains("panicked"),
            "exit {code}: {said}\n{case}"
        );
        assert!(
            code == 0 || code == 143 || said.contains("mpm-run: "),
            "{said}\n{case}"
        );
        if code == 0 {
            sound(&bench, &case);
        }
    }
    println!("exit status and number of cases: {ends:?}");
}

/// Looks at what a run with exit status 0 left, without its own verdict.
fn sound(bench: &Workbench, case: &str) {
    let rows = bench.table("run/history.csv").rows.concat().concat();
    assert!(
        !rows.is_empty() && !rows.contains("NaN") && !rows.contains("inf"),
        "{rows}\n{case}"
    );
    let change = bench.summary("run", "volume_change");
    assert!(change.abs() < 0.106, "volume {change}\n{case}");
    // Half a cell.
    let deepest = bench.summary("run", "deepest_m");
    assert!(deepest <= 1.001e-6, "{deepest} m in wood\n{case}");
    bench.done("particles check run/final.mpts");
}

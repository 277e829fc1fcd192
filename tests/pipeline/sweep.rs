//! Numbers of a sound case made extreme, by a seed: whatever they are, a run ends with a documented
//! status and a sentence, and with 0 only when its numbers are finite and its liquid is whole.
//!
//! `BONDLINE_SWEEP=2000` makes that many cases instead of the few of `make test`.

use studies::outputs;

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

/// xorshift64*, which needs nobody's seed but ours.
struct Random(u64);

impl Random {
    fn below(&mut self, n: u64) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 32) % n
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.below(1 << 30) as f64 / f64::from(1 << 30)
    }

    fn extreme(&mut self, value: f64) -> String {
        let special = ["nan", "inf", "-inf", "0", "-1", "1e400"];
        match self.below(20) {
            n @ 0..3 => special[2 * n as usize + self.below(2) as usize].into(),
            3..11 => format!("{:e}", value * 10_f64.powf(self.between(-30.0, 30.0))),
            _ => format!("{:e}", value * 10_f64.powf(self.between(-3.0, 3.0))),
        }
    }
}

/// The case with one to three of its numbers changed, by one of the schemes.
fn mutated(random: &mut Random) -> String {
    let mut text = SMALL.to_owned();
    // The last plate's corner is not the one meant below.
    for _ in 0..=random.below(3) {
        let (before, after, value) = NUMBERS[random.below(NUMBERS.len() as u64) as usize];
        let start = text.rfind(before).expect(before) + before.len();
        let end = start + text[start..].find(after).expect(after);
        text.replace_range(start..end, &random.extreme(value));
    }
    if random.below(2) == 0 {
        text = text.replace("\"implicit\"", "\"explicit\"");
    }
    if random.below(4) == 0 {
        let limit = text.find("max_pressure").unwrap();
        let end = limit + text[limit..].find('\n').unwrap();
        text.replace_range(limit..=end, "");
    }
    text
}

#[test]
fn no_number_of_a_case_makes_a_run_lie_panic_or_hang() {
    let count = std::env::var("BONDLINE_SWEEP").map_or(60, |n| n.parse().unwrap());
    let mut random = Random(20_261_121);
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
    let history = String::from_utf8(bench.read("run/history.csv")).unwrap();
    let (_, rows) = history.split_once('\n').unwrap();
    assert!(
        !rows.is_empty() && !rows.contains("NaN") && !rows.contains("inf"),
        "{rows}\n{case}"
    );
    let run = outputs::Run {
        folder: bench.path("run"),
    };
    let number = |key: &str| run.summary(key).expect(key);
    let change = number("volume_change");
    assert!(change.abs() < 0.106, "volume {change}\n{case}");
    // Half a cell.
    let deepest = number("deepest_m");
    assert!(deepest <= 1.001e-6, "{deepest} m in wood\n{case}");
    bench.done("particles", &["check", "run/final.mpts"]);
}

//! `make forge`: forged particle files and checkpoints with right checksums, in process. Ends with
//! exit 1 where one of them panics, takes longer than [`LONGEST`] or more memory than [`MOST_GB`];
//! one that aborts or hangs leaves its input behind.

#![allow(clippy::print_stdout, reason = "prints for developers")]

use std::panic::catch_unwind;
use std::path::Path;
use std::process::ExitCode;
use std::time::{Duration, Instant};

use attack::{Mutator, Target};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

const LONGEST: Duration = Duration::from_secs(5);
const MOST_GB: f64 = 4.0;
/// Forgeries between two lines of the report.
const TOLD_EVERY: u64 = 5000;
/// Numbers at which arithmetic goes wrong.
const NUMBERS: [f64; 16] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    1e-300,
    1e-30,
    1e-15,
    1e-6,
    1e9,
    1e14,
    1e30,
    1e300,
    f64::MAX,
    f64::NAN,
    f64::INFINITY,
];

/// Half of the forgeries change bytes anywhere, half change whole numbers of header and arrays.
fn forged(mutator: &mut Mutator, random: &mut ChaCha8Rng, seeds: &[Vec<u8>]) -> Vec<u8> {
    if random.random_range(0..2) == 0 {
        return mutator.changed(seeds);
    }
    let mut bytes = seeds[random.random_range(0..seeds.len())].clone();
    for _ in 0..random.random_range(1..4) {
        // Arrays begin at multiples of 64 bytes; numbers of the header anywhere.
        let at = match random.random_range(0..3) {
            0 => random.random_range(32..bytes.len().min(1024)),
            _ => random.random_range(0..bytes.len() / 4) * 4,
        };
        let number = NUMBERS[random.random_range(0..NUMBERS.len())];
        let with = match random.random_range(0..4) {
            0 => (number as f32).to_le_bytes().to_vec(),
            1 => random.next_u32().to_le_bytes().to_vec(),
            _ => number.to_le_bytes().to_vec(),
        };
        for (byte, new) in bytes.iter_mut().skip(at).zip(with) {
            *byte = new;
        }
    }
    bytes
}

/// Largest memory that this process had so far, GB.
fn peak_gb() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kb = line.and_then(|l| l.split_whitespace().next()?.parse::<f64>().ok());
    kb.unwrap_or(0.0) / 1e6
}

/// Forges `count` files of a kind; whether all of them were harmless.
fn campaign(target: Target, count: u64, keep: &Path) -> bool {
    let seeds = target.seeds();
    let (mut mutator, mut random) = (Mutator::new(9), ChaCha8Rng::seed_from_u64(9));
    let (mut taken, mut panics, mut slow) = (0, 0, 0);
    let (begun, mut slowest) = (Instant::now(), Duration::ZERO);
    let last = keep.join(format!("{}.last", target.name()));
    for i in 0..count {
        let input = forged(&mut mutator, &mut random, &seeds);
        let _ = std::fs::write(&last, &input);
        let fed = Instant::now();
        let ended = catch_unwind(|| target.feed(&input));
        let took = fed.elapsed();
        slowest = slowest.max(took);
        taken += u64::from(matches!(ended, Ok(true)));
        panics += u64::from(ended.is_err());
        slow += u64::from(took > LONGEST);
        if (i + 1) % TOLD_EVERY == 0 || i + 1 == count {
            println!(
                "{}: {} forged in {:.0} s, {taken} taken, {panics} panics, {slow} longer than {} s (slowest {:.2} s), peak memory {:.2} GB",
                target.name(),
                i + 1,
                begun.elapsed().as_secs_f64(),
                LONGEST.as_secs(),
                slowest.as_secs_f64(),
                peak_gb()
            );
        }
        if ended.is_err() || took > LONGEST {
            let _ = std::fs::write(keep.join(format!("{}-{i}", target.name())), &input);
        }
    }
    panics == 0 && slow == 0 && peak_gb() < MOST_GB
}

fn main() -> ExitCode {
    let mut words = std::env::args().skip(1);
    let keep = words.next().unwrap_or_else(|| "out/forge".into());
    let count = words.next().and_then(|n| n.parse().ok()).unwrap_or(50_000);
    let keep = Path::new(&keep);
    if std::fs::create_dir_all(keep).is_err() {
        println!("cannot make the folder {}", keep.display());
        return ExitCode::FAILURE;
    }
    let only = words.next().unwrap_or_default();
    let kinds = [Target::ParticleFile, Target::Checkpoint];
    let mut harmless = true;
    for target in kinds.into_iter().filter(|kind| kind.name().contains(&only)) {
        harmless &= campaign(target, count, keep);
    }
    match harmless {
        true => ExitCode::SUCCESS,
        false => ExitCode::FAILURE,
    }
}

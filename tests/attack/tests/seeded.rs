//! A short attack in every `make test`: mutations of sound inputs of all kinds, always the same
//! ones. `make fuzz` is the long one, and `make forge`, which takes `ATTACKS` mutations of each kind here.

#![allow(clippy::print_stdout, reason = "prints for developers")]

use std::path::Path;
use std::sync::mpsc;
use std::thread;
use std::time::{Duration, Instant};

use attack::{Mutator, Target};

/// No input may keep a reader busy for so long; most take milliseconds. Where other tests run beside it, a reader may wait.
fn hang() -> Duration {
    Duration::from_secs(if std::env::var("ATTACKS").is_ok() {
        5
    } else {
        60
    })
}

/// Feeds what was found once, then `count` mutations of sound inputs; tells how many were taken.
fn attack(name: &str, count: u64) {
    let asked = std::env::var("ATTACKS").ok();
    let count = asked.map_or(count, |count| count.parse().unwrap());
    let target = Target::named(name).unwrap();
    // Where the last input lies: what aborts the process can be looked at.
    let kept = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.input"));
    let (feed, fed) = mpsc::sync_channel::<Vec<u8>>(0);
    let (done, ended) = mpsc::channel();
    thread::spawn(move || {
        for input in fed {
            let taken = std::panic::catch_unwind(|| (target.feed)(&input)).ok();
            if done.send(taken).is_err() {
                return;
            }
        }
    });
    let seeds = (target.seeds)();
    let mut mutator = Mutator::new(2026);
    let mutations = (0..count).map(|_| mutator.changed(&seeds));
    let (mut taken, mut slowest) = (0, Duration::ZERO);
    for (i, input) in target.finds().into_iter().chain(mutations).enumerate() {
        std::fs::write(&kept, &input).unwrap();
        let begun = Instant::now();
        feed.send(input).unwrap();
        match ended.recv_timeout(hang()) {
            Ok(Some(was_taken)) => taken += u64::from(was_taken),
            Ok(None) => panic!("{name} {i} panicked: {}", kept.display()),
            Err(_) => panic!("{name} {i} hangs: {}", kept.display()),
        }
        slowest = slowest.max(begun.elapsed());
    }
    std::fs::remove_file(kept).unwrap();
    let slowest = slowest.as_secs_f64();
    println!("{name}: {count} mutations, {taken} taken, slowest {slowest:.2} s");
}

#[test]
fn mutated_particle_files() {
    attack("particle-file", 300);
}

#[test]
fn mutated_checkpoints() {
    attack("checkpoint", 100);
}

#[test]
fn mutated_cases() {
    attack("case", 500);
}

#[test]
fn mutated_stacks() {
    for format in ["tiff", "npy", "mhd"] {
        attack(format, 1000);
    }
}

/// The attack must get through the door: mutations of what no reader takes find nothing.
#[test]
fn sound_seeds_are_taken() {
    for target in &attack::TARGETS {
        for (i, seed) in (target.seeds)().iter().enumerate() {
            assert!((target.feed)(seed), "{} {i}", target.name);
        }
    }
}

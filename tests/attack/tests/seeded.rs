//! A short attack in every `make test`: mutations of sound inputs of all kinds, always the same
//! ones. `make fuzz` is the long one.

#![allow(clippy::print_stdout, reason = "prints for developers")]

use std::path::{Path, PathBuf};
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

use attack::{Mutator, Target};

/// No input may keep a reader busy for so long; most take milliseconds.
const HANG: Duration = Duration::from_secs(60);

/// Where the last input lies: what aborts the process can be looked at.
fn last_input(target: Target) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{}.input", target.name()))
}

/// Feeds what was found once, then `count` mutations of sound inputs; tells how many were taken.
fn attack(target: Target, count: u64) {
    let kept = last_input(target);
    let (feed, fed) = mpsc::sync_channel::<Vec<u8>>(0);
    let (done, ended) = mpsc::channel();
    thread::spawn(move || {
        for input in fed {
            let taken = std::panic::catch_unwind(|| target.feed(&input)).ok();
            if done.send(taken).is_err() {
                return;
            }
        }
    });
    let seeds = target.seeds();
    let mut mutator = Mutator::new(2026);
    let mutations = (0..count).map(|_| mutator.changed(&seeds));
    let mut taken = 0;
    for (i, input) in target.finds().into_iter().chain(mutations).enumerate() {
        std::fs::write(&kept, &input).unwrap();
        feed.send(input).unwrap();
        match ended.recv_timeout(HANG) {
            Ok(Some(was_taken)) => taken += u64::from(was_taken),
            Ok(None) => panic!("{} {i} panicked: {}", target.name(), kept.display()),
            Err(_) => panic!("{} {i} hangs: {}", target.name(), kept.display()),
        }
    }
    std::fs::remove_file(kept).unwrap();
    println!("{}: {count} mutations, {taken} taken", target.name());
}

#[test]
fn mutated_particle_files() {
    attack(Target::ParticleFile, 300);
}

#[test]
fn mutated_checkpoints() {
    attack(Target::Checkpoint, 100);
}

#[test]
fn mutated_cases() {
    attack(Target::Case, 500);
}

#[test]
fn mutated_tiffs() {
    attack(Target::Tiff, 1000);
}

#[test]
fn mutated_arrays() {
    attack(Target::Npy, 1000);
}

#[test]
fn mutated_meta_images() {
    attack(Target::Mhd, 1000);
}

/// The attack must get through the door: mutations of what no reader takes find nothing.
#[test]
fn sound_seeds_are_taken() {
    for target in Target::ALL {
        for (i, seed) in target.seeds().iter().enumerate() {
            assert!(target.feed(seed), "{} {i}", target.name());
        }
    }
}

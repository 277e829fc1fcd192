//! Bytes from nobody we know, handed to the readers of the tools: a panic, a hang or a flood of
//! memory is a find.
//!
//! A [`Target`] is one kind of input. It has sound [`Target::seeds`] and a way in,
//! [`Target::feed`], which the coverage-guided targets of `tests/fuzz` and the seeded
//! mutations of `tests/seeded.rs` share.

mod bonds;
mod mutate;
mod readers;
mod runs;
mod seeds;
mod sign;

use std::fs;
use std::path::Path;

pub use mutate::Mutator;

/// A kind of input that the tools read.
pub struct Target {
    /// The name in messages, of the fuzz target and of the folder of finds.
    pub name: &'static str,
    /// Small sound inputs.
    pub seeds: fn() -> Vec<Vec<u8>>,
    /// Gives the bytes to all readers of this kind; whether they were taken. A panic is the only
    /// fault that shows here: time and memory the caller has to watch.
    pub feed: fn(&[u8]) -> bool,
}

const fn target(
    name: &'static str,
    seeds: fn() -> Vec<Vec<u8>>,
    feed: fn(&[u8]) -> bool,
) -> Target {
    Target { name, seeds, feed }
}

/// All kinds.
pub static TARGETS: [Target; 6] = [
    // Specimens, bonds and states: opened, checked, measured, built, pressed for one step.
    target("particle-file", seeds::particle_files, bonds::feed),
    // Read, restored, one step taken.
    target("checkpoint", runs::checkpoints, runs::feed),
    // Parsed, resolved, explained, with and without a bond.
    target("case", seeds::cases, readers::case),
    // Stacks: opened, segmented; MetaImages with their data beside or behind them.
    target("tiff", seeds::tiffs, |bytes| readers::stack("a.tif", bytes)),
    target("npy", seeds::arrays, |bytes| readers::stack("a.npy", bytes)),
    target("mhd", seeds::meta_images, |bytes| {
        readers::stack("a.mhd", bytes)
    }),
];

impl Target {
    /// The kind of this name.
    pub fn named(name: &str) -> Option<&'static Self> {
        TARGETS.iter().find(|target| target.name == name)
    }

    /// Inputs that made a tool misbehave once, from `finds/`.
    pub fn finds(&self) -> Vec<Vec<u8>> {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("finds");
        let entries = fs::read_dir(folder.join(self.name));
        let entries = entries.into_iter().flatten().flatten();
        let mut paths: Vec<_> = entries.map(|entry| entry.path()).collect();
        paths.sort();
        paths.iter().flat_map(fs::read).collect()
    }
}

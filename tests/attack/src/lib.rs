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
mod stacks;

use std::fs;
use std::path::Path;

pub use mutate::Mutator;

/// A kind of input that the tools read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Target {
    /// Specimens, bonds and states: opened, checked, measured, built, pressed for one step.
    ParticleFile,
    /// Checkpoints: read, restored, one step taken.
    Checkpoint,
    /// Case files: parsed, resolved, explained, with and without a bond.
    Case,
    /// TIFF stacks: opened, segmented.
    Tiff,
    /// NumPy arrays: the same.
    Npy,
    /// MetaImage headers with their data beside or behind them: the same.
    Mhd,
}

impl Target {
    /// All kinds.
    pub const ALL: [Target; 6] = [
        Target::ParticleFile,
        Target::Checkpoint,
        Target::Case,
        Target::Tiff,
        Target::Npy,
        Target::Mhd,
    ];

    /// The name in messages, of the fuzz target and of the folder of finds.
    pub fn name(self) -> &'static str {
        match self {
            Target::ParticleFile => "particle-file",
            Target::Checkpoint => "checkpoint",
            Target::Case => "case",
            Target::Tiff => "tiff",
            Target::Npy => "npy",
            Target::Mhd => "mhd",
        }
    }

    /// Small sound inputs.
    pub fn seeds(self) -> Vec<Vec<u8>> {
        match self {
            Target::ParticleFile => seeds::particle_files(),
            Target::Checkpoint => runs::checkpoints(),
            Target::Case => seeds::cases(),
            Target::Tiff => seeds::tiffs(),
            Target::Npy => seeds::arrays(),
            Target::Mhd => seeds::meta_images(),
        }
    }

    /// Inputs that made a tool misbehave once, from `finds/`.
    pub fn finds(self) -> Vec<Vec<u8>> {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("finds");
        let entries = fs::read_dir(folder.join(self.name()));
        let entries = entries.into_iter().flatten().flatten();
        let mut paths: Vec<_> = entries.map(|entry| entry.path()).collect();
        paths.sort();
        paths.iter().flat_map(fs::read).collect()
    }

    /// Gives the bytes to all readers of this kind; whether they were taken. A panic is the only
    /// fault that shows here: time and memory the caller has to watch.
    pub fn feed(self, bytes: &[u8]) -> bool {
        match self {
            Target::ParticleFile => bonds::feed(bytes),
            Target::Checkpoint => runs::feed(bytes),
            Target::Case => readers::case(bytes),
            Target::Tiff => stacks::feed("a.tif", bytes),
            Target::Npy => stacks::feed("a.npy", bytes),
            Target::Mhd => stacks::feed("a.mhd", bytes),
        }
    }
}

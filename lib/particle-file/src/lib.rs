//! The particle file (`.mpts`): one format for specimens, bond lines, states of a run and
//! checkpoints. FORMAT.md beside this crate describes every byte.
//!
//! Material that never moves on its own, or not yet, is stored as *blocks* of one bit per
//! voxel; liquid material points are stored as *columns*, one array per quantity. A file
//! is written in one pass (a [`Draft`] works on pipes) and read through a memory map: a
//! [`ParticleFile`] touches a column only when it is asked for.
//!
//! ```
//! use particle_file::{BitGrid, Block, Draft, Header, Kind, Material, ParticleFile};
//!
//! let wood = BitGrid::from_fn([100, 4, 2], |x, y, _| x > 50 || y == 0);
//! let header = Header::new(Kind::Specimen, 1.45e-6, 1, [0.0; 3], [1.45e-4, 5.8e-6, 2.9e-6]);
//! let block = Block::new("wood", Material::Rigid, [0.0; 3], 1.45e-6, &wood);
//! let mut bytes = Vec::new();
//! Draft::new(header).block(block, &wood).write_to(&mut bytes)?;
//!
//! let file = ParticleFile::from_bytes(&bytes)?;
//! let (block, bits) = file.block_named("wood")?;
//! assert_eq!(bits.count(), block.count);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod bits;
mod check;
mod error;
mod folder;
mod header;
mod layout;
pub mod limits;
mod map;
mod read;
mod section;
mod shell;
mod spool;
mod sum;
mod table_text;
mod worth;
mod write;

pub use bits::{BitGrid, Bits, BitsRef};
pub use error::Error;
pub use folder::{IDENTITY, RUN_MARK, by_time, file_of_run, in_folder, states_of_run};
pub use header::{Block, Header, Kind, Material, Provenance};
pub use map::{Mapped, open};
pub use read::{ParticleFile, Value};
pub use section::{Element, Section};
pub use shell::{command_line, quoted};
pub use spool::{fill, spool, temporary_file};
pub use table_text::read_table;
pub use write::Draft;

const _: () = assert!(
    cfg!(target_endian = "little"),
    "particle files are little-endian and mapped without conversion"
);

//! Where liquid can be: voxels of the bodies, rows of cells between them, pores and faces.

mod chords;
mod frames;
mod lattice;
mod measures;
mod mesh;
mod passages;
mod region;
mod rows;
mod split;
mod voxels;

pub(crate) use chords::{Chords, Place};
pub use lattice::check;
pub(crate) use lattice::{Lattice, MIRROR, OPEN};
pub(crate) use mesh::{Face, Mesh, Way, others};
pub(crate) use passages::narrowness;
pub(crate) use region::Region;
pub(crate) use rows::{DRIFT, RowKind, Rows};
pub(crate) use voxels::STEPS_SEEN;

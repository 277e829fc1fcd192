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
mod still;
mod voxels;

pub(crate) use chords::Chords;
pub(crate) use chords::Place;
#[cfg(test)]
pub(crate) use lattice::Moving;
pub(crate) use lattice::{Lattice, MIRROR, OPEN};
pub(crate) use mesh::{Face, Mesh, others};
pub(crate) use passages::narrowness;
pub(crate) use region::Region;
pub(crate) use rows::{RowKind, Rows};

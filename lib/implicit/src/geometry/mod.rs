//! Geometry of the grid: voxels of the bodies, rows of cells, pores (control volumes) and faces.

mod chords;
mod frames;
mod lattice;
mod measures;
mod mesh;
mod pore;
mod region;
mod rows;
mod split;
mod throats;
mod voxels;

pub(crate) use chords::{Chords, VoxelAddress};
pub use lattice::check;
pub(crate) use lattice::{Lattice, MIRROR, OPEN};
pub(crate) use mesh::{Mesh, others};
pub(crate) use pore::{Face, Neighbour};
pub(crate) use region::Region;
pub(crate) use rows::{DRIFT, RowKind, Rows};
pub(crate) use throats::perimeter_over_area;
pub(crate) use voxels::STEP_REACH;

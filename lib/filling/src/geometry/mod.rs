//! Where the rigid bodies are, and the lattice of cells, faces and sub-cells among them.

mod lattice;
mod sealed;
mod solids;
mod window;

pub(crate) use lattice::{Aperture, Chord, Column, Lattice, Passage, half};
pub(crate) use sealed::fill_sealed;
pub(crate) use solids::{
    Across, BodyId, LONG, MAX_BODIES, OPEN, Reentrant, SIDE, Solids, Surface, Wetted,
};
pub(crate) use window::{Domain, PAD, Window};

#[cfg(test)]
pub(crate) mod tests;

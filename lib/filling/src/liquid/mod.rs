//! The liquid: its particles, and what of the lattice they fill and carry.

mod fractions;
mod particles;
mod rolling;
mod volumes;

pub(crate) use fractions::{Fractions, neighbours, pressures, sub_cells, velocities};
pub(crate) use particles::{Bins, Particles};
pub(crate) use rolling::nearest_air;
pub(crate) use volumes::Volumes;

#[cfg(test)]
pub(crate) use particles::tests;

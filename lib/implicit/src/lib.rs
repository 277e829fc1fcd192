//! The implicit scheme: liquid as volume fractions on a staggered grid whose rows close with the press.
//!
//! Inside, lengths are in cells, velocities in cells a second, and pressures are divided by the unit of viscosity.
//! The parts in the order in which they use one another: `geometry` (voxels, rows, pores and the faces between them),
//! `liquid` (volumes in pores and how they move), `air` (what it closes off), `system` (unknowns and equations of one step), `step` (the order of
//! a step).

mod air;
mod geometry;
mod liquid;
mod settings;
mod step;
mod system;

pub use settings::Settings;
pub use step::Implicit;

//! The implicit scheme: liquid as volume fractions on a staggered grid whose rows close with the press.
//!
//! Inside, lengths are in cells, velocities in cells a second, and pressures are divided by the unit of viscosity.
//! The parts in the order in which they use one another: `geometry` (voxels, rows, pores and the faces between them),
//! `liquid` (volumes in pores and how they move), `air` (what it closes off), `system` (unknowns and equations of one
//! step), `water` (what walls take of it), `step` (the order of a step),
//! `permeability` (steady flow by the same equations).

mod air;
mod clock;
mod geometry;
mod liquid;
mod permeability;
mod plan;
mod settings;
mod step;
mod system;
mod water;

pub use geometry::check;
pub use permeability::{Permeability, permeability};
pub use plan::Plan;
pub use settings::Settings;
pub use step::Implicit;

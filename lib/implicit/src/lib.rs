//! The implicit scheme (docs/methods.md section 3): volume fractions on a staggered grid whose rows close with the press.
//!
//! Control volumes are *pores*, connected open voxels of a cell; *faces* between them carry a velocity. Units inside the
//! crate: cells, seconds, viscosities over the unit eta_0, pressures and forces over eta_0/s.
//!
//! Modules in the order in which they use one another: `geometry` (voxels, rows, pores, faces), `liquid` (volumes in pores
//! and their advection), `air` (pockets closed off by liquid), `system` (unknowns and equations of a step), `water` (loss
//! of water to walls), `step` (the order of a step), `permeability` (steady flow by the same equations).

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

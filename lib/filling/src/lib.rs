//! The implicit scheme: a staggered (MAC) pressure-viscosity step with particles as markers
//! and walls at the true voxel faces, for viscous liquid pressed into narrow lumens.
//!
//! Lengths inside are in cells, pressures and viscosities scaled by the liquid's viscosity.
//! Each room uses only those before it: `geometry` (where the bodies are, and the lattice around
//! them), `liquid` (particles and what they fill), `water` (what of it goes into walls), `system` (unknowns
//! and equations), `transport` (particles follow the flow), `step` (the order of a step).

mod geometry;
mod liquid;
mod plan;
mod settings;
mod stages;
mod step;
mod system;
mod transport;
mod water;

pub use plan::Plan;
pub use settings::Settings;
pub use step::Implicit;

//! The implicit scheme: a staggered (MAC) pressure-viscosity step with particles as markers
//! and walls at the true voxel faces, for viscous liquid pressed into narrow lumens.
//!
//! Lengths inside are in cells, pressures and viscosities scaled by the liquid's viscosity.

pub mod advect;
pub mod density;
pub mod fractions;
pub mod lattice;
pub mod operator;
pub mod particles;
mod plan;
pub mod reach;
mod settings;
pub mod solids;
mod step;
pub mod wall;
pub mod window;

pub use plan::Plan;
pub use settings::Settings;
pub use step::Implicit;

//! Particles follow the flow between the faces, keep their density, and take up what is there.

mod carry;
pub(crate) mod density;
mod field;
mod flow;
mod motion;

pub(crate) use carry::{set_velocities, set_volume_changes, shear_rates};
pub(crate) use field::Field;
pub(crate) use flow::{Flow, Near, extend};
pub(crate) use motion::Path;

#[cfg(test)]
mod tests;

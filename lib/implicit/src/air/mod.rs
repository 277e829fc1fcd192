//! Pockets of air that liquid and walls close off: an ideal gas at constant temperature (docs/methods.md section 3.13).

mod law;
mod pockets;

pub(crate) use law::Gas;
pub(crate) use pockets::{Air, Pocket};

//! Air that liquid and walls close off: pockets of it, how much each holds, and its pressure, that of an ideal gas at
//! constant temperature.

mod law;
mod pockets;

pub(crate) use law::Gas;
pub(crate) use pockets::{Air, Pocket};

//! Air that liquid and walls close off: pockets of it, how much each holds, its pressure, and its rows in
//! the system of a step.
//!
//! Each pocket has one pressure, of an ideal gas at constant temperature: p V = p_0 V_0. Equations:
//! docs/methods.md section 3.13.

mod held;
mod law;
mod pockets;
mod rows;

pub(crate) use held::Held;
pub(crate) use law::Tangent;
pub(crate) use law::{Gas, Measure};
pub(crate) use pockets::{Outside, Pockets};
pub(super) use rows::append;

//! The liquid: the volume of it in each pore, how it starts and moves.

mod carry;
mod deposit;
mod overflow;
mod transport;
mod water;

pub(crate) use carry::{
    Kept, carried_pressures, carried_region, carried_velocities, carried_volumes,
};
pub(crate) use deposit::{Place, deposit};
pub(crate) use transport::{Moved, TRACE, transport};

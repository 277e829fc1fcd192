//! The liquid: the volume of it in each pore, how it starts, moves, and is shown.

mod carry;
mod deposit;
mod output;
mod overflow;
mod profile;
mod transport;
mod water;

pub(crate) use carry::{
    Kept, carried_pressures, carried_region, carried_velocities, carried_volumes,
};
pub(crate) use deposit::{Place, deposit};
pub(crate) use output::{Shown, TRACE, points};
pub(crate) use profile::Profile;
pub(crate) use transport::{Moved, ROUNDING, transport};

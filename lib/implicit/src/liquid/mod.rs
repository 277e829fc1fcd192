//! The liquid volume of each pore: initial deposit, advection, transfer to a new mesh.

mod advect_water;
mod deposit;
mod overflow;
mod remap;
mod transport;

pub(crate) use deposit::{GridOrigin, deposit};
pub(crate) use remap::{
    FaceMap, remapped_pressures, remapped_region, remapped_velocities, remapped_volumes,
};
pub(crate) use transport::{Moved, TRACE, transport};

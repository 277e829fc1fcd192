//! Unknowns, equations and solution of a step (docs/methods.md sections 3.3 to 3.8 and 3.12).

mod assembly;
mod coupling;
mod couplings;
mod edges;
mod equations;
mod fronts;
mod halves;
mod piston;
mod profile;
mod solution;
mod stretching;
mod thinning;
mod unknowns;
mod viscosity;
mod viscosity_iteration;

pub(crate) use assembly::{Coefficients, Problem};
pub(crate) use couplings::{Channels, WallCouplings};
pub(crate) use edges::Edges;
pub(crate) use equations::resistance;
pub(crate) use fronts::{Fronts, REST_DISTANCE, Wetting};
pub(crate) use halves::masses;
pub(crate) use profile::Profile;
pub(crate) use solution::{Drive, Flow, forces, solve};
pub(crate) use unknowns::{FULL, Unknowns};
pub(crate) use viscosity::{FlowField, Viscosities};
pub(crate) use viscosity_iteration::{MAX_PASSES, ViscosityIteration};

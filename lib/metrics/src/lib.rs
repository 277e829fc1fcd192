//! Metrics of a bond line: weighted and effective penetration, maps, depth
//! profiles, agreement with an experiment, and the shear rates of a run.
//!
//! A [`State`] is the common view of a specimen, of a bond before pressing and of a state of
//! a run; a [`Datum`] is the reference of depths; the rest are functions of both.
//! Lengths are metres, and all results are independent of the number of threads.

mod bond_line;
mod case;
mod cell_error;
mod compare;
mod datum;
mod depth_profile;
mod distance;
mod error;
mod fit;
mod islands;
mod levelling;
mod map;
mod openings;
mod penetration;
mod pores;
mod quantile;
mod sealed;
mod shear_rate;
mod state;
pub mod table;

pub use bond_line::{BondLine, Filling, bond_line};
pub use case::case_without_cells;
pub use cell_error::{CellError, Extrapolated, LEAST_RATIO, cell_error, extrapolated};
pub use compare::{Agreement, compare};
pub use datum::{Datum, Reference};
pub use depth_profile::{DepthLayer, depth_profile};
pub use error::Error;
pub use fit::Tilt;
pub use islands::without_islands;
pub use levelling::{LevelledSpecimen, level};
pub use map::Map;
pub use penetration::{Penetration, Side, penetration};
pub use pores::{PoreSize, pore_sizes};
pub use sealed::Sealed;
pub use shear_rate::{Convention, ShearRates, tube_shear_rate};
pub use state::{Across, Adhesive, State, Wood};

//! The keys of `[air]`.

use serde::Deserialize;
use units::{Pressure, Time};

use super::value::Positive;

/// `[air]`
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AirTable {
    /// Absolute pressure of the air around.
    pub pressure: Positive<Pressure>,
    /// Time in which the excess pressure of a pocket of fixed volume falls to 1/e.
    pub leak_time: Option<Positive<Time>>,
}

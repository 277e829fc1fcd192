//! The table of a press programme's stages in a case file.

use physics::Press;
use serde::Deserialize;
use units::{Length, Pressure, Speed, Time};

use super::value::{Positive, choice};

/// `[[clamp.stage]]`
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StageTable {
    /// What it does: `"approach"`, `"ramp"`, `"hold"` or `"release"`.
    #[serde(deserialize_with = "choice")]
    pub kind: Press,
    /// Largest speed of the clamp, closing or giving way; that of the stage before by default.
    pub speed: Option<Positive<Speed>>,
    /// Pressure that ends an approach, that a ramp goes to, or that a hold keeps: that of the
    /// stage before by default.
    pub pressure: Option<Positive<Pressure>>,
    /// Longest duration; an approach may go on until the clamp has gone all its way.
    pub time: Option<Positive<Time>>,
    /// Ends with this travel of the clamp since the start of the run.
    pub travel: Option<Positive<Length>>,
    /// Ends an approach with the first step in which liquid presses on the clamp's body.
    #[serde(default)]
    pub contact: bool,
    /// Ends a hold or a release when less than this leaves the bond line, volume per area and
    /// time: the speed of the clamp.
    pub slower: Option<Positive<Speed>>,
}

//! The keys of `[adhesive.water]`.

use serde::Deserialize;
use units::{Diffusivity, Length, Speed};

use super::value::Positive;

/// `[adhesive.water]`
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct WaterTable {
    /// Solids content at the start, by mass.
    pub solids: f64,
    /// Volume of water that wood takes per wetted area and time.
    pub uptake: Positive<Speed>,
    /// Volume of water that a wall holds per area.
    pub capacity: Option<Positive<Length>>,
    /// Diffusivity of water in the adhesive.
    pub diffusivity: Positive<Diffusivity>,
    /// Solids content from which wood takes no more.
    pub limit: Option<f64>,
    /// Factor of the viscosity against solids content.
    pub viscosity_by_solids: Vec<(f64, f64)>,
    /// Names of the bodies that take water.
    #[serde(default)]
    pub walls: Vec<String>,
}

//! The tables and keys of a case file, except those of the liquid. docs/case-file.md explains each.

use mpm::{PressureFrom, ShapeFunction, VelocityUpdate};
use physics::{Boundary, Choice, Press, WallLaw};
use serde::Deserialize;
use units::{Acceleration, Length, Pressure, Quantity, Speed, Time};

use super::adhesive::Adhesive;
use super::value::{BodyVelocity, EdgeLength, Positive, StopRule, choice, in_voxels, some_choice};

/// A case file.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Case {
    pub(crate) grid: GridTable,
    pub(crate) adhesive: Adhesive,
    pub(crate) contact: Option<ContactTable>,
    pub(crate) clamp: Option<ClampTable>,
    pub(crate) integrator: IntegratorTable,
    #[serde(default)]
    pub(crate) output: OutputTable,
    #[serde(default)]
    pub(crate) body: Vec<BodyTable>,
    pub(crate) gravity: Option<GravityTable>,
    pub(crate) air: Option<AirTable>,
    #[serde(default)]
    pub(crate) boundary: BoundaryTable,
    pub(crate) stop: Option<StopTable>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct GridTable {
    #[serde(deserialize_with = "in_voxels")]
    pub(crate) cell: EdgeLength,
    #[serde(default = "three")]
    pub(crate) dimensions: u8,
    #[serde(default, deserialize_with = "some_choice")]
    pub(crate) shape: Option<ShapeFunction>,
    #[serde(default = "two")]
    pub(crate) points_per_direction: u8,
    pub(crate) domain: Option<BoxCorners>,
}

fn three() -> u8 {
    3
}

fn two() -> u8 {
    2
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ContactTable {
    #[serde(deserialize_with = "choice")]
    pub(crate) law: WallLaw,
    pub(crate) influence_length: Option<EdgeLength>,
    pub(crate) separation: Option<EdgeLength>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ClampTable {
    pub(crate) closing_speed: Option<Positive<Speed>>,
    pub(crate) max_pressure: Option<Positive<Pressure>>,
    pub(crate) pid: Option<PidGains>,
    pub(crate) stop: Option<StopRule>,
    pub(crate) time_limit: Option<Positive<Time>>,
    pub(crate) travel: Option<Positive<Length>>,
    #[serde(default = "closed_gap", deserialize_with = "in_voxels")]
    pub(crate) closed_gap: EdgeLength,
    #[serde(default)]
    pub(crate) stage: Vec<StageTable>,
}

/// Gap at which a bond counts as closed. A film of liquid under a finite pressure never closes, and voxels tell the surfaces of
/// wood no better.
fn closed_gap() -> EdgeLength {
    EdgeLength::Edges(0.1)
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PidGains {
    pub(crate) kp: f64,
    pub(crate) ki: f64,
    pub(crate) kd: f64,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct StageTable {
    #[serde(deserialize_with = "choice")]
    pub(crate) kind: Press,
    pub(crate) speed: Option<Positive<Speed>>,
    pub(crate) pressure: Option<Positive<Pressure>>,
    pub(crate) time: Option<Positive<Time>>,
    pub(crate) travel: Option<Positive<Length>>,
    #[serde(default)]
    pub(crate) contact: bool,
    pub(crate) slower: Option<Positive<Speed>>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct IntegratorTable {
    #[serde(deserialize_with = "choice")]
    pub(crate) scheme: SchemeName,
    #[serde(default, deserialize_with = "some_choice")]
    pub(crate) velocity_update: Option<VelocityUpdate>,
    pub(crate) order: Option<u8>,
    pub(crate) cfl: Option<f64>,
    #[serde(default, deserialize_with = "some_choice")]
    pub(crate) pressure: Option<PressureFrom>,
    pub(crate) density_projection: Option<EdgeLength>,
    pub(crate) tolerance: Option<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SchemeName {
    Explicit,
    Implicit,
}

impl Choice for SchemeName {
    const NAMED: &'static [(&'static str, Self)] =
        &[("explicit", Self::Explicit), ("implicit", Self::Implicit)];
}

#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct OutputTable {
    #[serde(default, deserialize_with = "snapshots")]
    pub(crate) snapshots: u32,
    pub(crate) history_every: Option<Positive<Time>>,
    #[serde(default)]
    pub(crate) penetration: bool,
}

/// Most snapshots accepted; each is a file.
const MOST_SNAPSHOTS: u32 = 1_000_000;

fn snapshots<'de, R: serde::Deserializer<'de>>(reader: R) -> Result<u32, R::Error> {
    let number = u32::deserialize(reader)?;
    if number <= MOST_SNAPSHOTS {
        return Ok(number);
    }
    Err(serde::de::Error::custom(format!(
        "{number} snapshots are more than {MOST_SNAPSHOTS}: a file each is written"
    )))
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct BodyTable {
    pub(crate) material: MaterialName,
    #[serde(rename = "box")]
    pub(crate) corners: BoxCorners,
    pub(crate) velocity: Option<BodyVelocity>,
    pub(crate) name: Option<String>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(crate) enum MaterialName {
    Adhesive,
    Rigid,
}

/// A box by its low and high corner.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct BoxCorners {
    pub(crate) min: [Quantity<Length>; 3],
    pub(crate) max: [Quantity<Length>; 3],
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct GravityTable {
    pub(crate) acceleration: [Quantity<Acceleration>; 3],
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct AirTable {
    pub(crate) pressure: Positive<Pressure>,
    pub(crate) leak_time: Option<Positive<Time>>,
}

/// Conditions on the sides normal to each axis.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct BoundaryTable {
    #[serde(default, deserialize_with = "choice")]
    pub(crate) x: Boundary,
    #[serde(default, deserialize_with = "choice")]
    pub(crate) y: Boundary,
    #[serde(default, deserialize_with = "choice")]
    pub(crate) z: Boundary,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct StopTable {
    pub(crate) time: Positive<Time>,
}

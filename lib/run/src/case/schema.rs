//! The tables and keys of a case file.

use mpm::{PressureFrom, ShapeFunction, VelocityUpdate};
use physics::{Boundary, Choice, ShearRate, WallLaw};
use serde::Deserialize;
use units::{Acceleration, Density, Length, Pressure, Quantity, Speed, Time, Viscosity};

use super::air::AirTable;
use super::cure::CureTable;
use super::press::StageTable;
use super::rheology::{CarreauYasuda, Cross, HerschelBulkley, PowerLaw};
use super::value::{BodyVelocity, CellEdge, CellLength, Positive, StopRule, choice, some_choice};
use super::water::WaterTable;

/// A case file.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// Cells.
    pub grid: Grid,
    /// The liquid.
    pub adhesive: Adhesive,
    /// Wall law; may be left out where there is no rigid body.
    pub contact: Option<Contact>,
    /// Clamp.
    pub clamp: Option<ClampTable>,
    /// Scheme and its options.
    pub integrator: Integrator,
    /// Output.
    #[serde(default)]
    pub output: OutputTable,
    /// Bodies, where no particle file gives them.
    #[serde(default)]
    pub body: Vec<Body>,
    /// Body force.
    pub gravity: Option<Gravity>,
    /// Air that is closed off.
    pub air: Option<AirTable>,
    /// Sides of the domain.
    #[serde(default)]
    pub boundary: Axes,
    /// End of a run without clamp.
    pub stop: Option<StopTable>,
}

/// `[grid]`
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Grid {
    /// Edge of a cubic cell.
    pub cell: CellEdge,
    /// 2 (plane strain) or 3.
    #[serde(default = "three")]
    pub dimensions: u8,
    /// Shape function of the explicit scheme; the paper's by default.
    #[serde(default, deserialize_with = "some_choice")]
    pub shape: Option<ShapeFunction>,
    /// Material points per cell edge at the start.
    #[serde(default = "two")]
    pub points_per_direction: u8,
    /// Box to compute in, where `[[body]]` describes the scene; their bounding box if absent.
    pub domain: Option<BoxCorners>,
}

fn three() -> u8 {
    3
}

fn two() -> u8 {
    2
}

/// `[adhesive]`
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Adhesive {
    /// Mass density.
    pub density: Positive<Density>,
    /// Bulk modulus K of Eq. 1.
    pub bulk_modulus: Positive<Pressure>,
    /// Newtonian viscosity.
    pub viscosity: Option<Positive<Viscosity>>,
    /// Viscosity against shear rate.
    pub viscosity_table: Option<Vec<(Positive<units::ShearRate>, Positive<Viscosity>)>>,
    /// Viscosity by a power law.
    pub power_law: Option<PowerLaw>,
    /// By Cross' law.
    pub cross: Option<Cross>,
    /// By the law of Carreau and Yasuda.
    pub carreau_yasuda: Option<CarreauYasuda>,
    /// By that of Herschel and Bulkley.
    pub herschel_bulkley: Option<HerschelBulkley>,
    /// Change of the viscosity with time and temperature.
    pub cure: Option<CureTable>,
    /// Loss of water into the cell walls.
    pub water: Option<WaterTable>,
    /// Convention of the rate in eta(rate).
    #[serde(default, deserialize_with = "choice")]
    pub shear_rate: ShearRate,
    /// Largest tension the liquid carries.
    pub cavitation_pressure: Option<Positive<Pressure>>,
    /// Surface tension.
    pub surface_tension: Option<Positive<units::SurfaceTension>>,
    /// Contact angle, measured in the liquid.
    pub contact_angle: Option<units::Quantity<units::Angle>>,
    /// What the cosine of the contact angle loses per capillary number of the front.
    pub dynamic_angle: Option<f64>,
}

/// `[contact]`
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Contact {
    /// Which law.
    #[serde(deserialize_with = "choice")]
    pub law: WallLaw,
    /// 1/k of Eq. 3, for partial slip.
    pub influence_length: Option<CellLength>,
    /// Explicit: largest separation of liquid and wall at a node at which they touch.
    pub separation: Option<CellLength>,
}

/// `[clamp]`
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ClampTable {
    /// Largest closing speed; stages have their own.
    pub closing_speed: Option<Positive<Speed>>,
    /// Pressure limit.
    pub max_pressure: Option<Positive<Pressure>>,
    /// Gains of the load controller.
    pub pid: Option<PidGains>,
    /// When to stop; when closed by default.
    pub stop: Option<StopRule>,
    /// Latest end of a run that stops when closed.
    pub time_limit: Option<Positive<Time>>,
    /// Closing distance where `[[body]]` describes the scene.
    pub travel: Option<Positive<Length>>,
    /// Press programme, in place of one speed, one limit and one end.
    #[serde(default)]
    pub stage: Vec<StageTable>,
}

/// `pid`
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PidGains {
    /// Proportional.
    pub kp: f64,
    /// Integral.
    pub ki: f64,
    /// Derivative.
    pub kd: f64,
}

/// `[integrator]`
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Integrator {
    /// Explicit or implicit.
    #[serde(deserialize_with = "choice")]
    pub scheme: SchemeName,
    /// Explicit: how particle velocities are updated.
    #[serde(default, deserialize_with = "some_choice")]
    pub velocity_update: Option<VelocityUpdate>,
    /// Order of xpic and fmpm.
    pub order: Option<u8>,
    /// Courant number of the limit that binds; 0.5 by the explicit scheme, 1 by the implicit one.
    pub cfl: Option<f64>,
    /// Explicit: whose volume change sets a point's pressure; its own, as in the paper, by
    /// default.
    #[serde(default, deserialize_with = "some_choice")]
    pub pressure: Option<PressureFrom>,
    /// Explicit: how far the fastest point moves between two projections of the points to
    /// uniform density; none, as in the paper, by default.
    pub density_projection: Option<CellLength>,
    /// Implicit: relative residual at which the linear solve stops.
    pub tolerance: Option<f64>,
}

/// `scheme`
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SchemeName {
    /// The paper's material point method.
    Explicit,
    /// Liquid as volume fractions on a staggered grid that closes with the press.
    Implicit,
}

impl Choice for SchemeName {
    const NAMED: &'static [(&'static str, Self)] =
        &[("explicit", Self::Explicit), ("implicit", Self::Implicit)];
}

/// `[output]`
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OutputTable {
    /// Snapshots over the nominal duration; none by default.
    #[serde(default, deserialize_with = "snapshots")]
    pub snapshots: u32,
    /// Time between rows of the history; a thousandth of the nominal duration by default.
    pub history_every: Option<Positive<Time>>,
    /// Whether rows of the history tell what the press has come to.
    #[serde(default)]
    pub penetration: bool,
}

/// More than this is a mistake: a file each.
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

/// `[[body]]`
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Body {
    /// Adhesive or rigid.
    pub material: MaterialName,
    /// Its corners.
    #[serde(rename = "box")]
    pub corners: BoxCorners,
    /// Its velocity; at rest by default.
    pub velocity: Option<BodyVelocity>,
    /// Whose reaction it carries: bodies of one name and velocity are one body.
    pub name: Option<String>,
}

/// `material`
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum MaterialName {
    /// Liquid.
    Adhesive,
    /// Wall.
    Rigid,
}

/// A box by its corners.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BoxCorners {
    /// Low corner.
    pub min: [Quantity<Length>; 3],
    /// High corner.
    pub max: [Quantity<Length>; 3],
}

/// `[gravity]`
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Gravity {
    /// Body force per mass.
    pub acceleration: [Quantity<Acceleration>; 3],
}

/// `[boundary]`
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Axes {
    /// Sides normal to x.
    #[serde(default, deserialize_with = "choice")]
    pub x: Boundary,
    /// Sides normal to y.
    #[serde(default, deserialize_with = "choice")]
    pub y: Boundary,
    /// Sides normal to z.
    #[serde(default, deserialize_with = "choice")]
    pub z: Boundary,
}

/// `[stop]`
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StopTable {
    /// End of the run.
    pub time: Positive<Time>,
}

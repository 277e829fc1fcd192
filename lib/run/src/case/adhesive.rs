//! `[adhesive]` and the tables below it.

use physics::ShearRate;
use serde::Deserialize;
use serde::de::{Deserializer, Error};
use units::{
    Angle, Consistency, Density, Diffusivity, Length, MolarEnergy, Pressure, Quantity, Speed,
    SurfaceTension, Time, Viscosity,
};

use super::value::{Positive, choice};

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Adhesive {
    pub(crate) density: Positive<Density>,
    pub(crate) bulk_modulus: Positive<Pressure>,
    pub(crate) viscosity: Option<Positive<Viscosity>>,
    pub(crate) viscosity_table: Option<Vec<(Positive<units::ShearRate>, Positive<Viscosity>)>>,
    pub(crate) power_law: Option<PowerLaw>,
    pub(crate) cross: Option<Cross>,
    pub(crate) carreau_yasuda: Option<CarreauYasuda>,
    pub(crate) herschel_bulkley: Option<HerschelBulkley>,
    pub(crate) cure: Option<CureTable>,
    pub(crate) water: Option<WaterTable>,
    #[serde(default, deserialize_with = "choice")]
    pub(crate) shear_rate: ShearRate,
    pub(crate) cavitation_pressure: Option<Positive<Pressure>>,
    pub(crate) surface_tension: Option<Positive<SurfaceTension>>,
    pub(crate) contact_angle: Option<Quantity<Angle>>,
    pub(crate) dynamic_angle: Option<f64>,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PowerLaw {
    pub(crate) consistency: Positive<Consistency>,
    pub(crate) index: f64,
    pub(crate) rates: [Positive<units::ShearRate>; 2],
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Cross {
    pub(crate) zero_rate: Positive<Viscosity>,
    pub(crate) infinite_rate: Positive<Viscosity>,
    pub(crate) time: Positive<Time>,
    pub(crate) exponent: f64,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct CarreauYasuda {
    pub(crate) zero_rate: Positive<Viscosity>,
    pub(crate) infinite_rate: Positive<Viscosity>,
    pub(crate) time: Positive<Time>,
    pub(crate) index: f64,
    #[serde(default = "carreau")]
    pub(crate) transition: f64,
}

fn carreau() -> f64 {
    2.0
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct HerschelBulkley {
    pub(crate) yield_stress: Positive<Pressure>,
    pub(crate) consistency: Positive<Consistency>,
    pub(crate) index: f64,
    pub(crate) regularisation_rate: Positive<units::ShearRate>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct WaterTable {
    pub(crate) solids: f64,
    pub(crate) uptake: Positive<Speed>,
    pub(crate) capacity: Option<Positive<Length>>,
    pub(crate) diffusivity: Positive<Diffusivity>,
    pub(crate) limit: Option<f64>,
    pub(crate) viscosity_by_solids: Vec<(f64, f64)>,
    #[serde(default)]
    pub(crate) walls: Vec<String>,
}

#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct CureTable {
    pub(crate) gel_time: Option<Positive<Time>>,
    pub(crate) exponent: Option<f64>,
    pub(crate) factor: Option<Vec<(Quantity<Time>, f64)>>,
    pub(crate) temperature: Option<Vec<(Quantity<Time>, Kelvin)>>,
    pub(crate) reference_temperature: Option<Kelvin>,
    pub(crate) activation_energy: Option<Positive<MolarEnergy>>,
    pub(crate) flow_activation_energy: Option<Positive<MolarEnergy>>,
}

/// A temperature, K; written in K or in degrees Celsius (C).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Kelvin(pub(crate) f64);

impl<'de> Deserialize<'de> for Kelvin {
    fn deserialize<R: Deserializer<'de>>(reader: R) -> Result<Self, R::Error> {
        /// 0 C in K.
        const ICE: f64 = 273.15;
        /// Wood does not exist above this temperature, K.
        const MOST: f64 = 1000.0;
        let text = String::deserialize(reader)?;
        let number = |unit: &str| text.trim().strip_suffix(unit)?.trim().parse::<f64>().ok();
        let celsius = ["°C", "degC", "C"].into_iter().find_map(number);
        let kelvin = number("K").or(celsius.map(|t| t + ICE));
        kelvin.filter(|t| *t > 0.0 && *t <= MOST).map(Self).ok_or_else(|| {
            R::Error::custom(format!(
                "'{text}' is not accepted: a temperature up to {MOST} K such as \"140 C\" or \"413 K\" is needed"
            ))
        })
    }
}

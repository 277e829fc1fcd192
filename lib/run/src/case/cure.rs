//! The keys of `[adhesive.cure]`.

use serde::Deserialize;
use serde::de::{Deserializer, Error};
use units::{MolarEnergy, Time};

use super::value::Positive;

/// `[adhesive.cure]`
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CureTable {
    /// t_gel of (1 - t/t_gel)^-n.
    pub gel_time: Option<Positive<Time>>,
    /// n.
    pub exponent: Option<f64>,
    /// Factor of the viscosity against time.
    pub factor: Option<Vec<(units::Quantity<Time>, f64)>>,
    /// Temperature against time.
    pub temperature: Option<Vec<(units::Quantity<Time>, Kelvin)>>,
    /// Temperature that the other numbers belong to.
    pub reference_temperature: Option<Kelvin>,
    /// Activation energy of cure.
    pub activation_energy: Option<Positive<MolarEnergy>>,
    /// Activation energy of flow.
    pub flow_activation_energy: Option<Positive<MolarEnergy>>,
}

/// A temperature, K; written in K or in degrees Celsius (C).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kelvin(pub f64);

impl<'de> Deserialize<'de> for Kelvin {
    fn deserialize<R: Deserializer<'de>>(reader: R) -> Result<Self, R::Error> {
        /// 0 C, K.
        const ICE: f64 = 273.15;
        let text = String::deserialize(reader)?;
        let number = |unit: &str| text.trim().strip_suffix(unit)?.trim().parse::<f64>().ok();
        let celsius = ["°C", "degC", "C"].into_iter().find_map(number);
        let kelvin = number("K").or(celsius.map(|t| t + ICE));
        kelvin.filter(|t| t.is_finite() && *t > 0.0).map(Self).ok_or_else(|| {
            R::Error::custom(format!(
                "'{text}' is not accepted: a temperature such as \"140 C\" or \"413 K\" is needed"
            ))
        })
    }
}

//! The keys of `[adhesive]` that give a viscosity by formula.

use serde::Deserialize;
use units::{Consistency, Pressure, ShearRate, Time, Viscosity};

use super::value::Positive;

/// `power_law`
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PowerLaw {
    /// K.
    pub consistency: Positive<Consistency>,
    /// n.
    pub index: f64,
    /// Shear rates between which it holds.
    pub rates: [Positive<ShearRate>; 2],
}

/// `cross`
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cross {
    /// eta_0.
    pub zero_rate: Positive<Viscosity>,
    /// eta_inf.
    pub infinite_rate: Positive<Viscosity>,
    /// Time constant.
    pub time: Positive<Time>,
    /// m.
    pub exponent: f64,
}

/// `carreau_yasuda`
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CarreauYasuda {
    /// eta_0.
    pub zero_rate: Positive<Viscosity>,
    /// eta_inf.
    pub infinite_rate: Positive<Viscosity>,
    /// Time constant.
    pub time: Positive<Time>,
    /// n.
    pub index: f64,
    /// a.
    #[serde(default = "carreau")]
    pub transition: f64,
}

fn carreau() -> f64 {
    2.0
}

/// `herschel_bulkley`
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HerschelBulkley {
    /// tau_y.
    pub yield_stress: Positive<Pressure>,
    /// K.
    pub consistency: Positive<Consistency>,
    /// n.
    pub index: f64,
    /// Shear rate below which it does not hold.
    pub regularisation_rate: Positive<ShearRate>,
}

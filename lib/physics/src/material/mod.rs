//! Constitutive laws of the liquid (paper Eqs. 1 and 2).

mod cure;
mod cure_law;
mod laws;
mod tait;
mod viscosity;
mod water;
mod wetting;

pub use cure::{Cure, SET};
pub use cure_law::{Course, CureLaw};
pub use laws::Law;
pub use tait::{TAIT_C, Tait};
pub use viscosity::{Newtonian, Rheology, ShearRate, Table, Viscosity};
pub use water::{Water, WaterLaw};
pub use wetting::Wetting;

/// The liquid of a scene: a compressible (Tait) generalised Newtonian fluid.
#[derive(Clone, Debug)]
pub struct Liquid {
    /// Mass density at J = 1, kg/m3.
    pub density: f64,
    /// Pressure law, paper Eq. 1.
    pub tait: Tait,
    /// Viscosity law, paper Eq. 2.
    pub viscosity: Viscosity,
    /// Cure: a factor on the viscosity over time; `None`: always one.
    pub cure: Option<Cure>,
    /// Loss of water to the wood, and its effect on the viscosity; `None`: no loss.
    pub water: Option<Water>,
    /// Definition of the rate in eta(rate).
    pub shear_rate: ShearRate,
    /// Largest tension that the liquid carries, Pa (> 0); `None`: as given by Eq. 1.
    pub cavitation_pressure: Option<f64>,
    /// Surface tension and contact angle; `None`: no surface tension.
    pub wetting: Option<Wetting>,
}

impl Liquid {
    /// Speed of sound at rest, sqrt(K / rho), m/s.
    pub fn sound_speed(&self) -> f64 {
        (self.tait.bulk_modulus / self.density).sqrt()
    }
}

/// The neighbours of `x` among points (argument, value) in ascending order.
fn neighbours(points: &[(f64, f64)], x: f64) -> [Option<(f64, f64)>; 2] {
    let right = points.partition_point(|point| point.0 <= x);
    let left = right.checked_sub(1).map(|left| points[left]);
    [left, points.get(right).copied()]
}

#[cfg(test)]
pub(crate) use laws::tests::ALL as TEST_LAWS;
#[cfg(test)]
pub(crate) use viscosity::tests::pva_pf as test_table;

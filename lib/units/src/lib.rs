//! Quantities with units: the only place of the project that converts.
//!
//! On the command line and in case files a quantity is a string with a unit as the
//! literature quotes it (`"1300 cP"`, `"1.2 g/cm3"`); everything behind this crate is SI.
//!
//! ```
//! use units::{Quantity, Viscosity};
//! let eta: Quantity<Viscosity> = "1300 cP".parse().unwrap();
//! assert!((eta.si() - 1.3).abs() < 1e-15);
//! assert!("1300".parse::<Quantity<Viscosity>>().is_err());
//! ```

mod axis;
mod dimension;
mod quantity;

pub use axis::Axis;
pub use dimension::{
    ALL, Acceleration, Angle, Consistency, Density, Diffusivity, Dimension, Length, MolarEnergy,
    Pressure, ShearRate, Speed, Spread, SurfaceTension, Time, Viscosity, unit,
};
pub use quantity::{ParseError, Quantity, positive, si};

/// A number to twelve digits, without those that rounding in a unit left: 0.7 for 700 cP in Pa s, a double of 0.7000000000000001.
#[must_use]
pub fn shortened(number: f64) -> f64 {
    format!("{number:.11e}").parse().unwrap_or(number)
}

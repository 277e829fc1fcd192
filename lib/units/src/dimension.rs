/// A physical dimension: its name for messages and the units accepted for it.
pub trait Dimension {
    /// Name used in error messages, with its article.
    const NAME: &'static str;
    /// Accepted unit symbols and what one of them is in SI; the first is the SI unit.
    const UNITS: &'static [(&'static str, f64)];
}

macro_rules! dimension {
    ($(#[$doc:meta])* $name:ident, $words:literal, $units:expr) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub struct $name;
        impl Dimension for $name {
            const NAME: &'static str = $words;
            const UNITS: &'static [(&'static str, f64)] = $units;
        }
    };
}

dimension!(/// Length, SI metre.
    Length, "a length", &[("m", 1.0), ("mm", 1e-3), ("um", 1e-6), ("µm", 1e-6), ("μm", 1e-6), ("nm", 1e-9)]);
dimension!(/// Time, SI second.
    Time, "a time", &[("s", 1.0), ("ms", 1e-3), ("us", 1e-6), ("µs", 1e-6), ("μs", 1e-6), ("ns", 1e-9), ("min", 60.0)]);
dimension!(/// Speed, SI metre per second.
    Speed, "a speed", &[("m/s", 1.0), ("mm/s", 1e-3), ("um/s", 1e-6), ("mm/min", 1e-3 / 60.0)]);
dimension!(/// Pressure or modulus, SI pascal.
    Pressure, "a pressure", &[("Pa", 1.0), ("kPa", 1e3), ("MPa", 1e6), ("GPa", 1e9), ("bar", 1e5), ("psi", 6_894.757_293_168)]);
dimension!(/// Dynamic viscosity, SI pascal second.
    Viscosity, "a viscosity", &[("Pa s", 1.0), ("Pa.s", 1.0), ("mPa s", 1e-3), ("mPa.s", 1e-3), ("cP", 1e-3), ("P", 0.1)]);
dimension!(/// Mass density, SI kilogram per cubic metre.
    Density, "a density", &[("kg/m3", 1.0), ("g/cm3", 1e3)]);
dimension!(/// Acceleration, SI metre per second squared.
    Acceleration, "an acceleration", &[("m/s2", 1.0)]);
dimension!(/// Shear rate, SI one per second.
    ShearRate, "a shear rate", &[("1/s", 1.0), ("s-1", 1.0)]);

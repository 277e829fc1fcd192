//! Physical dimensions and their units.

/// A physical dimension: its name for messages and the units accepted for it.
pub trait Dimension {
    /// Name used in error messages, with its article.
    const NAME: &'static str;
    /// Accepted unit symbols and what one of them is in SI; the first is the SI unit.
    const UNITS: &'static [(&'static str, f64)];
    /// Least and largest size accepted, SI, zero apart; beyond them is a slip of the pen, and
    /// what is computed from it would overflow.
    const SIZE: [f64; 2];
}

macro_rules! dimensions {
    ($($(#[$doc:meta])* $name:ident, $words:literal, $units:expr, $size:expr;)*) => {
        $($(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub struct $name;
        impl Dimension for $name {
            const NAME: &'static str = $words;
            const UNITS: &'static [(&'static str, f64)] = $units;
            const SIZE: [f64; 2] = $size;
        })*

        /// Every dimension: its name and units, of which the first with a symbol is meant by it.
        pub const ALL: &[(&str, &[(&str, f64)])] = &[$(($name::NAME, $name::UNITS)),*];
    };
}

dimensions! {
    /// Length, SI metre.
    Length, "a length", &[("m", 1.0), ("mm", 1e-3), ("um", 1e-6), ("µm", 1e-6), ("μm", 1e-6), ("nm", 1e-9)], [1e-12, 1e9];
    /// Time, SI second.
    Time, "a time", &[("s", 1.0), ("ms", 1e-3), ("us", 1e-6), ("µs", 1e-6), ("μs", 1e-6), ("ns", 1e-9), ("min", 60.0), ("h", 3600.0)], [1e-18, 1e10];
    /// Speed, SI metre per second.
    Speed, "a speed", &[("m/s", 1.0), ("mm/s", 1e-3), ("um/s", 1e-6), ("nm/s", 1e-9), ("mm/min", 1e-3 / 60.0)], [1e-15, 1e6];
    /// Pressure or modulus, SI pascal.
    Pressure, "a pressure", &[("Pa", 1.0), ("kPa", 1e3), ("MPa", 1e6), ("GPa", 1e9), ("bar", 1e5), ("psi", 6_894.757_293_168)], [1e-9, 1e16];
    /// Dynamic viscosity, SI pascal second.
    Viscosity, "a viscosity", &[("Pa s", 1.0), ("Pa.s", 1.0), ("mPa s", 1e-3), ("mPa.s", 1e-3), ("cP", 1e-3), ("P", 0.1)], [1e-6, 1e12];
    /// Mass density, SI kilogram per cubic metre.
    Density, "a density", &[("kg/m3", 1.0), ("g/cm3", 1e3)], [10.0, 1e5];
    /// Acceleration, SI metre per second squared.
    Acceleration, "an acceleration", &[("m/s2", 1.0)], [1e-15, 1e18];
    /// Shear rate, SI one per second.
    ShearRate, "a shear rate", &[("1/s", 1.0), ("s-1", 1.0)], [1e-12, 1e15];
    /// Consistency of a power law, SI pascal second to the power n.
    Consistency, "a consistency", &[("Pa s^n", 1.0), ("Pa.s^n", 1.0), ("mPa s^n", 1e-3)], [1e-9, 1e15];
    /// Energy of a mole, SI joule per mole.
    MolarEnergy, "an energy of a mole", &[("J/mol", 1.0), ("kJ/mol", 1e3), ("kcal/mol", 4184.0)], [1.0, 1e6];
    /// Mass of adhesive over bond area, SI kilogram per square metre.
    Spread, "a spread rate", &[("kg/m2", 1.0), ("g/m2", 1e-3), ("lb/1000ft2", 4.882_427_636_383_05e-3)], [1e-6, 1e3];
    /// Diffusivity, SI square metre per second.
    Diffusivity, "a diffusivity", &[("m2/s", 1.0), ("mm2/s", 1e-6), ("um2/s", 1e-12)], [1e-20, 1.0];
    /// Surface tension, SI newton per metre.
    SurfaceTension, "a surface tension", &[("N/m", 1.0), ("mN/m", 1e-3), ("dyn/cm", 1e-3)], [1e-9, 1e3];
    /// Plane angle, SI radian.
    Angle, "an angle", &[("rad", 1.0), ("deg", std::f64::consts::PI / 180.0), ("°", std::f64::consts::PI / 180.0)], [1e-30, 1e3];
}

/// What a unit symbol measures, and what one of it is in SI.
pub fn unit(symbol: &str) -> Option<(&'static str, f64)> {
    ALL.iter().find_map(|(name, units)| {
        let (_, factor) = units.iter().find(|(known, _)| *known == symbol)?;
        Some((*name, *factor))
    })
}

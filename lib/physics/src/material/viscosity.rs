//! Viscosity against shear rate: constant, by table or by formula.

use super::Law;
use crate::Choice;

/// Definition of the shear rate in eta(rate) by D' = dev sym grad v.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ShearRate {
    /// The paper's 2 |dev D|, below its Eq. 2.
    #[default]
    Paper,
    /// sqrt(2 D':D'), the shear rate of a rheometer in simple shear.
    Rheometer,
}

impl Choice for ShearRate {
    const NAMED: &'static [(&'static str, Self)] =
        &[("paper", Self::Paper), ("rheometer", Self::Rheometer)];
}

impl ShearRate {
    /// The factor f in rate = f |dev D|.
    #[inline]
    pub fn factor(self) -> f64 {
        match self {
            ShearRate::Paper => 2.0,
            ShearRate::Rheometer => std::f64::consts::SQRT_2,
        }
    }
}

/// A viscosity law. Kernels are generic over it, so that a Newtonian scene never evaluates a table.
pub trait Rheology: Clone + Send + Sync {
    /// Viscosity in Pa s at a shear rate in 1/s.
    fn viscosity(&self, rate: f64) -> f64;
    /// Rates in ascending order, 1/s, between which the law is linear in the logarithm of the rate, and outside of which it is
    /// constant. Empty for a formula, whose stress must not fall with the rate.
    fn breakpoints(&self) -> &[f64];
    /// Largest viscosity the law can give, Pa s.
    fn largest(&self) -> f64;
    /// Whether the viscosity is constant, so that the rate need not be computed.
    const CONSTANT: bool;
}

/// Constant viscosity, Pa s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Newtonian(pub f64);

impl Rheology for Newtonian {
    #[inline]
    fn viscosity(&self, _rate: f64) -> f64 {
        self.0
    }
    fn breakpoints(&self) -> &[f64] {
        &[]
    }
    fn largest(&self) -> f64 {
        self.0
    }
    const CONSTANT: bool = true;
}

/// Viscosity linear in log10(rate) between measured points, constant outside (paper Table 1).
#[derive(Clone, Debug, PartialEq)]
pub struct Table {
    rates: Vec<f64>,
    log_rates: Vec<f64>,
    viscosities: Vec<f64>,
}

impl Table {
    /// A table from (rate in 1/s, viscosity in Pa s) points.
    ///
    /// # Errors
    /// A sentence: fewer than two points, rates not increasing, or values not positive.
    pub fn new(points: &[(f64, f64)]) -> Result<Self, String> {
        if points.len() < 2 {
            return Err("a viscosity table needs at least two points".into());
        }
        let mut before = 0.0;
        for (i, &(rate, viscosity)) in (1..).zip(points) {
            if !(rate > 0.0 && viscosity > 0.0 && rate.is_finite() && viscosity.is_finite()) {
                return Err(format!(
                    "point {i} of the viscosity table is ({rate} 1/s, {viscosity} Pa s): both must be positive"
                ));
            }
            if rate <= before {
                return Err(format!(
                    "the rates of the viscosity table must increase, but point {i} has {rate} 1/s after {before} 1/s"
                ));
            }
            before = rate;
        }
        Ok(Self {
            rates: points.iter().map(|p| p.0).collect(),
            log_rates: points.iter().map(|p| p.0.log10()).collect(),
            viscosities: points.iter().map(|p| p.1).collect(),
        })
    }
}

impl Rheology for Table {
    #[inline]
    fn viscosity(&self, rate: f64) -> f64 {
        let last = self.rates.len() - 1;
        if rate <= self.rates[0] {
            return self.viscosities[0];
        }
        if rate >= self.rates[last] {
            return self.viscosities[last];
        }
        let b = self.rates.partition_point(|&r| r <= rate);
        let a = b - 1;
        let t = (rate.log10() - self.log_rates[a]) / (self.log_rates[b] - self.log_rates[a]);
        self.viscosities[a] + t * (self.viscosities[b] - self.viscosities[a])
    }
    fn breakpoints(&self) -> &[f64] {
        &self.rates
    }
    fn largest(&self) -> f64 {
        self.viscosities.iter().fold(0.0, |a: f64, &b| a.max(b))
    }
    const CONSTANT: bool = false;
}

/// The viscosity law of a scene; matched once per run to choose monomorphic kernels.
#[derive(Clone, Debug, PartialEq)]
pub enum Viscosity {
    /// Constant.
    Newtonian(Newtonian),
    /// By table.
    Table(Table),
    /// By formula.
    Law(Law),
}

impl Viscosity {
    /// Viscosity in Pa s at a shear rate in 1/s.
    pub fn at(&self, rate: f64) -> f64 {
        match self {
            Viscosity::Newtonian(law) => law.viscosity(rate),
            Viscosity::Table(law) => law.viscosity(rate),
            Viscosity::Law(law) => law.viscosity(rate),
        }
    }

    /// Largest viscosity the law can give, Pa s.
    pub fn largest(&self) -> f64 {
        match self {
            Viscosity::Newtonian(law) => law.largest(),
            Viscosity::Table(law) => law.largest(),
            Viscosity::Law(law) => law.largest(),
        }
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// Paper Table 1 in SI.
    pub(crate) fn pva_pf() -> Table {
        let points = [(0.0, 210e3), (0.8, 87e3), (1.6, 1700.0), (2.7, 1000.0)];
        Table::new(&points.map(|(log, cp)| (10_f64.powf(log), cp * 1e-3))).unwrap()
    }

    #[test]
    fn table_1_is_linear_in_the_logarithm() {
        let table = pva_pf();
        assert_eq!(table.viscosity(0.01), 210.0);
        assert_eq!(table.viscosity(1e6), 1.0);
        for (log, exact) in [(0.4, (210.0 + 87.0) / 2.0), (2.15, 1.35)] {
            let middle = table.viscosity(10_f64.powf(log));
            assert!((middle - exact).abs() < 1e-9, "{middle}");
        }
    }

    #[test]
    fn bad_tables_are_refused_in_a_sentence() {
        for points in [
            &[(1.0, 1.0)][..],
            &[(1.0, 1.0), (1.0, 2.0)],
            &[(0.0, 1.0), (1.0, 1.0)],
            &[(1.0, -1.0), (2.0, 1.0)],
        ] {
            assert!(Table::new(points).is_err());
        }
    }

    #[test]
    fn both_conventions_in_simple_shear() {
        // grad v = [[0, g], [0, 0]]: D' : D' = g^2 / 2
        let (g, norm) = (3.0_f64, (9.0_f64 / 2.0).sqrt());
        assert!((ShearRate::Rheometer.factor() * norm - g).abs() < 1e-12);
        assert!((ShearRate::Paper.factor() * norm - std::f64::consts::SQRT_2 * g).abs() < 1e-12);
    }
}

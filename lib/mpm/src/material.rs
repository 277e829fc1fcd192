//! The liquid's viscosity laws, over its density and in the precision of its points.

use physics::{Law, Rheology, Table};

use crate::real::Real;

/// Kinematic viscosity (m2/s) of a shear rate (1/s).
pub(crate) trait Flow: Send + Sync {
    /// Viscosity over density.
    fn viscosity(&self, rate: Real) -> Real;
}

/// Constant kinematic viscosity.
pub(crate) struct Constant(pub(crate) Real);

impl Flow for Constant {
    #[inline(always)]
    fn viscosity(&self, _rate: Real) -> Real {
        self.0
    }
}

/// A viscosity table: value and slope in ln(rate) of every segment.
pub(crate) struct Segments {
    rates: Vec<Real>,
    lines: Vec<(Real, Real)>,
}

impl Segments {
    pub(crate) fn new(table: &Table, density: f64) -> Self {
        let rates = table.breakpoints();
        let value = |rate: f64| table.viscosity(rate) / density;
        let mut lines = vec![(value(rates[0]) as Real, 0.0)];
        for ends in rates.windows(2) {
            let slope = (value(ends[1]) - value(ends[0])) / (ends[1] / ends[0]).ln();
            lines.push((
                (value(ends[0]) - slope * ends[0].ln()) as Real,
                slope as Real,
            ));
        }
        lines.push((value(rates[rates.len() - 1]) as Real, 0.0));
        Self {
            rates: rates.iter().map(|&r| r as Real).collect(),
            lines,
        }
    }
}

impl Flow for Segments {
    #[inline(always)]
    fn viscosity(&self, rate: Real) -> Real {
        let segment = self.rates.iter().take_while(|&&r| rate >= r).count();
        let (value, slope) = self.lines[segment];
        if slope == 0.0 {
            value
        } else {
            value + slope * rate.ln()
        }
    }
}

/// A law by formula, over the density.
pub(crate) struct Formula {
    pub(crate) law: Law,
    pub(crate) density: f64,
}

impl Flow for Formula {
    #[inline(always)]
    fn viscosity(&self, rate: Real) -> Real {
        (self.law.viscosity(rate.into()) / self.density) as Real
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn segments_interpolate_the_viscosity_table() {
        let table = Table::new(&[(1.0, 210.0), (6.3, 87.0), (40.0, 1.7), (501.0, 1.0)]).unwrap();
        let segments = Segments::new(&table, 1200.0);
        for i in -20..80 {
            let rate = 10_f64.powf(f64::from(i) * 0.05);
            let exact = table.viscosity(rate) / 1200.0;
            let relative = f64::from(segments.viscosity(rate as Real)) / exact - 1.0;
            assert!(relative.abs() < 2e-5, "{rate} {relative}");
        }
    }
}

//! Squeeze flow under a constant force: a drop of liquid between a plate at rest and one that a force brings down,
//! against the radii that others measured (lib/studies/reference/squeeze).

use std::f64::consts::PI;

use serde::de::DeserializeOwned;

use crate::Result;
use crate::case_text::{Body, CaseText, Viscosity};
use crate::numbers::crossing;
use crate::outputs::Run;

/// An experiment of the table.
#[derive(Clone, Debug)]
pub(super) struct Experiment {
    pub(super) name: String,
    pub(super) liquid: &'static Liquid,
    /// Force on the upper plate (N), volume (m3) and first radius (m) of the liquid, each with its deviation
    /// among the repeats.
    pub(super) force: [f64; 2],
    pub(super) volume: [f64; 2],
    pub(super) radius: [f64; 2],
    /// Time (s), radius (m) and its deviation among the repeats.
    pub(super) measured: Vec<[f64; 3]>,
}

/// A liquid of the experiments.
#[derive(Debug)]
pub(super) struct Liquid {
    pub(super) name: &'static str,
    /// Viscosity at rest, Pa s; beyond the rate `thins_from` (1/s) it falls by the power law `index`.
    pub(super) viscosity: f64,
    index: f64,
    thins_from: f64,
    /// Relative deviation of the viscosity between runs of the rheometer.
    deviation: f64,
}

/// Glycerol: ten runs of a rheometer, 0.868 Pa s with a deviation of 0.058.
const GLYCEROL: Liquid = Liquid {
    name: "glycerol",
    viscosity: 0.868,
    index: 1.0,
    thins_from: f64::INFINITY,
    deviation: 0.067,
};

/// Polyvinylpyrrolidone in water: the authors' fit to the rheometer. Its deviation between runs is not told; that of
/// the fit, 0.4 % at rest and 4.7 % in the time that thinning begins at, is 1.1 %.
const PVP: Liquid = Liquid {
    name: "PVP",
    viscosity: 32.05,
    index: 0.7714,
    thins_from: 1.0 / 0.711,
    deviation: 0.011,
};

/// Largest rate of the power law, 1/s.
const FASTEST: f64 = 1e5;
/// Density of both liquids, kg/m3.
pub(super) const DENSITY: f64 = 1260.0;
/// Speed of a plate that nothing holds, m/s: more than the force makes of any.
const FREE: f64 = 2.0;

/// The table of experiments.
pub(super) fn experiments() -> Result<Vec<Experiment>> {
    type Case = (String, String, [f64; 2], [f64; 2], [f64; 2], u32);
    let cases: Vec<Case> = rows(include_str!("../../reference/squeeze/cases.csv"))?;
    let radii: Vec<(String, [f64; 3])> = rows(include_str!("../../reference/squeeze/radii.csv"))?;
    let experiment = |(name, liquid, force, volume, radius, _): Case| Experiment {
        liquid: [&GLYCEROL, &PVP][usize::from(liquid != GLYCEROL.name)],
        measured: (radii.iter().filter(|(of, _)| *of == name))
            .map(|(_, measured)| *measured)
            .collect(),
        name,
        force,
        volume,
        radius,
    };
    Ok(cases.into_iter().map(experiment).collect())
}

/// The rows of a table of the references.
pub(super) fn rows<T: DeserializeOwned>(text: &str) -> Result<Vec<T>> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    Ok(reader.deserialize().collect::<Result<_, _>>()?)
}

impl Experiment {
    /// Height of the liquid at the start, m.
    pub(super) fn height(&self) -> f64 {
        self.volume[0] / (PI * self.radius[0].powi(2))
    }

    /// The case: a quarter of the disc between plates, `n` cells high at first.
    pub(super) fn case(&self, n: u32) -> CaseText {
        let cell = self.height() / f64::from(n);
        let m = |cells: f64| cells * cell;
        let (low, high) = (m(2.0), m(f64::from(n) + 2.0));
        let farthest = self.measured.iter().map(|m| m[1]).fold(0.0, f64::max);
        let side = m((1.12 * farthest / cell).ceil() + 3.0);
        let far = [side, high + m(3.0), side];
        let half = 0.5 * cell;
        let mut bodies = vec![
            Body::wall([0.0; 3], [side, low, side]).named("bottom"),
            Body::wall([0.0, high, 0.0], far).clamped().named("top"),
        ];
        // Rows of half cells, those of equal width as one.
        let mut row = 0;
        while let Some(width) = self.width(row, half) {
            let from = row;
            while self.width(row, half) == Some(width) {
                row += 1;
            }
            bodies.push(Body::liquid(
                [0.0, low, f64::from(from) * half],
                [width, high, f64::from(row) * half],
            ));
        }
        let last = self.measured.last().map_or(0.0, |m| m[0]);
        let travel = 1e6 * (1.0 - 0.2 / f64::from(n)) * self.height();
        CaseText {
            density: DENSITY,
            viscosity: self.liquid.law(),
            clamp: Some(format!(
                "travel = \"{travel} um\"\n[[clamp.stage]]\nkind = \"hold\"\nspeed = \"{FREE} m/s\"\n\
                 pressure = \"{} Pa\"\ntravel = \"{travel} um\"\ntime = \"{} s\"",
                0.25 * self.force[0] / side.powi(2),
                1.02 * last,
            )),
            bodies,
            title: format!(
                "{}: {} N on {:.4e} m3 of {}, a quarter of the disc.",
                self.name, self.force[0], self.volume[0], self.liquid.name
            ),
            ..CaseText::new(cell, 3, far)
        }
    }

    /// Width of a row of the quarter disc of squares of an edge, m; none beyond it.
    fn width(&self, row: u32, edge: f64) -> Option<f64> {
        let middle = (f64::from(row) + 0.5) * edge;
        let half = (self.radius[0].powi(2) - middle.powi(2)).max(0.0).sqrt();
        let squares = (half / edge).round();
        (squares > 0.0).then_some(squares * edge)
    }

    /// Radii (m) of a run at the measured times; none where the run ended before.
    pub(super) fn radii(&self, run: &Run) -> Result<Vec<Option<f64>>> {
        let [times, ways] = run.columns(["time_s", "displacement_m"])?;
        let radius = |time: f64| {
            let way = crossing(&times, &ways, time)?;
            Some((self.volume[0] / (PI * (self.height() - way))).sqrt())
        };
        Ok(self.measured.iter().map(|m| radius(m[0])).collect())
    }

    /// Relative deviation of a predicted radius by those of force, volume, first radius and viscosity, where its
    /// logarithm grows by `slope` with that of time. By lubrication R/R0 is a function of
    /// t (F V^(n+1)/(K R0^(3n+5)))^(1/n), n the index of the power law.
    pub(super) fn input_deviation(&self, slope: f64) -> f64 {
        let n = self.liquid.index;
        let s = slope / n;
        let relative = |[mean, deviation]: [f64; 2]| deviation / mean;
        [
            s * relative(self.force),
            s * (n + 1.0) * relative(self.volume),
            (1.0 - s * (3.0 * n + 5.0)) * relative(self.radius),
            s * self.liquid.deviation,
        ]
        .into_iter()
        .fold(0.0, f64::hypot)
    }
}

impl Liquid {
    fn law(&self) -> Viscosity {
        if self.index == 1.0 {
            return Viscosity::Newtonian(self.viscosity);
        }
        let consistency = self.viscosity * self.thins_from.powf(1.0 - self.index);
        Viscosity::Law(format!(
            "power_law.consistency = \"{consistency} Pa s^n\"\npower_law.index = {}\npower_law.rates = [\"{} 1/s\", \"{FASTEST} 1/s\"]",
            self.index, self.thins_from
        ))
    }

    /// Whether its viscosity depends on the rate.
    pub(super) fn thins(&self) -> bool {
        self.index < 1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_has_eight_cases_and_75_radii() {
        let all = experiments().unwrap();
        assert_eq!(all.len(), 8);
        assert_eq!(all.iter().map(|e| e.measured.len()).sum::<usize>(), 75);
        assert_eq!(all.iter().filter(|e| e.liquid.thins()).count(), 4);
    }

    /// Long after the start R^8 goes with F V^2/eta, whatever the first radius was.
    #[test]
    fn input_deviations_are_weighted_by_their_exponents() {
        let by = experiments().unwrap()[0].input_deviation(0.125);
        let parts: [f64; 3] = [0.125 * 0.099 / 2.819, 0.25 * 2.22 / 20.41, 0.125 * 0.067];
        let expected = parts.into_iter().fold(0.0, f64::hypot);
        assert!((by / expected - 1.0).abs() < 1e-9);
    }
}

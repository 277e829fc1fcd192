//! A result of a sweep: its values, error and axis.

use crate::axes::{Axis, extent};
use crate::closing::time_unit;
use crate::column_name::worded;
use crate::known::{HELD, NEAR, SIDES};

/// `out/quick/errors.csv` of `make`.
const ERRORS: &str = include_str!("../../run/src/cell_error.csv");
/// Errors that an axis has room for at least: differences far below one are no fall.
const ROOM: f64 = 8.0;
/// Share of the largest pressure, or of an atmosphere (Pa), below which one is what the solver leaves of zero.
const NOTHING: f64 = 1e-9;
const ATMOSPHERE: f64 = 101_325.0;
/// Parameters whose largest value is more than so many times the smallest get a logarithmic axis.
const LOGARITHMIC: f64 = 20.0;

/// A result of a sweep.
#[derive(Clone, Debug)]
pub(crate) struct Outcome {
    /// Of its axis.
    pub(crate) title: String,
    /// In the unit of the title; NaN where a run has none.
    pub(crate) values: Vec<f64>,
    /// Relative error of each by the size of the cells; zero where none is known.
    pub(crate) errors: Vec<f64>,
}

impl Outcome {
    pub(crate) fn new(name: &str, mut values: Vec<f64>, error: Option<f64>) -> Self {
        if name == "pressure_pa" {
            let largest = values.iter().fold(ATMOSPHERE, |most, p| most.max(p.abs()));
            (values.iter_mut().filter(|p| p.abs() < NOTHING * largest)).for_each(|p| *p = 0.0);
        }
        let (unit, title) = match name {
            "pressure_pa" => (1e6, "pressure (MPa)".to_owned()),
            "time_s" => {
                let (unit, name) = time_unit(extent(values.iter().copied()).1);
                (unit, format!("time ({name})"))
            }
            other => (1.0, worded(other)),
        };
        Self {
            title,
            errors: vec![error.unwrap_or_else(|| known(name)); values.len()],
            values: values.into_iter().map(|value| value / unit).collect(),
        }
    }

    /// The same without errors of pressures that the clamp holds at its limit: of each row in Pa or, of NaN, the largest of all
    /// that two rows have.
    pub(crate) fn held(mut self, limits: &[f64]) -> Self {
        let largest = self.values.iter().copied().fold(0.0, f64::max);
        let near = |p: f64, limit: f64, by: f64| limit > 0.0 && (p - limit).abs() <= by * limit;
        let reached = self.values.iter().filter(|p| near(**p, largest, HELD));
        let plateau = if reached.count() > 1 {
            largest
        } else {
            f64::NAN
        };
        for ((p, error), limit) in self.values.iter().zip(&mut self.errors).zip(limits) {
            if near(*p, 1e-6 * limit, NEAR) || limit.is_nan() && near(*p, plateau, HELD) {
                *error = 0.0;
            }
        }
        self
    }

    /// An axis over the values and their errors, no finer than these.
    pub(crate) fn axis(&self) -> Axis {
        let ends = |(v, error): (&f64, &f64)| [1.0 - error, 1.0 + error].map(|part| v * part);
        let ends = self.values.iter().zip(&self.errors).flat_map(ends);
        let (low, high) = extent(ends.clone());
        let error = self.errors.iter().copied().fold(0.0, f64::max);
        let room = ROOM * error * low.abs().max(high.abs());
        let pad = (0.5 * (room - (high - low))).max(0.0);
        // Room below zero is none for what is never there.
        let least = if low < 0.0 {
            low - pad
        } else {
            (low - pad).max(0.0)
        };
        axis(&self.title, ends.chain([least, high + pad]))
    }
}

/// Relative error of a result by the size of the cells, in the cells of the cases: the worst of the quick specimens, as run
/// against extrapolated; zero where none is known.
fn known(name: &str) -> f64 {
    let mut words = name.split('_');
    let quantity = words.next();
    let side = words.next().filter(|word| SIDES.contains(word));
    let own = [quantity, side.or(Some(SIDES[2]))];
    let errors = ERRORS.lines().filter_map(|line| {
        let [_, _, quantity, side, _, as_run, best, ..] = line.split(',').collect::<Vec<_>>()[..]
        else {
            return None;
        };
        let [as_run, best] = [as_run, best].map(|cell| cell.parse::<f64>().unwrap_or(f64::NAN));
        (own == [Some(quantity), Some(side)]).then_some((as_run / best - 1.0).abs())
    });
    errors.fold(0.0, f64::max)
}

/// A logarithmic axis where values are far apart.
pub(crate) fn axis(name: &str, values: impl Iterator<Item = f64> + Clone) -> Axis {
    let finite = values.filter(|v| v.is_finite());
    let [low, high] = [f64::min, f64::max].map(|pick| finite.clone().fold(f64::NAN, pick));
    match low > 0.0 && high > LOGARITHMIC * low {
        true => Axis::logarithmic(name, finite),
        false => Axis::linear(name, finite),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Presses that had let go once had an axis of pressure with ticks of 0.000000000 alone.
    #[test]
    fn what_is_left_of_no_pressure_is_none() {
        for (pressures, shown) in [([-3e-13, 2e-13], [0.0; 2]), ([1e-4, 2.5e6], [0.0, 2.5])] {
            let outcome = Outcome::new("pressure_pa", pressures.to_vec(), None);
            assert_eq!(outcome.values, shown);
            let ticks = outcome.axis().ticks(300.0, true);
            assert!(ticks.iter().any(|(_, text)| text.contains(['1', '2', '5'])));
        }
    }

    /// A pressure at the limit of the clamp once had a bar of 40 %.
    #[test]
    fn a_pressure_that_is_held_has_no_error() {
        let errors = |pressures: &[f64], limits: &[f64]| {
            Outcome::new("pressure_pa", pressures.to_vec(), Some(0.4))
                .held(limits)
                .errors
        };
        let unknown = [f64::NAN; 3];
        assert_eq!(errors(&[2.5e6, 1.9e6, 2.5001e6], &unknown), [0.0, 0.4, 0.0]);
        assert_eq!(errors(&[2.5e6, 1.9e6, 1.8e6], &unknown), [0.4; 3]);
        assert_eq!(errors(&[0.0; 3], &unknown), [0.4; 3]);
        assert_eq!(
            errors(&[0.8e6, 1.0e6, 2e6], &[1e6, 1e6, 2e6]),
            [0.4, 0.0, 0.0]
        );
    }

    /// 7.49 and 7.40 um, known to 0.17, were once the whole of an axis.
    #[test]
    fn an_axis_is_not_finer_than_the_errors_of_its_values() {
        let outcome = |error| Outcome::new("wp_um", vec![7.49, 7.4, f64::NAN], Some(error));
        let fall = |error| {
            let axis = outcome(error).axis();
            axis.share(7.49) - axis.share(7.4)
        };
        assert!(fall(0.0) > 0.5 && fall(0.023) < 0.09, "{}", fall(0.023));
        let axis = outcome(0.023).axis();
        assert!(axis.share(7.4 * 0.977) > 0.2 && axis.share(7.49 * 1.023) < 0.8);
        let pressure = Outcome::new("pressure_pa", vec![5e5, 1e6], Some(0.4)).axis();
        assert_eq!(pressure.share(0.0), 0.0);
        assert!(pressure.share(0.3) > 0.05);
        // As run against extrapolated: 6.9406 of 7.1275, 6.4735 of 6.2670 um and 0.1972 of 0.3297 MPa.
        for (name, error) in [
            ("wp_um", 0.0262),
            ("wp_bottom_um", 0.0330),
            ("pressure_pa", 0.4019),
            ("steps", 0.0),
        ] {
            assert!((known(name) - error).abs() < 1e-4, "{name}");
        }
    }
}

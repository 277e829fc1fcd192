//! The squeeze flows run blind, and how far the radii are off those measured.

use super::squeeze::{Experiment, experiments};
use crate::Result;
use crate::method::Method;
use crate::study::{Study, side_by_side};

/// Cells of the height of the liquid at the start: as predicted, and for the error by the size of the cells.
pub(super) const CELLS: [u32; 2] = [4, 6];

/// An experiment as the implicit scheme predicts it.
pub(super) struct Prediction {
    pub(super) experiment: Experiment,
    /// Cells of the height at the start.
    pub(super) cells: u32,
    /// The measured radii and their predictions.
    pub(super) points: Vec<Point>,
    pub(super) cpu_s: f64,
}

/// A measured radius and its prediction.
#[derive(Clone, Copy)]
pub(super) struct Point {
    /// Time, s.
    pub(super) time: f64,
    /// Radius and its deviation among the repeats, m.
    pub(super) measured: [f64; 2],
    /// Predicted radius, m.
    pub(super) predicted: f64,
    /// Its relative deviation by those of the inputs.
    pub(super) by_inputs: f64,
}

impl Point {
    /// Relative error of the prediction.
    pub(super) fn error(&self) -> f64 {
        self.predicted / self.measured[0] - 1.0
    }

    /// The error over the deviation of repeats and inputs.
    pub(super) fn deviations(&self) -> f64 {
        let repeats = self.measured[1] / self.measured[0];
        self.error().abs() / repeats.hypot(self.by_inputs)
    }
}

/// Runs the experiments that the study wants.
pub(super) fn run(study: &Study) -> Result<Vec<Prediction>> {
    let mut wanted = Vec::new();
    for experiment in experiments()? {
        if study.wants(&experiment.name) {
            wanted.extend(CELLS.map(|cells| (experiment.clone(), cells)));
        }
    }
    side_by_side(&wanted, |(experiment, cells)| {
        predicted(study, experiment, *cells)
    })
}

fn predicted(study: &Study, experiment: &Experiment, cells: u32) -> Result<Prediction> {
    let name = format!("{}-{cells}", experiment.name);
    let run = super::run_case(study, &name, &experiment.case(cells), &Method::implicit())?;
    Ok(Prediction {
        points: points(experiment, &experiment.radii(&run)?),
        experiment: experiment.clone(),
        cells,
        cpu_s: run.cpu_s(),
    })
}

/// The points of predicted radii (m) at the measured times, as far as there are any.
fn points(experiment: &Experiment, radii: &[Option<f64>]) -> Vec<Point> {
    let rows = experiment.measured.iter().zip(radii);
    let found: Vec<_> = rows.filter_map(|(m, r)| Some((m, (*r)?))).collect();
    let point = |(i, &(&[time, radius, deviation], predicted)): (usize, &(&[f64; 3], f64))| {
        let (a, b) = (i.saturating_sub(1), (i + 1).min(found.len() - 1));
        let slope = (found[b].1 / found[a].1).ln() / (found[b].0[0] / found[a].0[0]).ln();
        Point {
            time,
            measured: [radius, deviation],
            predicted,
            by_inputs: experiment.input_deviation(slope),
        }
    };
    found.iter().enumerate().map(point).collect()
}

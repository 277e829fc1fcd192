//! The squeeze flows run blind, and how far the radii are off those measured.

use super::squeeze::{Experiment, experiments};
use crate::job::write_text;
use crate::method::{Method, Scheme};
use crate::study::{Study, side_by_side};

/// Cells of the height of the liquid at the start: as predicted, and for the error by the size of the cells.
pub const CELLS: [u32; 2] = [4, 6];

/// An experiment as the implicit scheme predicts it.
pub struct Prediction {
    /// The experiment.
    pub experiment: Experiment,
    /// Cells of the height at the start.
    pub cells: u32,
    /// The measured radii and their predictions.
    pub points: Vec<Point>,
    /// Processor seconds.
    pub cpu_s: f64,
}

/// A measured radius and its prediction.
#[derive(Clone, Copy)]
pub struct Point {
    /// Time, s.
    pub time: f64,
    /// Radius and its deviation among the repeats, m.
    pub measured: [f64; 2],
    /// Predicted radius, m.
    pub predicted: f64,
    /// Its relative deviation by those of the inputs.
    pub by_inputs: f64,
}

impl Point {
    /// Relative error of the prediction.
    pub fn error(&self) -> f64 {
        self.predicted / self.measured[0] - 1.0
    }

    /// The error over the deviation of repeats and inputs.
    pub fn deviations(&self) -> f64 {
        let repeats = self.measured[1] / self.measured[0];
        self.error().abs() / repeats.hypot(self.by_inputs)
    }
}

/// Runs the experiments that the study wants.
///
/// # Errors
/// What a run or the system said.
pub fn run(study: &Study) -> Result<Vec<Prediction>, String> {
    let mut wanted = Vec::new();
    for experiment in experiments()? {
        if study.wants(&experiment.name) {
            wanted.extend(CELLS.map(|cells| (experiment.clone(), cells)));
        }
    }
    let done = side_by_side(&wanted, |(experiment, cells)| {
        predicted(study, experiment, *cells)
    });
    done.into_iter().collect()
}

fn predicted(study: &Study, experiment: &Experiment, cells: u32) -> Result<Prediction, String> {
    let name = format!("{}-{cells}", experiment.name);
    let case = study.folder().join(format!("{name}.toml"));
    write_text(
        &case,
        &experiment.case(cells).text(Scheme::Implicit.integrator()),
    )?;
    let run = Method::implicit().run(&case, &study.folder().join(&name), &[])?;
    let cpu_s = run.summary("cpu_s").unwrap_or(f64::NAN);
    println!("{name:<32} {cpu_s:6.1} s");
    Ok(Prediction {
        points: points(experiment, &experiment.radii(&run)?),
        experiment: experiment.clone(),
        cells,
        cpu_s,
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

//! Squeeze flows in the page: text, table and figures.

use figures::{Mark, Plot};

use super::met;
use super::predictions::{CELLS, Point, Prediction};
use super::squeeze::DENSITY;
use crate::Result;
use crate::numbers::{largest, range, rms};
use crate::study::{PAGE, Study, distinct, filled, table};

/// From this time on (s) points of thinning liquid are to be within [`NEAR`].
const FROM: f64 = 0.1;
const NEAR: f64 = 0.05;
/// Goal for the rms of the error of the radii.
const RMS: f64 = 0.025;
/// Deviations of repeats and inputs that a point may be off.
const DEVIATIONS: f64 = 2.0;
/// The case whose volume is in doubt.
const DOUBTED: &str = "GlyV2F025";

/// Which points count.
type Wanted = fn(&Prediction, &Point) -> bool;

impl Prediction {
    fn is_trusted(&self) -> bool {
        self.experiment.name != DOUBTED
    }
}

/// Errors of some of the points.
struct Errors(Vec<f64>);

impl Errors {
    fn of(predictions: &[&Prediction], wanted: Wanted) -> Self {
        let points = (predictions.iter()).flat_map(|p| p.points.iter().map(move |q| (p, q)));
        let points = points.filter(|(p, q)| wanted(p, q));
        Self(points.map(|(_, q)| q.error()).collect())
    }

    fn rms(&self) -> f64 {
        rms(self.0.iter().copied())
    }

    /// Their number, rms and range.
    fn text(&self) -> String {
        let [low, high] = range(self.0.iter().copied()).map(|e| 100.0 * e);
        let (count, rms) = (self.0.len(), 100.0 * self.rms());
        format!("{count} | {rms:.2} % | {low:+.1} to {high:+.1} %")
    }
}

/// Predictions with a number of cells over the first height.
fn of(all: &[Prediction], cells: u32) -> Vec<&Prediction> {
    all.iter().filter(|p| p.cells == cells).collect()
}

/// Whether the predictions in the larger cells meet the goals.
pub(super) fn sound(all: &[Prediction]) -> bool {
    let first = of(all, CELLS[0]);
    let thinning = Errors::of(&first, |p, q| p.experiment.liquid.thins() && q.time > FROM);
    let trusted = first.iter().filter(|p| p.is_trusted());
    let mut deviations = trusted.flat_map(|p| &p.points).map(Point::deviations);
    thinning.0.iter().all(|e| e.abs() <= NEAR) && deviations.all(|d| d <= DEVIATIONS)
}

/// Writes the table and the figures, and gives the section of the page.
pub(super) fn write(study: &Study, all: &[Prediction]) -> Result<String> {
    let row = |p: &Prediction, q: &Point| {
        let mut row = vec![p.experiment.name.clone(), p.cells.to_string()];
        row.extend([q.time, q.measured[0], q.measured[1], q.predicted].map(|x| format!("{x:.5e}")));
        row.extend([q.error(), q.by_inputs, q.deviations()].map(|x| format!("{x:.4}")));
        row
    };
    study.write_csv(
        "experiments-squeeze.csv",
        "case,cells,time_s,measured_m,deviation_m,predicted_m,error,deviation_by_inputs,deviations",
        all.iter()
            .flat_map(|p| p.points.iter().map(move |q| row(p, q))),
    )?;
    let first = of(all, CELLS[0]);
    for liquid in distinct(first.iter().map(|p| p.experiment.liquid.name)) {
        let file = format!("experiments-squeeze-{}.png", liquid.to_lowercase());
        study.draw(&file, plot(&first, liquid).draw(PAGE))?;
    }
    Ok(section(all))
}

/// Measured radii with bars and their predictions with bands.
fn plot(first: &[&Prediction], liquid: &str) -> Plot {
    let title = format!(
        "Squeeze flow of {liquid}: ten repeats (bars: standard deviation), prediction (bands: uncertainty of the inputs)"
    );
    let mut plot = Plot::new(&title, "time (s)", "radius (mm)").logarithmic([true, false]);
    for p in first.iter().filter(|p| p.experiment.liquid.name == liquid) {
        let label = format!("{}, {:.1} N", p.experiment.name, p.experiment.force[0]);
        let predicted: Vec<_> = (p.points.iter())
            .map(|q| [q.time, 1e3 * q.predicted, 1e3 * q.predicted * q.by_inputs])
            .collect();
        let measured: Vec<_> = (p.points.iter())
            .map(|q| [q.time, 1e3 * q.measured[0], 1e3 * q.measured[1]])
            .collect();
        plot = plot
            .with_deviations(&label, Mark::Line, &predicted)
            .with_deviations(&label, Mark::Dots, &measured);
    }
    plot
}

fn section(all: &[Prediction]) -> String {
    let some: [(&str, Wanted); 4] = [
        ("all", |_, _| true),
        ("from 0.1 s", |_, q| q.time > FROM),
        ("all but GlyV2F025", |p, _| p.is_trusted()),
        ("thinning, from 0.1 s", |p, q| {
            p.experiment.liquid.thins() && q.time > FROM
        }),
    ];
    let lines = CELLS.into_iter().flat_map(|cells| {
        let own = of(all, cells);
        some.map(|(what, wanted)| {
            let text = Errors::of(&own, wanted).text();
            format!("| {cells} | {what} | {text} |")
        })
    });
    let groups = "| cells over the initial height | points | radii | rms | range |";
    let first = of(all, CELLS[0]);
    let line = |p: &&Prediction| {
        let text = Errors::of(&[p], |_, _| true).text();
        let most = largest(p.points.iter().map(Point::deviations));
        format!("| {} | {text} | {most:.1} |", p.experiment.name)
    };
    let cases = "| case | radii | rms | range | deviations |";
    let small = |wanted| met(Errors::of(&first, wanted).rms() <= RMS);
    let height = |trusted: bool| {
        let own = first.iter().filter(|p| p.is_trusted() == trusted);
        range(own.map(|p| 1e3 * p.experiment.height()))
    };
    let ([_, doubted], [low, high]) = (height(false), height(true));
    let values = [
        ("groups", &*table(groups, lines)),
        ("cells", &CELLS[0].to_string()),
        ("cases", &table(cases, first.iter().map(line))),
        ("rms", &format!("{:.1}", 100.0 * RMS)),
        ("all", small(|_, _| true)),
        ("trusted", small(|p, _| p.is_trusted())),
        ("case", DOUBTED),
        ("sound", met(sound(all))),
        ("doubted", &format!("{doubted:.2}")),
        ("heights", &format!("{low:.2} to {high:.2}")),
        ("steps", &steps(&first)),
    ];
    filled(include_str!("squeeze.txt"), &values)
}

/// Fewest and most steps that the explicit scheme would take.
fn steps(first: &[&Prediction]) -> String {
    let steps = |p: &&Prediction| {
        let cell = p.experiment.height() / f64::from(CELLS[0]);
        // The viscous limit of its step; that of sound at 1 GPa is below it but for the solution.
        let viscous = DENSITY * cell.powi(2) / (8.0 * p.experiment.liquid.viscosity);
        p.points.last().map_or(0.0, |q| q.time / viscous)
    };
    let [fewest, most] = range(first.iter().map(steps));
    format!("{fewest:.0e} to {most:.0e}")
}

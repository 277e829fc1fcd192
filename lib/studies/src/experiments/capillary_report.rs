//! Capillary rise in the page: text, table and figure.

use figures::{Mark, Plot};

use super::capillary::{Rise, SLOWING};
use super::met;
use crate::study::{PAGE, Study, distinct, filled, table};
use crate::{Result, numbers};

/// Goal for a run against the equation of motion of the same tube.
const NEAR: f64 = 0.03;
/// Goal for a run against the law as it was fitted to both heights and angles.
const NEAR_FITS: f64 = 0.05;
/// Part of Jurin's height from which on heights count: a cell and more.
const FROM: f64 = 0.06;

/// Errors of the heights of a run, least and most, against `exact` at their times.
fn range(rise: &Rise, exact: impl Fn(f64) -> f64) -> [f64; 2] {
    let risen = |at: &&[f64; 2]| at[1] > FROM * rise.tube.jurin();
    numbers::range((rise.heights.iter().filter(risen)).map(|&[time, h]| h / exact(time) - 1.0))
}

/// Against the law with the k of a tube's own fit.
fn against_fit(rise: &Rise, which: usize) -> [f64; 2] {
    let [k, _] = rise.tube.fits[which];
    range(rise, |time| rise.tube.height(k, time))
}

/// Whether the runs with a dynamic angle meet the goals.
pub(super) fn sound(all: &[Rise]) -> bool {
    let within = |of: [f64; 2], near: f64| of.iter().all(|e| e.abs() <= near);
    all.iter().filter(|rise| rise.slowing > 0.0).all(|rise| {
        within(range(rise, |time| rise.law(time)), NEAR) && within(against_fit(rise, 2), NEAR_FITS)
    })
}

/// Writes the figure and gives the section of the page.
pub(super) fn write(study: &Study, all: &[Rise]) -> Result<String> {
    let file = "experiments-capillary.png";
    study.draw(file, plot(all).draw(PAGE))?;
    Ok(section(all))
}

/// Heights over time: fits with the range of their k, runs, and the law with a constant angle.
fn plot(all: &[Rise]) -> Plot {
    let mut plot = Plot::new(
        "Rise of glycerol: fits to published measurements (bars: range of k), mpm-run with one k, law with a constant angle",
        "time (s)",
        "height (mm)",
    )
    .logarithmic([true, true]);
    let first = |rise: &&Rise| rise.cells == 4 && rise.slowing > 0.0;
    for rise in all.iter().filter(first) {
        let mm = 1e3 * rise.tube.radius;
        let line: Vec<[f64; 2]> = (rise.heights.iter())
            .filter(|at| at[1] > FROM * rise.tube.jurin())
            .map(|&[time, h]| [time, 1e3 * h])
            .collect();
        let times = (0..14).map(|part| rise.tube.end() * 0.7_f64.powi(13 - part));
        let (mut dots, mut constant) = (Vec::new(), Vec::new());
        for time in times {
            let heights = rise.tube.fits.map(|[k, _]| 1e3 * rise.tube.height(k, time));
            let [low, high] = numbers::range(heights.into_iter());
            dots.push([time, 0.5 * (low + high), 0.5 * (high - low)]);
            constant.push([time, 1e3 * rise.tube.height(0.0, time)]);
        }
        let label = format!("radius {mm} mm");
        plot = plot
            .with(&label, Mark::Line, line)
            .with_deviations(&label, Mark::Dots, &dots)
            .with("constant angle", Mark::Line, constant);
    }
    plot
}

fn section(all: &[Rise]) -> String {
    let percent = |[low, high]: [f64; 2]| format!("{:+.1} to {:+.1} %", 100.0 * low, 100.0 * high);
    let line = |rise: &Rise| {
        let fits = [2, 0, 1].map(|which| percent(against_fit(rise, which)));
        format!(
            "| {} | {} | {} | {} | {} | {:.0} |",
            1e3 * rise.tube.radius,
            rise.cells,
            rise.slowing,
            percent(range(rise, |time| rise.law(time))),
            fits.join(" | "),
            rise.cpu_s
        )
    };
    let heads = "| radius (mm) | cells across | k | against the same tube | against the fit to both | to heights | to angles | CPU s |";
    let tubes = distinct(all.iter().map(|rise| rise.tube)).into_iter();
    let fits = tubes.map(|tube| {
        let fits = tube.fits.map(|[k, d]| format!("{k:.0} +- {d:.0}"));
        format!(" {} mm {};", 1e3 * tube.radius, fits.join(", "))
    });
    let values = [
        ("k", &*SLOWING.to_string()),
        ("table", &table(heads, all.iter().map(line))),
        ("fits", &fits.collect::<String>()),
        ("met", met(sound(all))),
    ];
    filled(include_str!("capillary.txt"), &values)
}

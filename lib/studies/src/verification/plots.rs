//! Figures of the verification page.

use figures::{Clouds, Drawing, Mark, Plot};

use super::{LUMEN, incline, slit};
use crate::Result;
use crate::job::Outcome;
use crate::outputs::Run;
use crate::study::{PAGE, Study};

/// Writes the figures whose runs are among `outcomes`.
pub(super) fn write(study: &Study, outcomes: &[Outcome]) -> Result<()> {
    let done = |scene: &str, label: &str| {
        let of = |o: &&Outcome| o.scene == scene && o.method.label == label && o.measured.is_ok();
        outcomes.iter().find(of).map(|o| &o.run)
    };
    let save = |name: &str, drawing| study.draw(&format!("verification-{name}.png"), drawing);
    let main = ["FLIP", "XPIC(5)", "implicit"];
    let runs = main.map(|label| done("incline-n6-off0", label));
    if let [Some(flip), Some(xpic), Some(implicit)] = runs {
        let profile = |run| incline::profile(run, 6, 0.0);
        let spots = [profile(flip)?, profile(xpic)?, profile(implicit)?];
        save("incline", profiles(&main, &spots))?;
        save("incline-points", points(&main, &spots))?;
    }
    if let Some(plot) = channel(outcomes) {
        save("channel", plot.draw(PAGE))?;
    }
    let slits: Vec<(&str, &Run)> = ["FLIP", "XPIC(5)", "APIC", "implicit"]
        .into_iter()
        .filter_map(|label| Some((label, done("slit-n6-off0-0", label)?)))
        .collect();
    if !slits.is_empty() {
        save("slit", slit_forces(&slits)?.draw(PAGE))?;
    }
    Ok(())
}

type Spots = Vec<([f64; 2], f64)>;

/// Velocity over height of films whose floor lies on the nodes, with Eq. 5.
fn profiles(labels: &[&str], runs: &[Spots]) -> Result<Drawing, figures::Error> {
    let mut plot = Plot::new(
        "Film at 0.5 ms, floor on the nodes",
        "height / thickness",
        "velocity / largest velocity by Eq. 5",
    );
    for (label, spots) in labels.iter().zip(runs) {
        let places = spots.iter().map(|(at, v)| [at[1], *v]).collect();
        plot = plot.with(label, Mark::Dots, places);
    }
    let exact = (0..=100).map(|i| f64::from(i) / 100.0);
    let exact = exact.map(|y| [y, incline::velocity(y * LUMEN) / incline::fastest()]);
    let plot = plot.with("Eq. 5", Mark::Line, exact.collect());
    plot.draw(PAGE)
}

fn points(labels: &[&str], runs: &[Spots]) -> Result<Drawing, figures::Error> {
    let mut clouds = Clouds::new(
        ["distance along the floor / thickness", "height / thickness"],
        "velocity / largest velocity by Eq. 5",
        [0.0, 1.0],
        0.03,
    );
    for (label, spots) in labels.iter().zip(runs) {
        clouds = clouds.with(label, spots.clone());
    }
    clouds.draw(PAGE)
}

/// Error of the channel's mean velocity over the offset of its walls, six cells.
fn channel(outcomes: &[Outcome]) -> Option<Plot> {
    let mut plot = Plot::new(
        "Channel of 6 cells: error of the mean velocity",
        "offset of the walls from the nodes (cells)",
        "error (%)",
    );
    let mut labels = Vec::new();
    for label in ["FLIP", "XPIC(5)", "APIC", "PIC", "implicit"] {
        let errors: Vec<[f64; 2]> = (outcomes.iter())
            .filter(|o| o.method.label == label)
            .filter_map(|o| {
                let offset = o.scene.strip_prefix("channel-n6-off")?.parse().ok()?;
                Some([offset, 100.0 * o.measured("mean velocity")?.error])
            })
            .collect();
        if !errors.is_empty() {
            plot = plot.with(label, Mark::LineAndDots, errors);
            labels.push(label);
        }
    }
    (!labels.is_empty()).then_some(plot)
}

fn slit_forces(runs: &[(&str, &Run)]) -> Result<Plot> {
    let mut plot = Plot::new(
        "A piston presses liquid into a slit of 6 cells, walls on the nodes",
        "filled length / slit width",
        "piston force / force at one filled width",
    );
    for (label, run) in runs {
        let mut rows = slit::curve(run, 6)?;
        // The first row is the blow of the start.
        rows.retain(|p| p[0] > 0.2);
        plot = plot.with(label, Mark::Line, rows);
    }
    Ok(plot.with("finite elements", Mark::Dots, slit::reference(6).into()))
}

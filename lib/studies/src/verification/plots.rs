//! Figures of the verification page.

use figures::{Clouds, Drawing, Mark, Plot};

use super::{LUMEN, incline, slit};
use crate::job::Outcome;
use crate::outputs::Run;
use crate::study::{PAGE, Study};

/// Writes the figures whose runs are among `outcomes`.
///
/// # Errors
/// What a figure lacks, or the system's reason.
pub fn write(study: &Study, outcomes: &[Outcome]) -> Result<(), String> {
    let done = |scene: &str, label: &str| {
        let found = outcomes
            .iter()
            .find(|o| o.scene == scene && o.method.label == label);
        found.filter(|o| o.measured.is_ok()).map(|o| Run {
            folder: o.folder.clone(),
        })
    };
    let save = |name: &str, drawing: Result<Drawing, figures::Error>| {
        let bytes = drawing.and_then(|d| d.to_png());
        study.write(
            &format!("verification-{name}.png"),
            bytes.map_err(|e| format!("{name}: {e}"))?,
        )
    };
    let aligned = "incline-n6-off0";
    let main = ["FLIP", "XPIC(5)", "implicit"];
    let runs = main.map(|label| done(aligned, label));
    if let [Some(flip), Some(xpic), Some(implicit)] = &runs {
        let runs = [flip, xpic, implicit];
        save("incline", profiles(&main, &runs))?;
        save("incline-points", points(&main, &runs))?;
    }
    let channel = channel(outcomes);
    if let Some(plot) = channel {
        save("channel", plot.draw(PAGE))?;
    }
    let slits: Vec<(&str, Run)> = ["FLIP", "XPIC(5)", "APIC", "implicit"]
        .into_iter()
        .filter_map(|label| Some((label, done("slit-n6-off0-0", label)?)))
        .collect();
    if !slits.is_empty() {
        save("slit", slit_forces(&slits)?.draw(PAGE))?;
    }
    Ok(())
}

/// Velocity over height of films whose floor lies on the nodes, with Eq. 5.
fn profiles(labels: &[&str], runs: &[&Run]) -> Result<Drawing, figures::Error> {
    let mut plot = Plot::new(
        "Film at 0.5 ms, floor on the nodes",
        "height / thickness",
        "velocity / largest by Eq. 5",
    );
    for (label, run) in labels.iter().zip(runs) {
        let spots = incline::profile(run, 6, 0.0).map_err(figures::Error::Data)?;
        let places = spots.iter().map(|(at, v)| [at[1], *v]).collect();
        plot = plot.with(label, Mark::Dots, places);
    }
    let exact = (0..=100)
        .map(|i| {
            let y = f64::from(i) / 100.0;
            [y, incline::velocity(y * LUMEN) / incline::fastest()]
        })
        .collect();
    plot.with("Eq. 5", Mark::Line, exact).draw(PAGE)
}

fn points(labels: &[&str], runs: &[&Run]) -> Result<Drawing, figures::Error> {
    let mut clouds = Clouds::new(
        ["place along the floor / thickness", "height / thickness"],
        "velocity / largest by Eq. 5",
        [0.0, 1.0],
        0.03,
    );
    for (label, run) in labels.iter().zip(runs) {
        let spots = incline::profile(run, 6, 0.0).map_err(figures::Error::Data)?;
        clouds = clouds.with(label, spots);
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
    let mut any = false;
    for label in ["FLIP", "XPIC(5)", "APIC", "PIC", "implicit"] {
        let errors: Vec<[f64; 2]> = outcomes
            .iter()
            .filter(|o| o.method.label == label)
            .filter_map(|o| {
                let offset = o.scene.strip_prefix("channel-n6-off")?.parse().ok()?;
                Some([offset, 100.0 * o.measured("mean velocity")?.error])
            })
            .collect();
        if !errors.is_empty() {
            plot = plot.with(label, Mark::LineAndDots, errors);
            any = true;
        }
    }
    any.then_some(plot)
}

fn slit_forces(runs: &[(&str, Run)]) -> Result<Plot, String> {
    let mut plot = Plot::new(
        "A piston presses liquid into a slit of 6 cells, walls on the nodes",
        "filled length over slit width",
        "piston force over that of one filled width",
    );
    for (label, run) in runs {
        let rows = slit::curve(run, 6)?;
        // The first row is the blow of the start.
        plot = plot.with(
            label,
            Mark::Line,
            rows.into_iter().filter(|p| p[0] > 0.2).collect(),
        );
    }
    Ok(plot.with("finite elements", Mark::Dots, slit::reference(6)))
}

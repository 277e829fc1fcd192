//! Figures of the verification page.

use std::path::Path;

use figures::{Clouds, Drawing, Mark, Plot};

use super::{LUMEN, incline, slit};
use crate::outputs::Run;
use crate::study::Outcome;

/// Writes the figures whose runs are among `outcomes`.
///
/// # Errors
/// What a figure lacks, or the system's reason.
pub fn write(results: &Path, outcomes: &[Outcome]) -> Result<(), String> {
    let done = |scene: &str, label: &str| {
        let found = outcomes
            .iter()
            .find(|o| o.scene == scene && o.method.label == label);
        found.filter(|o| o.measured.is_ok()).map(|o| Run {
            folder: o.folder.clone(),
        })
    };
    let save = |name: &str, drawing: Result<Drawing, figures::Error>| {
        let path = results.join(format!("verification-{name}.png"));
        let bytes = drawing
            .and_then(|d| d.to_png())
            .map_err(|e| format!("{name}: {e}"))?;
        std::fs::write(&path, bytes).map_err(|e| format!("{}: {e}", path.display()))
    };
    let aligned = "incline-n6-off0";
    let main = ["FLIP", "XPIC(5)", "implicit"];
    let runs = main.map(|label| done(aligned, label));
    if let [Some(flip), Some(xpic), Some(implicit)] = &runs {
        let runs = [flip, xpic, implicit];
        save(
            "incline",
            profiles(
                "Film at 0.5 ms, floor on the nodes",
                &main,
                &runs,
                &[0.0; 3],
            ),
        )?;
        save("incline-points", points(&main, &runs))?;
    }
    for (name, label) in [("xpic", "XPIC(5)"), ("implicit", "implicit")] {
        let offsets = [0.0, 0.25, 0.5, 0.75];
        let runs: Vec<Run> = offsets
            .iter()
            .filter_map(|o| done(&format!("incline-n6-off{o}"), label))
            .collect();
        if runs.len() == offsets.len() {
            let labels = offsets.map(|o| format!("floor {o} cell off"));
            let labels: Vec<&str> = labels.iter().map(String::as_str).collect();
            let title = format!("Film by {label}, floor off the nodes");
            let runs: Vec<&Run> = runs.iter().collect();
            save(
                &format!("incline-{name}"),
                profiles(&title, &labels, &runs, &offsets),
            )?;
        }
    }
    let channel = channel(outcomes);
    if let Some(plot) = channel {
        save("channel", plot.draw())?;
    }
    let slits: Vec<(&str, Run)> = ["FLIP", "XPIC(5)", "APIC", "implicit"]
        .into_iter()
        .filter_map(|label| Some((label, done("slit-n6-off0-0", label)?)))
        .collect();
    if !slits.is_empty() {
        save("slit", slit_forces(&slits)?.draw())?;
    }
    Ok(())
}

/// Velocity over height of films whose floors lie `offsets` cells off the nodes, with Eq. 5.
fn profiles(
    title: &str,
    labels: &[&str],
    runs: &[&Run],
    offsets: &[f64],
) -> Result<Drawing, figures::Error> {
    let mut plot = Plot::new(
        title,
        "height over thickness",
        "velocity over v_max of Eq. 5",
    );
    for ((label, run), &offset) in labels.iter().zip(runs).zip(offsets) {
        let spots = incline::profile(run, 6, offset).map_err(figures::Error::Data)?;
        let places = spots.iter().map(|(at, v)| [at[1], *v]).collect();
        plot = plot.with(label, Mark::Dots, places);
    }
    let exact = (0..=100)
        .map(|i| {
            let y = f64::from(i) / 100.0;
            [y, incline::velocity(y * LUMEN) / incline::fastest()]
        })
        .collect();
    plot.with("Eq. 5", Mark::Line, exact).draw()
}

fn points(labels: &[&str], runs: &[&Run]) -> Result<Drawing, figures::Error> {
    let mut clouds = Clouds::new("velocity over v_max", [0.0, 1.0], 0.03);
    for (label, run) in labels.iter().zip(runs) {
        let spots = incline::profile(run, 6, 0.0).map_err(figures::Error::Data)?;
        clouds = clouds.with(label, spots);
    }
    clouds.draw()
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
    Ok(plot.with("24-cell prototype", Mark::Dots, slit::reference()))
}

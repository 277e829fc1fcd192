//! A piston pushes liquid from a reservoir, four slit widths wide, into a slit: the mission's
//! own flow. Against finite elements behind a tracked front (lib/studies/reference).

use super::{LUMEN, Measured, Scene, at_middle};
use crate::case_text::{Body, CaseText, PF};
use crate::outputs::Run;

/// Piston speed, m/s; the slit is a quarter of the reservoir, so it flows four times faster.
const SPEED: f64 = 0.5;

/// Filled length in slit widths and the equivalent length that piston, entrance and moving front
/// add to it in the piston force, less what the liquid's compression takes, for a piston whose
/// sides give way over 1/24 H (lib/studies/reference/slit-filling.csv).
const ENTRANCE: [(f64, f64); 4] = [(1.0, 0.246), (2.0, 0.235), (3.0, 0.260), (4.0, 0.346)];

/// More of it each time that length is divided by e: the force of a piston on liquid that sticks
/// to its sides has no limit, since both corners are Taylor's scraper (pressure as 1/r).
const CORNER: f64 = 0.0223;

/// Slit of `n` cells, walls offset by `offset` cells along x and y.
pub fn scene(n: u32, offset: [f64; 2]) -> Scene {
    let h = LUMEN / f64::from(n);
    let (x0, width) = ((2.0 + offset[0]) * h, 4.0 * LUMEN);
    let centre = x0 + 0.5 * width;
    // A whole number of cells, because pressures refer to the cross-section of the grid.
    let right = (4.0 * f64::from(n) + 6.0) * h;
    let shoulder = 7.0 * LUMEN + 2.0 * h;
    // The piston comes from above; the slit leads down, as in a clamped bond line.
    let piston = shoulder + 2.0 * LUMEN + offset[1] * h;
    let top = piston + 3.0 * h;
    let half = 0.5 * LUMEN;
    let case = CaseText {
        stop: Some(0.55 * 2.0 * LUMEN / SPEED),
        bodies: vec![
            Body::wall([0.0, 0.0, 0.0], [x0, top, h]).named("bottom"),
            Body::wall([x0 + width, 0.0, 0.0], [right, top, h]).named("bottom"),
            Body::wall([x0, 0.0, 0.0], [centre - half, shoulder, h]).named("bottom"),
            Body::wall([centre + half, 0.0, 0.0], [x0 + width, shoulder, h]).named("bottom"),
            Body::wall([x0, piston, 0.0], [x0 + width, top + LUMEN, h])
                .moving([0.0, -SPEED, 0.0])
                .named("top"),
            Body::liquid([x0, shoulder, 0.0], [x0 + width, piston, h]),
        ],
        history_every: 0.05e-6,
        ..CaseText::new(
            format!(
                "A piston pushes liquid from a reservoir into a slit of {n} cells, walls ({}, {}) cell off the nodes.",
                offset[0], offset[1]
            ),
            h,
            2,
            [right, top, h],
        )
    };
    Scene {
        name: format!("slit-n{n}-off{}-{}", offset[0], offset[1]),
        case,
        against: "finite elements",
        measure: Box::new(move |run| {
            let (filled, force): (Vec<f64>, Vec<f64>) =
                curve(run, n)?.iter().map(|p| (p[0], p[1])).unzip();
            let mut list = Vec::new();
            for (length, entrance) in ENTRANCE {
                if let Some(f) = at_middle(&filled, &force, length - 0.25, length + 0.25) {
                    list.push(Measured::relative(
                        format!("piston force at L = {length} H"),
                        f,
                        length + entrance + corner(n),
                    ));
                }
            }
            let time = run.summary("time_s").unwrap_or(f64::NAN);
            let room = (piston - SPEED * time - shoulder) * width * h;
            list.push(Measured::absolute(
                "density in the reservoir",
                volume_above(run, shoulder)? / room - 1.0,
            ));
            Ok(list)
        }),
    }
}

/// Filled length in slit widths and force on the piston over that of one filled width, row by
/// row of the history of a run with `n` cells.
///
/// # Errors
/// What is wrong with the history.
pub fn curve(run: &Run, n: u32) -> Result<Vec<[f64; 2]>, String> {
    let time = run.middles()?;
    let pressure = run.history("pressure_top_Pa")?;
    // History pressures refer to the whole cross-section of the domain.
    let section = (4.0 * f64::from(n) + 6.0) / (4.0 * f64::from(n));
    let unit = 12.0 * PF[2] * 4.0 * SPEED / LUMEN;
    let row = |(t, p): (&f64, &f64)| [4.0 * SPEED * t / LUMEN, p * section / unit];
    Ok(time.iter().zip(&pressure).map(row).collect())
}

/// What the corners of the piston add where its sides give way over one of `n` cells.
pub fn corner(n: u32) -> f64 {
    CORNER * (f64::from(n) / 24.0).ln()
}

/// Filled lengths and forces of the reference for `n` cells.
pub fn reference(n: u32) -> Vec<[f64; 2]> {
    ENTRANCE
        .map(|(length, more)| [length, length + more + corner(n)])
        .to_vec()
}

/// Volume of the points above a height, m3.
fn volume_above(run: &Run, height: f64) -> Result<f64, String> {
    let file = run.last()?;
    let position = file.vectors("position").map_err(|e| e.to_string())?;
    let volume = file.column::<f32>("volume").map_err(|e| e.to_string())?;
    let above = position
        .iter()
        .zip(volume)
        .filter(|(x, _)| f64::from(x[1]) > height);
    Ok(above.map(|(_, v)| f64::from(*v)).sum())
}

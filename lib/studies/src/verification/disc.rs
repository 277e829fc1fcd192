//! Squeeze film between closing discs: a quarter disc of liquid between plates that are wider.

use super::lumen::{Section, quarter};
use super::{Measured, Scene};
use crate::case_text::{Body, CaseText, PF};
use crate::closed_forms::squeeze_discs;

const CELL: f64 = 2.9e-6;
const SPEED: f64 = 0.1;

/// Gap of `n` cells, lower plate `offset` cells off the nodes, radius `aspect` gaps.
pub fn scene(aspect: u32, n: u32, offset: f64) -> Scene {
    let across = 2 * aspect * n;
    let (gap, d) = (f64::from(n) * CELL, f64::from(across) * CELL);
    let low = (2.0 + offset) * CELL;
    let (right, top) = (0.5 * d + 4.0 * CELL, (f64::from(n) + 5.0) * CELL);
    // Short enough that the gap changes by a twentieth of a cell.
    let until = 0.05 * CELL / SPEED;
    let mut bodies = vec![
        Body::wall([0.0; 3], [right, low, right]).named("bottom"),
        Body::wall([0.0, low + gap, 0.0], [right, top + CELL, right])
            .moving([0.0, -SPEED, 0.0])
            .named("top"),
    ];
    for r in quarter(Section::Round(2), across, d, right).open {
        let high = [r.high[0], low + gap, r.high[1]];
        bodies.push(Body::liquid([r.low[0], low, r.low[1]], high));
    }
    let case = CaseText {
        title: format!(
            "Squeeze film of a disc, radius {aspect} gaps, gap of {n} cells, plates {offset} cell off the nodes; a quarter of it.\nAgainst 3 pi eta R^4 V/(2 h^3), R of the voxels' area."
        ),
        stop: Some(until),
        bodies,
        history_every: until / 10.0,
        ..CaseText::new(CELL, 3, [right, top, right])
    };
    // The radius of a circle of the area of the voxels.
    let radius = d * (Section::Round(2).area(across) / std::f64::consts::PI).sqrt();
    let name = format!("disc{aspect}-n{n}-off{offset}");
    Scene::new(name, "lubrication theory", case, move |run| {
        let [end, step, top, bottom] =
            run.ends(["time_s", "dt_s", "pressure_top_Pa", "pressure_bottom_Pa"])?;
        // What is pressed out widens the disc.
        let now = gap - (end - 0.5 * step) * SPEED;
        let wider = radius * (gap / now).sqrt();
        let exact = 0.25 * squeeze_discs(wider, now, SPEED, PF[2]);
        Ok(vec![
            Measured::relative("force on the top", top * right * right, exact),
            Measured::relative("force on the bottom", bottom * right * right, exact),
        ])
    })
}

//! Squeeze film between closing plates: force of lubrication theory.

use super::{Measured, Scene};
use crate::case_text::{Body, CaseText, PF};
use crate::closed_forms::squeeze_plates;

const CELL: f64 = 2.9e-6;
const SPEED: f64 = 0.05;
/// Half-length of the film over the gap: long enough for lubrication theory, short enough for
/// the compressible liquid to come under pressure within the run.
const ASPECT: f64 = 8.0;

/// Gap of `n` cells, lower plate `offset` cells off the nodes, half-length [`ASPECT`] gaps; half of it
/// is computed, mirrored at x = 0.
pub fn scene(n: u32, offset: f64) -> Scene {
    let gap = f64::from(n) * CELL;
    let half_length = ASPECT * gap;
    let low = (2.0 + offset) * CELL;
    let high = low + gap;
    let (right, top) = (half_length + 8.0 * CELL, (f64::from(n) + 5.0) * CELL);
    // Short enough that the gap changes by a twentieth of a cell.
    let until = 0.05 * CELL / SPEED;
    let case = CaseText {
        title: format!(
            "Squeeze film, gap of {n} cells, plates {offset} cell off the nodes, half-length {ASPECT} gaps.\nAgainst 8 eta v a^3/h^3 per length."
        ),
        stop: Some(until),
        bodies: vec![
            Body::wall([0.0, 0.0, 0.0], [right, low, CELL]).named("bottom"),
            Body::wall([0.0, high, 0.0], [right, top + CELL, CELL])
                .moving([0.0, -SPEED, 0.0])
                .named("top"),
            Body::liquid([0.0, low, 0.0], [half_length, high, CELL]),
        ],
        history_every: until / 10.0,
        ..CaseText::plane(CELL, [right, top])
    };
    let name = format!("squeeze-n{n}-off{offset}");
    Scene::new(name, "lubrication theory", case, move |run| {
        let [end, step, top, bottom] =
            run.ends(["time_s", "dt_s", "pressure_top_Pa", "pressure_bottom_Pa"])?;
        // What is pressed out lengthens the film.
        let now = gap - (end - 0.5 * step) * SPEED;
        let longer = half_length * gap / now;
        let exact = 0.5 * squeeze_plates(longer, now, SPEED, PF[2]);
        Ok(vec![
            Measured::relative("force on the top", top * right, exact),
            Measured::relative("force on the bottom", bottom * right, exact),
        ])
    })
}

//! Squeeze film between closing plates: force of lubrication theory.

use super::{Measured, Scene};
use crate::Result;
use crate::case_text::{Body, CaseText, PF};
use crate::outputs::Run;

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
        bodies: plates([right, CELL], [low, high, top + CELL], |plate| {
            plate.moving([0.0, -SPEED, 0.0])
        })
        .chain([Body::liquid([0.0, low, 0.0], [half_length, high, CELL])])
        .collect(),
        history_every: until / 10.0,
        ..CaseText::plane(CELL, [right, top])
    };
    let name = format!("squeeze-n{n}-off{offset}");
    Scene::new(name, "lubrication theory", case, move |run| {
        // What is pressed out lengthens the film.
        forces(run, right, SPEED, |closed| {
            let now = gap - closed;
            let half_length = half_length * gap / now;
            0.5 * (8.0 * PF[2] * SPEED * (half_length / now).powi(3))
        })
    })
}

/// A plate at rest from zero to the first of `heights` and one, `driven`, between the others; `[x, z]` far. All m.
pub(super) fn plates(
    [x, z]: [f64; 2],
    [low, high, top]: [f64; 3],
    driven: fn(Body) -> Body,
) -> impl Iterator<Item = Body> {
    let bottom = Body::wall([0.0; 3], [x, low, z]).named("bottom");
    let top = driven(Body::wall([0.0, high, 0.0], [x, top, z])).named("top");
    [bottom, top].into_iter()
}

/// Forces on plates of an `area` (m2, or m in plane strain) that close at `speed`, against that where they have closed by a way (m).
pub(super) fn forces(
    run: &Run,
    area: f64,
    speed: f64,
    exact: impl Fn(f64) -> f64,
) -> Result<Vec<Measured>> {
    let [end, step, top, bottom] =
        run.ends(["time_s", "dt_s", "pressure_top_Pa", "pressure_bottom_Pa"])?;
    let exact = exact((end - 0.5 * step) * speed);
    Ok(vec![
        Measured::relative("force on the top", top * area, exact),
        Measured::relative("force on the bottom", bottom * area, exact),
    ])
}

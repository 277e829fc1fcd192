//! Squeeze films between closing plates and discs: forces of lubrication theory.

use std::f64::consts::PI;

use super::lumen::{Section, quarter};
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

/// Speed of a disc, m/s.
const DISC_SPEED: f64 = 0.1;

/// A quarter disc of liquid between plates that are wider. Gap of `n` cells, lower plate `offset` cells off the nodes, radius `aspect` gaps.
pub fn disc_scene(aspect: u32, n: u32, offset: f64) -> Scene {
    let across = 2 * aspect * n;
    let (gap, d) = (f64::from(n) * CELL, f64::from(across) * CELL);
    let low = (2.0 + offset) * CELL;
    let (right, top) = (0.5 * d + 4.0 * CELL, (f64::from(n) + 5.0) * CELL);
    // Short enough that the gap changes by a twentieth of a cell.
    let until = 0.05 * CELL / DISC_SPEED;
    let plates = plates([right; 2], [low, low + gap, top + CELL], |plate| {
        plate.moving([0.0, -DISC_SPEED, 0.0])
    });
    let shape = quarter(Section::Round(2), across, d, right);
    let liquid = shape.open.iter().map(|r| {
        let high = [r.high[0], low + gap, r.high[1]];
        Body::liquid([r.low[0], low, r.low[1]], high)
    });
    let case = CaseText {
        title: format!(
            "Squeeze film of a disc, radius {aspect} gaps, gap of {n} cells, plates {offset} cell off the nodes; a quarter of it.\nAgainst 3 pi eta R^4 V/(2 h^3), R of the voxels' area."
        ),
        stop: Some(until),
        bodies: plates.chain(liquid).collect(),
        history_every: until / 10.0,
        ..CaseText::new(CELL, 3, [right, top, right])
    };
    // The radius of a circle of the area of the voxels.
    let radius = d * (Section::Round(2).area(across) / PI).sqrt();
    let name = format!("disc{aspect}-n{n}-off{offset}");
    Scene::new(name, "lubrication theory", case, move |run| {
        // What is pressed out widens the disc.
        forces(run, right * right, DISC_SPEED, |closed| {
            let now = gap - closed;
            let radius = radius * (gap / now).sqrt();
            0.25 * (1.5 * PI * PF[2] * DISC_SPEED * radius.powi(4) / now.powi(3))
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

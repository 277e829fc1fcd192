//! Squeeze film between closing discs: a quarter disc of liquid between plates that are wider.

use std::f64::consts::PI;

use super::Scene;
use super::lumen::{Section, quarter};
use super::squeeze::{forces, plates};
use crate::case_text::{Body, CaseText, PF};

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
    let plates = plates([right; 2], [low, low + gap, top + CELL], |plate| {
        plate.moving([0.0, -SPEED, 0.0])
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
        forces(run, right * right, SPEED, |closed| {
            let now = gap - closed;
            let radius = radius * (gap / now).sqrt();
            0.25 * (1.5 * PI * PF[2] * SPEED * radius.powi(4) / now.powi(3))
        })
    })
}

//! Squeeze film between closing plates: force of lubrication theory.

use super::{Measured, Scene};
use crate::case_text::{Body, CaseText, PF, STICK};
use crate::closed_forms::squeeze_plates;

const CELL: f64 = 2.9e-6;
const SPEED: f64 = 0.1;

/// Gap of `n` cells, lower plate `offset` cells off the nodes, half-length 16 gaps; half of it
/// is computed, mirrored at x = 0.
pub fn scene(n: u32, offset: f64) -> Scene {
    let gap = f64::from(n) * CELL;
    let half_length = 16.0 * gap;
    let low = (2.0 + offset) * CELL;
    let high = low + gap;
    let (right, top) = (half_length + 8.0 * CELL, (f64::from(n) + 5.0) * CELL);
    // Short enough that the gap changes by a twentieth of a cell.
    let until = 0.05 * CELL / SPEED;
    let case = CaseText {
        title: format!(
            "Squeeze film, gap of {n} cells, plates {offset} cell off the nodes, half-length 16 gaps.\nAgainst 8 eta v a^3/h^3 per length."
        ),
        cell: CELL,
        dimensions: 2,
        domain: [[0.0; 3], [right, top, CELL]],
        viscosity: None,
        contact: STICK.into(),
        clamp: None,
        gravity: [0.0; 3],
        boundary: ["symmetry", "symmetry", "symmetry"],
        stop: Some(until),
        bodies: vec![
            Body::wall([0.0, 0.0, 0.0], [right, low, CELL]).named("bottom"),
            Body::wall([0.0, high, 0.0], [right, top + CELL, CELL])
                .moving([0.0, -SPEED, 0.0])
                .named("top"),
            Body::liquid([0.0, low, 0.0], [half_length, high, CELL]),
        ],
        history_every: until / 10.0,
    };
    Scene {
        name: format!("squeeze-n{n}-off{offset}"),
        case,
        against: "lubrication theory",
        measure: Box::new(move |run| {
            let travelled: Vec<f64> = run.history("time_s")?.iter().map(|t| t * SPEED).collect();
            let top = run.history("pressure_top_Pa")?;
            let bottom = run.history("pressure_bottom_Pa")?;
            let (Some(&s), Some(&p), Some(&q)) = (travelled.last(), top.last(), bottom.last())
            else {
                return Err("the history is empty".into());
            };
            let exact = 0.5 * squeeze_plates(half_length, gap - s, SPEED, PF[2]);
            Ok(vec![
                Measured::relative("force on the top", p * right, exact),
                Measured::relative("force on the bottom", q * right, exact),
            ])
        }),
    }
}

//! Liquid at rest under a body force: weight on the floor and pressure over the height.

use super::{Measured, Scene};
use crate::case_text::{Body, CaseText, PF};

const CELL: f64 = 2.9e-6;
/// Body force per mass, m/s2.
const G: f64 = 1e6;

/// A column of 12 cells, its floor `offset` cells off the nodes, after `until` (s).
pub fn scene(offset: f64, until: f64) -> Scene {
    let (width, floor, height) = (4.0 * CELL, (2.0 + offset) * CELL, 12.0 * CELL);
    let case = CaseText {
        contact: "law = \"frictionless\"\n".into(),
        gravity: [0.0, -G, 0.0],
        boundary: ["symmetry", "open", "symmetry"],
        stop: Some(until),
        bodies: vec![
            Body::wall([0.0; 3], [width, floor, CELL]).named("bottom"),
            Body::liquid([0.0, floor, 0.0], [width, floor + height, CELL]),
        ],
        history_every: until / 200.0,
        ..CaseText::plane(
            format!(
                "Liquid at rest under a body force, floor {offset} cell off the nodes.\nAgainst rho g h."
            ),
            CELL,
            [width, 18.0 * CELL],
        )
    };
    Scene {
        name: format!("column-off{offset}"),
        case,
        against: "hydrostatics",
        measure: Box::new(move |run| {
            let weight = PF[0] * G * height;
            let force = run.history("pressure_bottom_Pa")?;
            let late = &force[force.len() * 4 / 5..];
            let mean = late.iter().sum::<f64>() / late.len() as f64;
            let file = run.last()?;
            let position = file.vectors("position").map_err(|e| e.to_string())?;
            let pressure = file.column::<f32>("pressure").map_err(|e| e.to_string())?;
            let square = |(x, p): (&[f32; 3], &f32)| {
                let depth = floor + height - f64::from(x[1]);
                (f64::from(*p) - PF[0] * G * depth).powi(2)
            };
            let sum: f64 = position.iter().zip(pressure).map(square).sum();
            let rms = (sum / position.len() as f64).sqrt() / weight;
            Ok(vec![
                Measured::relative("weight on the floor", mean, weight),
                Measured::absolute("rms pressure over rho g h", rms),
            ])
        }),
    }
}

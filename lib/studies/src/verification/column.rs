//! Liquid at rest under a body force: weight on the floor and pressure over the height.

use super::{Measured, Scene};
use crate::case_text::{Body, CaseText, PF};
use crate::numbers::{mean, rms};

const CELL: f64 = 2.9e-6;
/// Body force per mass, m/s2.
const G: f64 = 1e6;

/// A column of 12 cells, its floor `offset` cells off the nodes, after `until` (s).
pub fn scene(offset: f64, until: f64) -> Scene {
    let (width, floor, height) = (4.0 * CELL, (2.0 + offset) * CELL, 12.0 * CELL);
    let case = CaseText {
        title: format!(
            "Liquid at rest under a body force, floor {offset} cell off the nodes.\nAgainst rho g h."
        ),
        contact: "law = \"frictionless\"\n".into(),
        gravity: [0.0, -G, 0.0],
        boundary: ["symmetry", "open", "symmetry"],
        stop: Some(until),
        bodies: vec![
            Body::wall([0.0; 3], [width, floor, CELL]).named("bottom"),
            Body::liquid([0.0, floor, 0.0], [width, floor + height, CELL]),
        ],
        history_every: until / 200.0,
        ..CaseText::plane(CELL, [width, 18.0 * CELL])
    };
    let name = format!("column-off{offset}");
    Scene::new(name, "hydrostatics", case, move |run| {
        let weight = PF[0] * G * height;
        let force = run.history("pressure_bottom_Pa")?;
        let late = mean(force[force.len() * 4 / 5..].iter().copied());
        let points = run.points()?;
        let depth = |y: f64| floor + height - y;
        let off = points
            .iter()
            .map(|p| p.pressure - PF[0] * G * depth(p.at[1]));
        Ok(vec![
            Measured::relative("weight on the floor", late, weight),
            Measured::absolute("rms pressure over rho g h", rms(off) / weight),
        ])
    })
}

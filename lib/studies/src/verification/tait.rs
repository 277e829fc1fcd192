//! Columns of liquid without friction: compressed by a piston, against paper Eq. 1, and at rest under a body force.

use super::{Measured, Scene};
use crate::case_text::{Body, CaseText, PF};
use crate::numbers::{mean, rms};

const CELL: f64 = 2.9e-6;
const SPEED: f64 = 0.5;

/// Column of 12 cells compressed by two per cent without wall friction.
pub fn scene() -> Scene {
    let (width, floor, height) = (4.0 * CELL, 3.0 * CELL, 12.0 * CELL);
    let piston = floor + height;
    let until = 0.02 * height / SPEED;
    let case = CaseText {
        title: "A piston compresses a closed column of liquid by 2 %.\nAgainst paper Eq. 1.".into(),
        contact: "law = \"frictionless\"\n".into(),
        stop: Some(until),
        bodies: vec![
            Body::wall([0.0; 3], [width, floor, CELL]).named("bottom"),
            Body::wall([0.0, piston, 0.0], [width, piston + 6.0 * CELL, CELL])
                .moving([0.0, -SPEED, 0.0])
                .named("top"),
            Body::liquid([0.0, floor, 0.0], [width, piston, CELL]),
        ],
        history_every: until / 20.0,
        ..CaseText::plane(CELL, [width, piston + 3.0 * CELL])
    };
    Scene::new("tait-column", "paper Eq. 1", case, move |run| {
        let [time, pressure] = run.columns(["time_s", "pressure_top_Pa"])?;
        // Each row of the last tenth against the law at its own time: sound still rings.
        let from = time.partition_point(|&t| t <= 0.9 * until);
        let exact = |t: &f64| tait(1.0 - SPEED * t / height);
        let exact = mean(time[from..].iter().map(exact));
        let found = mean(pressure[from..].iter().copied());
        // The law itself, without the walls: each point's pressure against that of its own volume.
        let points = run.points()?;
        let whole = width * height * CELL / points.len() as f64;
        let off = points
            .iter()
            .map(|p| p.pressure / tait(p.volume / whole) - 1.0);
        Ok(vec![
            Measured::relative("piston pressure", found, exact),
            Measured::absolute("rms pressure of points of their volume", rms(off)),
        ])
    })
}

/// Pressure at a relative volume, Pa.
fn tait(j: f64) -> f64 {
    0.0894 * PF[1] * (((1.0 - j) / 0.0894).exp() - 1.0)
}

/// Body force per mass, m/s2.
const G: f64 = 1e6;

/// Liquid at rest under a body force: weight on the floor and pressure over the height. A column of 12 cells, its floor `offset` cells off the nodes, after `until` (s).
pub fn resting_scene(offset: f64, until: f64) -> Scene {
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

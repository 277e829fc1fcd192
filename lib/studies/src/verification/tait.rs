//! Compression of a closed box of liquid by a piston: pressure against paper Eq. 1.

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

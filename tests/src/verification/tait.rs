//! Compression of a closed box of liquid by a piston: pressure against paper Eq. 1.

use super::{Measured, Scene};
use crate::case_text::{Body, CaseText, PF};
use crate::closed_forms::tait;

const CELL: f64 = 2.9e-6;
const SPEED: f64 = 0.5;

/// Column of 12 cells compressed by two per cent without wall friction.
pub fn scene() -> Scene {
    let (width, floor, height) = (4.0 * CELL, 3.0 * CELL, 12.0 * CELL);
    let piston = floor + height;
    let until = 0.02 * height / SPEED;
    let case = CaseText {
        title: "A piston compresses a closed column of liquid by 2 %.\nAgainst paper Eq. 1.".into(),
        cell: CELL,
        dimensions: 2,
        domain: [[0.0; 3], [width, piston + 3.0 * CELL, CELL]],
        viscosity: None,
        contact: "law = \"frictionless\"\n".into(),
        clamp: None,
        gravity: [0.0; 3],
        boundary: ["symmetry", "symmetry", "symmetry"],
        stop: Some(until),
        bodies: vec![
            Body::wall([0.0; 3], [width, floor, CELL]).named("bottom"),
            Body::wall([0.0, piston, 0.0], [width, piston + 6.0 * CELL, CELL])
                .moving([0.0, -SPEED, 0.0])
                .named("top"),
            Body::liquid([0.0, floor, 0.0], [width, piston, CELL]),
        ],
        history_every: until / 20.0,
    };
    Scene {
        name: "tait-column".into(),
        case,
        against: "paper Eq. 1",
        measure: Box::new(move |run| {
            let (time, p) = (run.history("time_s")?, run.history("pressure_top_Pa")?);
            let (Some(&t), Some(_)) = (time.last(), p.last()) else {
                return Err("the history is empty".into());
            };
            let late = window_mean_of(&p, &time, 0.9 * t);
            let mean_time = 0.95 * t;
            let exact = tait(1.0 - SPEED * mean_time / height, PF[1]);
            Ok(vec![Measured::relative("piston pressure", late, exact)])
        }),
    }
}

fn window_mean_of(p: &[f64], time: &[f64], from: f64) -> f64 {
    super::window_mean(time, p, from, f64::INFINITY).unwrap_or(f64::NAN)
}

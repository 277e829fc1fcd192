//! Liquid and walls that all move at one velocity stay as they are, by any update and wall law.
//!
//! The speed is a power of two, so that weights times speed are exact and only a step that takes
//! the velocity itself for a difference drifts. At other speeds f32 rounds every product, and
//! without friction that adds up: in 12 000 steps (6 us) at 0.37 m/s FLIP drifts by 1e-6 of the
//! speed, APIC 1e-5, PIC 2e-5; built in double precision, 1e-16.

use super::{Measured, Scene};
use crate::case_text::{Body, CaseText, partial_slip};
use crate::numbers::largest;

const CELL: f64 = 2.9e-6;
const SPEED: f64 = 0.5;

/// Liquid between walls `offset` cells off the nodes with the wall law of this name, until
/// everything has moved by three cells.
pub fn scene(law: &str, offset: f64) -> Scene {
    let (width, low, high) = (8.0 * CELL, (2.0 + offset) * CELL, (8.0 + offset) * CELL);
    let until = 3.0 * CELL / SPEED;
    let bodies = [
        Body::wall([-1e-4, 0.0, 0.0], [1e-4, low, CELL]).named("bottom"),
        Body::wall([-1e-4, high, 0.0], [1e-4, high + 4.0 * CELL, CELL]).named("top"),
        Body::liquid([0.0, low, 0.0], [width, high, CELL]),
    ];
    let case = CaseText {
        title: format!(
            "Liquid and walls all at {SPEED} m/s, {law}, walls {offset} cell off the nodes.\nAgainst nothing changing."
        ),
        contact: match law {
            "partial-slip" => partial_slip("0.01 cell"),
            law => format!("law = \"{law}\"\n"),
        },
        boundary: ["periodic", "symmetry", "symmetry"],
        stop: Some(until),
        bodies: bodies.map(|body| body.moving([SPEED, 0.0, 0.0])).into(),
        history_every: until / 20.0,
        ..CaseText::plane(CELL, [width, 11.0 * CELL])
    };
    let name = format!("galilean-{law}");
    Scene::new(name, "Galilean invariance", case, |run| {
        let points = run.points()?;
        let velocities = points.iter().map(|p| p.velocity);
        let drift = largest(velocities.map(|[u, v, _]| (u - SPEED).abs().max(v.abs())));
        let what = "largest drift over the speed";
        Ok(vec![Measured::absolute(what, drift / SPEED)])
    })
}

//! Liquid and walls that all move at one velocity stay as they are, by any update and wall law.
//!
//! The speed is a power of two, so that weights times speed are exact and only a step that takes
//! the velocity itself for a difference drifts. At other speeds f32 rounds every product, and
//! without friction that adds up: in 12 000 steps (6 us) at 0.37 m/s FLIP drifts by 1e-6 of the
//! speed, APIC 1e-5, PIC 2e-5; built in double precision, 1e-16.

use super::{Measured, Scene, final_points};
use crate::case_text::{Body, CaseText};

const CELL: f64 = 2.9e-6;
const SPEED: f64 = 0.5;

/// Liquid between walls `offset` cells off the nodes with the wall law of this name, until
/// everything has moved by three cells.
pub fn scene(law: &str, offset: f64) -> Scene {
    let (width, low, high) = (8.0 * CELL, (2.0 + offset) * CELL, (8.0 + offset) * CELL);
    let velocity = [SPEED, 0.0, 0.0];
    let until = 3.0 * CELL / SPEED;
    let slip = if law == "partial-slip" {
        "influence_length = \"0.01 cell\"\n"
    } else {
        ""
    };
    let case = CaseText {
        contact: format!("law = \"{law}\"\n{slip}"),
        boundary: ["periodic", "symmetry", "symmetry"],
        stop: Some(until),
        bodies: vec![
            Body::wall([-1e-4, 0.0, 0.0], [1e-4, low, CELL])
                .moving(velocity)
                .named("bottom"),
            Body::wall([-1e-4, high, 0.0], [1e-4, high + 4.0 * CELL, CELL])
                .moving(velocity)
                .named("top"),
            Body::liquid([0.0, low, 0.0], [width, high, CELL]).moving(velocity),
        ],
        history_every: until / 20.0,
        ..CaseText::plane(
            format!(
                "Liquid and walls all at {SPEED} m/s, {law}, walls {offset} cell off the nodes.\nAgainst nothing changing."
            ),
            CELL,
            [width, 11.0 * CELL],
        )
    };
    Scene {
        name: format!("galilean-{law}"),
        case,
        against: "Galilean invariance",
        measure: Box::new(move |run| {
            let drift = final_points(run)?
                .iter()
                .map(|(_, v)| (v[0] - SPEED).abs().max(v[1].abs()))
                .fold(0.0, f64::max);
            Ok(vec![Measured::absolute(
                "largest drift over the speed",
                drift / SPEED,
            )])
        }),
    }
}

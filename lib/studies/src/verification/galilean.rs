//! Invariants: liquid and walls that all move at one velocity stay as they are, by any update and wall law; a free drop keeps
//! its momentum and angular momentum.
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
            "Liquid and walls, all at {SPEED} m/s, {law}, walls {offset} cell off the nodes.\nReference: no change."
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

/// Edge of a quarter, cells.
const QUARTER: f64 = 3.0;

/// Speed of each quarter, m/s: a drift, a turn and a deformation.
const VELOCITY: [[f64; 2]; 4] = [[0.3, -0.2], [0.5, 0.4], [-0.1, -0.1], [0.2, 0.5]];

/// The drop for `until` (s).
pub fn drop_scene(until: f64) -> Scene {
    let (edge, low) = (QUARTER * CELL, 5.25 * CELL);
    let quarter = |i: usize| {
        let (x, y) = (low + (i % 2) as f64 * edge, low + (i / 2) as f64 * edge);
        let [u, v] = VELOCITY[i];
        Body::liquid([x, y, 0.0], [x + edge, y + edge, CELL]).moving([u, v, 0.0])
    };
    let case = CaseText {
        title: "A free drop whose quarters move differently.\nAgainst conservation of momentum and angular momentum.".into(),
        boundary: ["open", "open", "symmetry"],
        stop: Some(until),
        bodies: (0..4).map(quarter).collect(),
        history_every: until / 20.0,
        ..CaseText::plane(CELL, [17.0 * CELL; 2])
    };
    Scene::new("drop", "conservation", case, move |run| {
        // Points of one box and spacing have one mass.
        let (mut p, mut l) = ([0.0; 2], 0.0);
        let centre = low + edge;
        let points = run.points()?;
        let n = points.len() as f64;
        for point in &points {
            let ([x, y, _], [u, v, _]) = (point.at, point.velocity);
            p = [p[0] + u / n, p[1] + v / n];
            l += ((x - centre) * v - (y - centre) * u) / n;
        }
        let (mut p0, mut l0, mut l_size) = ([0.0; 2], 0.0, 0.0);
        for (i, [u, v]) in VELOCITY.into_iter().enumerate() {
            let [x, y] = [(i % 2) as f64 - 0.5, (i / 2) as f64 - 0.5].map(|a| a * edge);
            p0 = [p0[0] + 0.25 * u, p0[1] + 0.25 * v];
            l0 += 0.25 * (x * v - y * u);
            l_size += 0.25 * x.hypot(y) * u.hypot(v);
        }
        let lost = (p[0] - p0[0]).hypot(p[1] - p0[1]) / p0[0].hypot(p0[1]);
        let turn = (l - l0).abs() / l_size;
        Ok(vec![
            Measured::absolute("momentum lost, share", lost),
            Measured::absolute("angular momentum lost, share of sum |r||v|", turn),
        ])
    })
}

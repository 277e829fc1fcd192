//! A free drop whose quarters move differently: momentum and angular momentum are kept.

use super::{Measured, Scene};
use crate::case_text::{Body, CaseText};

const CELL: f64 = 2.9e-6;
/// Edge of a quarter, cells.
const QUARTER: f64 = 3.0;

/// Speed of each quarter, m/s: a drift, a turn and a deformation.
const VELOCITY: [[f64; 2]; 4] = [[0.3, -0.2], [0.5, 0.4], [-0.1, -0.1], [0.2, 0.5]];

/// The drop for `until` (s).
pub fn scene(until: f64) -> Scene {
    let (edge, low) = (QUARTER * CELL, 5.25 * CELL);
    let quarter = |i: usize| {
        let (x, y) = (low + (i % 2) as f64 * edge, low + (i / 2) as f64 * edge);
        let [u, v] = VELOCITY[i];
        Body::liquid([x, y, 0.0], [x + edge, y + edge, CELL]).moving([u, v, 0.0])
    };
    let size = 17.0 * CELL;
    let case = CaseText {
        boundary: ["open", "open", "symmetry"],
        stop: Some(until),
        bodies: (0..4).map(quarter).collect(),
        history_every: until / 20.0,
        ..CaseText::plane(
            "A free drop whose quarters move differently.\nAgainst conservation of momentum and angular momentum.",
            CELL,
            [size, size],
        )
    };
    Scene {
        name: "drop".into(),
        case,
        against: "conservation",
        measure: Box::new(move |run| {
            let file = run.last()?;
            let read = |name| file.vectors(name).map_err(|e| e.to_string());
            let (position, velocity) = (read("position")?, read("velocity")?);
            // Points of one box and spacing have one mass.
            let (mut p, mut l) = ([0.0; 2], 0.0);
            let centre = low + edge;
            for (x, v) in position.iter().zip(velocity) {
                let (x, v) = (x.map(f64::from), v.map(f64::from));
                p = [p[0] + v[0], p[1] + v[1]];
                l += (x[0] - centre) * v[1] - (x[1] - centre) * v[0];
            }
            let n = position.len() as f64;
            let (mut p0, mut l0, mut l_size) = ([0.0; 2], 0.0, 0.0);
            for (i, v) in VELOCITY.iter().enumerate() {
                let arm = [(i % 2) as f64 - 0.5, (i / 2) as f64 - 0.5].map(|a| a * edge);
                p0 = [p0[0] + 0.25 * v[0], p0[1] + 0.25 * v[1]];
                l0 += 0.25 * (arm[0] * v[1] - arm[1] * v[0]);
                l_size += 0.25 * arm[0].hypot(arm[1]) * v[0].hypot(v[1]);
            }
            let speed = p0[0].hypot(p0[1]);
            let lost = (p[0] / n - p0[0]).hypot(p[1] / n - p0[1]) / speed;
            Ok(vec![
                Measured::absolute("momentum lost, share", lost),
                Measured::absolute(
                    "angular momentum lost, share of sum |r||v|",
                    (l / n - l0).abs() / l_size,
                ),
            ])
        }),
    }
}

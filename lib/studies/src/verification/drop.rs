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

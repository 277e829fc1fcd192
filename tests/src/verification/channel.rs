//! Plane Poiseuille flow between walls at any offset, driven by a body force along a
//! periodic channel.

use super::{LUMEN, Measured, Scene, pressing};
use crate::case_text::{Body, CaseText, PF, STICK};
use crate::closed_forms::channel_mean;

/// Body force per mass, m/s2: a mean velocity near 0.02 m/s.
const G: f64 = 2.3e5;

/// A channel of `n` cells, its lower wall `offset` cells off the nodes; `slip` is the
/// influence length over the width, `None` for sticking walls.
pub fn scene(n: u32, offset: f64, slip: Option<f64>, until: f64) -> Scene {
    let cell = LUMEN / f64::from(n);
    let (width, low) = (4.0 * cell, (2.0 + offset) * cell);
    let high = low + LUMEN;
    let top = (f64::from(n) + 5.0) * cell;
    let contact = slip.map_or(STICK.to_owned(), |l| {
        format!(
            "law = \"partial-slip\"\ninfluence_length = \"{} um\"\n",
            l * LUMEN * 1e6
        )
    });
    let case = CaseText {
        title: format!(
            "Plane Poiseuille flow in a channel of {n} cells, walls {offset} cell off the nodes.\nAgainst rho g H^2/(12 eta) (1 + 6/(k H))."
        ),
        cell,
        dimensions: 2,
        domain: [[0.0; 3], [width, top, cell]],
        viscosity: None,
        contact,
        clamp: None,
        gravity: [G, 0.0, 0.0],
        boundary: ["periodic", "symmetry", "symmetry"],
        stop: Some(until),
        bodies: vec![
            Body::wall([0.0; 3], [width, low, cell]),
            Body::wall([0.0, high, 0.0], [width, top + cell, cell])
                .moving([0.0, -pressing(until), 0.0])
                .named("top"),
            Body::liquid([0.0, low, 0.0], [width, high, cell]),
        ],
        history_every: until / 20.0,
    };
    Scene {
        name: format!(
            "channel-n{n}-off{offset}{}",
            slip.map_or(String::new(), |s| format!("-slip{s}"))
        ),
        case,
        against: "plane Poiseuille",
        measure: Box::new(move |run| {
            let file = run.last()?;
            let velocity = file.vectors("velocity").map_err(|e| e.to_string())?;
            let mean =
                velocity.iter().map(|v| f64::from(v[0])).sum::<f64>() / velocity.len() as f64;
            let exact = channel_mean(LUMEN, slip.unwrap_or(0.0) * LUMEN, G, PF[0], PF[2]);
            Ok(vec![Measured::relative("mean velocity", mean, exact)])
        }),
    }
}

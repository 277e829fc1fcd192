//! Film on an incline of 50 degrees (paper Eq. 5, Fig. 4), the floor at any offset off the nodes.

use super::{LUMEN, Measured, Scene};
use crate::case_text::{Body, CaseText, PF, STICK};
use crate::closed_forms::film;

/// Body force along and into the floor: 3e5 m/s2 at 50 degrees.
const G: [f64; 2] = [2.298_133_3e5, 1.928_362_8e5];

/// A film of `n` cells, its floor `offset` cells off the nodes, at time `until` (s).
pub fn scene(n: u32, offset: f64, until: f64) -> Scene {
    let cell = LUMEN / f64::from(n);
    let (width, floor) = (4.0 * cell, (3.0 + offset) * cell);
    let top = floor + LUMEN;
    let case = CaseText {
        title: format!(
            "Film on a 50 degree incline, {n} cells thick, floor {offset} cell off the nodes.\nAgainst paper Eq. 5 (Fig. 4)."
        ),
        cell,
        dimensions: 2,
        domain: [[0.0; 3], [width, (7.0 + f64::from(n)) * cell, cell]],
        viscosity: None,
        contact: STICK.into(),
        clamp: None,
        gravity: [G[0], -G[1], 0.0],
        boundary: ["periodic", "open", "symmetry"],
        stop: Some(until),
        bodies: vec![
            Body::wall([0.0; 3], [width, floor, cell]),
            Body::liquid([0.0, floor, 0.0], [width, top, cell]),
        ],
        history_every: until / 50.0,
    };
    Scene {
        name: format!("incline-n{n}-off{offset}"),
        case,
        against: "paper Eq. 5",
        measure: Box::new(move |run| {
            let file = run.last()?;
            let position = file.vectors("position").map_err(|e| e.to_string())?;
            let velocity = file.vectors("velocity").map_err(|e| e.to_string())?;
            let largest = film(LUMEN, LUMEN, G[0], PF[0], PF[2]);
            let (mut profile, mut noise) = (0.0, 0.0);
            for (x, v) in position.iter().zip(velocity) {
                let exact = film(f64::from(x[1]) - floor, LUMEN, G[0], PF[0], PF[2]);
                profile += (f64::from(v[0]) - exact).powi(2);
                noise += f64::from(v[1]).powi(2);
            }
            let rms = |sum: f64| (sum / position.len() as f64).sqrt() / largest;
            Ok(vec![
                Measured::absolute("rms profile error over v_max", rms(profile)),
                Measured::absolute("rms v_y over v_max", rms(noise)),
            ])
        }),
    }
}

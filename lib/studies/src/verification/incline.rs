//! Film on an incline of 50 degrees (paper section 2.3, Eq. 5, Fig. 4), the floor at any offset
//! off the nodes.

use super::{LUMEN, Measured, Scene, final_points};
use crate::case_text::{Body, CaseText, PF};
use crate::closed_forms::film;

/// Gravity of the earth along the floor and into it at 50 degrees, m/s2.
const G: [f64; 2] = [7.514_896, 6.305_746];

/// Time of the paper's figure, s; the film is steady after 1 us.
pub const PAPER_TIME: f64 = 0.5e-3;

/// Distance of the floor of a film of `n` cells from the low side of the domain, m.
fn floor(n: u32, offset: f64) -> f64 {
    (3.0 + offset) * LUMEN / f64::from(n)
}

/// A film of `n` cells, its floor `offset` cells off the nodes, at time `until` (s).
pub fn scene(n: u32, offset: f64, until: f64) -> Scene {
    let cell = LUMEN / f64::from(n);
    let (width, floor) = (4.0 * cell, floor(n, offset));
    let case = CaseText {
        gravity: [G[0], -G[1], 0.0],
        boundary: ["periodic", "open", "symmetry"],
        stop: Some(until),
        bodies: vec![
            Body::wall([0.0; 3], [width, floor, cell]),
            Body::liquid([0.0, floor, 0.0], [width, floor + LUMEN, cell]),
        ],
        history_every: until / 50.0,
        ..CaseText::plane(
            format!(
                "Film on a 50 degree incline, {n} cells thick, floor {offset} cell off the nodes.\nAgainst paper Eq. 5 (Fig. 4)."
            ),
            cell,
            [width, (7.0 + f64::from(n)) * cell],
        )
    };
    Scene {
        name: format!("incline-n{n}-off{offset}"),
        case,
        against: "paper Eq. 5",
        measure: Box::new(move |run| {
            let points = final_points(run)?;
            let rms = |error: &dyn Fn(&[f64; 3], &[f64; 3]) -> f64| {
                let sum: f64 = points.iter().map(|(x, v)| error(x, v).powi(2)).sum();
                (sum / points.len() as f64).sqrt() / fastest()
            };
            Ok(vec![
                Measured::absolute(
                    "rms profile error over v_max",
                    rms(&|x, v| v[0] - velocity(x[1] - floor)),
                ),
                Measured::absolute("rms v_y over v_max", rms(&|_, v| v[1])),
            ])
        }),
    }
}

/// Velocity of paper Eq. 5 at a distance from the floor, m/s.
pub fn velocity(height: f64) -> f64 {
    film(height, LUMEN, G[0], PF[0], PF[2])
}

/// The largest of them, at the surface, m/s.
pub fn fastest() -> f64 {
    velocity(LUMEN)
}

/// Position (x, height over the floor) and velocity along the floor of each point of a run, over
/// the thickness and [`fastest`], for Fig. 4.
///
/// # Errors
/// What is wrong with the run's final state.
pub fn profile(
    run: &crate::outputs::Run,
    n: u32,
    offset: f64,
) -> Result<Vec<([f64; 2], f64)>, String> {
    let low = floor(n, offset);
    let points = final_points(run)?;
    Ok(points
        .iter()
        .map(|(x, v)| {
            let at = [x[0] / LUMEN, (x[1] - low) / LUMEN];
            (at, v[0] / fastest())
        })
        .collect())
}

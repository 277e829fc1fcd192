//! Film on an incline of 50 degrees (paper section 2.3, Eq. 5, Fig. 4), the floor at any offset
//! off the nodes.

use super::{LUMEN, Measured, Scene};
use crate::Result;
use crate::case_text::{Body, CaseText, PF};
use crate::numbers::rms;
use crate::outputs::Run;

/// Gravity of the earth along the floor and into it at 50 degrees, m/s2.
const G: [f64; 2] = [7.514_896, 6.305_746];

/// Distance of the floor of a film of `n` cells from the low side of the domain, m.
fn floor(n: u32, offset: f64) -> f64 {
    (3.0 + offset) * LUMEN / f64::from(n)
}

/// A film of `n` cells, its floor `offset` cells off the nodes, at time `until` (s): 0.5 ms in the
/// paper's figure, and steady after 1 us.
pub fn scene(n: u32, offset: f64, until: f64) -> Scene {
    let cell = LUMEN / f64::from(n);
    let (width, floor) = (4.0 * cell, floor(n, offset));
    let case = CaseText {
        title: format!(
            "Film on a 50 degree incline, {n} cells thick, floor {offset} cell off the nodes.\nAgainst paper Eq. 5 (Fig. 4)."
        ),
        gravity: [G[0], -G[1], 0.0],
        boundary: ["periodic", "open", "symmetry"],
        stop: Some(until),
        bodies: vec![
            Body::wall([0.0; 3], [width, floor, cell]),
            Body::liquid([0.0, floor, 0.0], [width, floor + LUMEN, cell]),
        ],
        history_every: until / 50.0,
        ..CaseText::plane(cell, [width, (7.0 + f64::from(n)) * cell])
    };
    let name = format!("incline-n{n}-off{offset}");
    Scene::new(name, "paper Eq. 5", case, move |run| {
        let points = run.points()?;
        let off = (points.iter()).map(|p| p.velocity[0] - velocity(p.at[1] - floor));
        let [profile, across] = [rms(off), rms(points.iter().map(|p| p.velocity[1]))];
        Ok(vec![
            Measured::absolute("rms profile error over v_max", profile / fastest()),
            Measured::absolute("rms v_y over v_max", across / fastest()),
        ])
    })
}

/// Velocity of paper Eq. 5 at a distance from the floor, m/s.
pub(crate) fn velocity(height: f64) -> f64 {
    PF[0] * G[0] / PF[2] * height * (LUMEN - 0.5 * height)
}

/// The largest of them, at the surface, m/s.
pub(crate) fn fastest() -> f64 {
    velocity(LUMEN)
}

/// Position (x, height over the floor) and velocity along the floor of each point of a run, over
/// the thickness and [`fastest`], for Fig. 4.
pub(crate) fn profile(run: &Run, n: u32, offset: f64) -> Result<Vec<([f64; 2], f64)>> {
    let low = floor(n, offset);
    let points = run.points()?;
    let spots = points.iter().map(|p| {
        let at = [p.at[0] / LUMEN, (p.at[1] - low) / LUMEN];
        (at, p.velocity[0] / fastest())
    });
    Ok(spots.collect())
}

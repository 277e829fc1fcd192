//! Plates with a slit between them dip into a pool: Jurin's height.

use super::wicking::TENSION;
use super::{LUMEN, Measured, Scene};
use crate::case_text::{Body, CaseText, PF};

/// 2 sigma/(rho g H) over H.
const HEIGHT: f64 = 1.5;
/// Time, in units of 3 eta H/sigma: the liquid comes to rest within a few.
const UNTIL: f64 = 40.0;

/// A slit of `n` cells (even), walls `offset` cells off the nodes.
pub fn scene(n: u32, offset: f64, degrees: f64) -> Scene {
    let h = LUMEN / f64::from(n);
    let (left, low) = (2.0 * LUMEN + offset * h, LUMEN);
    let (side, level) = (5.0 * LUMEN, 2.0 * LUMEN);
    let (before, right) = (left - 0.5 * LUMEN, left + LUMEN);
    let after = right + 0.5 * LUMEN;
    let plate = |from: f64, to: f64| Body::wall([from, low, 0.0], [to, side, h]);
    // The pool under the plates, and the three parts between and beside them.
    let pool = |from: f64, to: f64| Body::liquid([from, low, 0.0], [to, level, h]);
    let bodies = vec![
        plate(before, left),
        plate(right, after),
        Body::liquid([0.0; 3], [side, low, h]),
        pool(0.0, before),
        pool(left, right),
        pool(after, side),
    ];
    let pull = 2.0 * TENSION / (PF[0] * LUMEN * LUMEN * HEIGHT);
    let until = UNTIL * 3.0 * PF[2] * LUMEN / TENSION;
    let case = CaseText {
        title: format!(
            "A slit of {n} cells dips into a pool, contact angle {degrees} degrees.\nAgainst Jurin's height."
        ),
        bodies,
        gravity: [0.0, -pull, 0.0],
        wetting: Some([TENSION, degrees]),
        stop: Some(until),
        history_every: until / 100.0,
        ..CaseText::plane(h, [side, side])
    };
    let name = format!("jurin-n{n}-{degrees}deg-off{offset}");
    Scene::new(name, "2 sigma cos(theta)/(rho g H)", case, move |run| {
        let mut above = [0.0; 2];
        for p in run.points()?.iter().filter(|p| p.at[1] > low) {
            let inside = (left..right).contains(&p.at[0]);
            above[usize::from(inside)] += p.volume / h;
        }
        // Beside the plates, 3 H in all, menisci reach to their mirror images.
        let found = above[1] / LUMEN - above[0] / (3.0 * LUMEN);
        let exact = degrees.to_radians().cos() * (1.0 - 1.0 / 3.0) * HEIGHT * LUMEN;
        Ok(vec![Measured::relative("height", found, exact)])
    })
}

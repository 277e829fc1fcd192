//! Plates with a slit between them dip into a pool: Jurin's height.

use super::wicking::TENSION;
use super::{LUMEN, Measured, Scene, final_points};
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
    let plate = |x: f64| [x, x + 0.5 * LUMEN];
    let plates = [plate(left - 0.5 * LUMEN), plate(left + LUMEN)];
    let mut bodies: Vec<Body> = (plates.iter())
        .map(|x| Body::wall([x[0], low, 0.0], [x[1], side, h]))
        .collect();
    // The pool under the plates, and the three parts between and beside them.
    bodies.push(Body::liquid([0.0; 3], [side, low, h]));
    for [from, to] in [
        [0.0, plates[0][0]],
        [left, left + LUMEN],
        [plates[1][1], side],
    ] {
        bodies.push(Body::liquid([from, low, 0.0], [to, level, h]));
    }
    let pull = 2.0 * TENSION / (PF[0] * LUMEN * LUMEN * HEIGHT);
    let until = UNTIL * 3.0 * PF[2] * LUMEN / TENSION;
    let case = CaseText {
        bodies,
        gravity: [0.0, -pull, 0.0],
        wetting: Some([TENSION, degrees]),
        stop: Some(until),
        history_every: until / 100.0,
        ..CaseText::plane(
            format!(
                "A slit of {n} cells dips into a pool, contact angle {degrees} degrees.\nAgainst Jurin's height."
            ),
            h,
            [side, side],
        )
    };
    Scene {
        name: format!("jurin-n{n}-{degrees}deg-off{offset}"),
        case,
        against: "2 sigma cos(theta)/(rho g H)",
        measure: Box::new(move |run| {
            let file = run.last()?;
            let volume = file.column::<f32>("volume").map_err(|e| e.to_string())?;
            let mut above = [0.0; 2];
            for ((x, _), v) in final_points(run)?.iter().zip(volume) {
                if x[1] > low {
                    let inside = (left..left + LUMEN).contains(&x[0]);
                    above[usize::from(inside)] += f64::from(*v) / h;
                }
            }
            // Beside the plates, 3 H in all, menisci reach to their mirror images.
            let found = above[1] / LUMEN - above[0] / (3.0 * LUMEN);
            let exact = degrees.to_radians().cos() * (1.0 - 1.0 / 3.0) * HEIGHT * LUMEN;
            Ok(vec![Measured::relative("height", found, exact)])
        }),
    }
}

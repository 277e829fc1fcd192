//! Couette flow with partial slip: the speed of the liquid at the walls.

use super::{LUMEN, Measured, Scene, final_points, pressing};
use crate::case_text::{Body, CaseText, PF};
use crate::closed_forms::couette_slip;

const SPEED: f64 = 0.5;

/// A gap of `n` cells, lower wall `offset` cells off the nodes, influence length `slip` widths.
pub fn scene(n: u32, offset: f64, slip: f64, until: f64) -> Scene {
    let cell = LUMEN / f64::from(n);
    let (width, low) = (4.0 * cell, (2.0 + offset) * cell);
    let high = low + LUMEN;
    let top = (f64::from(n) + 5.0) * cell;
    let case = CaseText {
        contact: format!(
            "law = \"partial-slip\"\ninfluence_length = \"{} um\"\n",
            slip * LUMEN * 1e6
        ),
        boundary: ["periodic", "symmetry", "symmetry"],
        stop: Some(until),
        bodies: vec![
            Body::wall([0.0; 3], [width, low, cell]).named("bottom"),
            Body::wall([-1e-3, high, 0.0], [1e-3, top + cell, cell])
                .moving([SPEED, 0.0, 0.0])
                .pressing(pressing(until))
                .named("top"),
            Body::liquid([0.0, low, 0.0], [width, high, cell]),
        ],
        history_every: until / 20.0,
        ..CaseText::plane(
            format!(
                "Couette flow with partial slip, gap of {n} cells, walls {offset} cell off the nodes.\nAgainst v l/(H + 2 l) at the resting wall."
            ),
            cell,
            [width, top],
        )
    };
    Scene {
        name: format!("couette-n{n}-off{offset}-slip{slip}"),
        case,
        against: "Couette with Navier slip",
        measure: Box::new(move |run| {
            // Least-squares line through the middle half, read off at the resting wall: the
            // profile is straight, and what the wall does shows in it without the kernels of
            // the wall's own cells.
            let points: Vec<_> = final_points(run)?
                .iter()
                .map(|(x, v)| (x[1] - low, v[0]))
                .filter(|(y, _)| (0.25 * LUMEN..=0.75 * LUMEN).contains(y))
                .collect();
            let slip_speed = line_at_zero(&points);
            let exact = couette_slip(LUMEN, slip * LUMEN, SPEED);
            // Power over the wall's speed and area, which is exact where the law of the walls counts.
            let power = *run.history("viscous_power_W")?.last().unwrap_or(&f64::NAN);
            let mut list = vec![Measured::relative(
                "stress, from the power dissipated",
                power / (SPEED * width * cell),
                PF[2] * exact / (slip * LUMEN),
            )];
            // Three cells may have one row of points there.
            if slip_speed.is_finite() {
                list.insert(0, Measured::relative("slip velocity", slip_speed, exact));
            }
            Ok(list)
        }),
    }
}

fn line_at_zero(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let (sx, sy) = points
        .iter()
        .fold((0.0, 0.0), |s, p| (s.0 + p.0, s.1 + p.1));
    let (mx, my) = (sx / n, sy / n);
    let (sxx, sxy) = points.iter().fold((0.0, 0.0), |s, p| {
        (s.0 + (p.0 - mx).powi(2), s.1 + (p.0 - mx) * (p.1 - my))
    });
    my - mx * sxy / sxx
}

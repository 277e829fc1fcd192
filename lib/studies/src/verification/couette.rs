//! Couette flow with partial slip: the speed of the liquid at the walls.

use super::{LUMEN, Measured, Scene, pressing};
use crate::case_text::{Body, CaseText, PF, partial_slip};
use crate::closed_forms::couette_slip;
use crate::numbers::line_at_zero;

const SPEED: f64 = 0.5;

/// A gap of `n` cells, lower wall `offset` cells off the nodes, influence length `slip` widths.
pub fn scene(n: u32, offset: f64, slip: f64, until: f64) -> Scene {
    let cell = LUMEN / f64::from(n);
    let (width, low) = (4.0 * cell, (2.0 + offset) * cell);
    let high = low + LUMEN;
    let top = (f64::from(n) + 5.0) * cell;
    let case = CaseText {
        title: format!(
            "Couette flow with partial slip, gap of {n} cells, walls {offset} cell off the nodes.\nAgainst v l/(H + 2 l) at the resting wall."
        ),
        contact: partial_slip(&format!("{} um", slip * LUMEN * 1e6)),
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
        ..CaseText::plane(cell, [width, top])
    };
    let name = format!("couette-n{n}-off{offset}-slip{slip}");
    Scene::new(name, "Couette with Navier slip", case, move |run| {
        // Least-squares line through the middle half, read off at the resting wall: the
        // profile is straight, and what the wall does shows in it without the kernels of
        // the wall's own cells.
        let points = run.points()?;
        let points: Vec<_> = (points.iter().map(|p| (p.at[1] - low, p.velocity[0])))
            .filter(|(y, _)| (0.25 * LUMEN..=0.75 * LUMEN).contains(y))
            .collect();
        let exact = couette_slip(LUMEN, slip * LUMEN, SPEED);
        // Power over the wall's speed and area, which is exact where the law of the walls counts.
        let [power] = run.ends(["viscous_power_W"])?;
        let mut list = Vec::new();
        // Three cells may have one row of points there.
        if points
            .iter()
            .any(|(y, _)| (y - points[0].0).abs() > 0.01 * LUMEN)
        {
            let found = line_at_zero(&points);
            list.push(Measured::relative("slip velocity", found, exact));
        }
        list.push(Measured::relative(
            "stress, from the power dissipated",
            power / (SPEED * width * cell),
            PF[2] * exact / (slip * LUMEN),
        ));
        Ok(list)
    })
}

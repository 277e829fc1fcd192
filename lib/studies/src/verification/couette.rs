//! Couette flow with partial slip: the speed of the liquid at the walls.

use super::{LUMEN, Measured, Scene, channel};
use crate::case_text::{CaseText, PF};
use crate::numbers::line_at_zero;

const SPEED: f64 = 0.5;

/// A gap of `n` cells, lower wall `offset` cells off the nodes, influence length `slip` widths.
pub fn scene(n: u32, offset: f64, slip: f64, until: f64) -> Scene {
    let mut case = CaseText {
        title: format!(
            "Couette flow with partial slip, gap of {n} cells, walls {offset} cell off the nodes.\nAgainst v l/(H + 2 l) at the resting wall."
        ),
        gravity: [0.0; 3],
        ..channel::scene(n, offset, Some(slip), until).case
    };
    let (low, area) = (case.bodies[0].max[1], case.size[0] * case.cell);
    case.bodies[0] = case.bodies[0].clone().named("bottom");
    let upper = &mut case.bodies[1];
    (upper.min[0], upper.max[0]) = (-1e-3, 1e-3);
    *upper = upper.clone().moving([SPEED, 0.0, 0.0]);
    let name = format!("couette-n{n}-off{offset}-slip{slip}");
    Scene::new(name, "Couette with Navier slip", case, move |run| {
        // Least-squares line through the middle half, read off at the resting wall: the
        // profile is straight, and what the wall does shows in it without the kernels of
        // the wall's own cells.
        let points = run.points()?;
        let points: Vec<_> = (points.iter().map(|p| (p.at[1] - low, p.velocity[0])))
            .filter(|(y, _)| (0.25 * LUMEN..=0.75 * LUMEN).contains(y))
            .collect();
        let length = slip * LUMEN;
        let exact = SPEED * length / (LUMEN + 2.0 * length);
        // Power over the wall's speed and area, which is exact where the law of the walls counts.
        let [power] = run.ends(["viscous_power_W"])?;
        let mut list = Vec::new();
        // Three cells may have one row of points there.
        let apart = |(y, _): &(f64, f64)| (y - points[0].0).abs() > 0.01 * LUMEN;
        if points.iter().any(apart) {
            let found = line_at_zero(&points);
            list.push(Measured::relative("slip velocity", found, exact));
        }
        list.push(Measured::relative(
            "stress, from the power dissipated",
            power / (SPEED * area),
            PF[2] * exact / length,
        ));
        Ok(list)
    })
}

//! Plane Poiseuille flow between walls at any offset, driven by a body force along a
//! periodic channel.

use super::{LUMEN, Measured, Scene, mean_against, pressing};
use crate::case_text::{Body, CaseText, PF, STICK, partial_slip};
use crate::numbers::{line, worst};

/// Body force per mass, m/s2: a mean velocity near 0.02 m/s.
const G: f64 = 2.3e5;

/// A channel of `n` cells, its lower wall `offset` cells off the nodes; `slip` is the
/// influence length over the width, `None` for sticking walls.
pub fn scene(n: u32, offset: f64, slip: Option<f64>, until: f64) -> Scene {
    let cell = LUMEN / f64::from(n);
    let (width, low) = (4.0 * cell, (2.0 + offset) * cell);
    let high = low + LUMEN;
    let top = (f64::from(n) + 5.0) * cell;
    let case = CaseText {
        title: format!(
            "Plane Poiseuille flow in a channel of {n} cells, walls {offset} cell off the nodes.\nAgainst rho g (y (H - y) + H/k)/(2 eta)."
        ),
        contact: slip.map_or(STICK.to_owned(), |l| {
            partial_slip(&format!("{} um", l * LUMEN * 1e6))
        }),
        gravity: [G, 0.0, 0.0],
        boundary: ["periodic", "symmetry", "symmetry"],
        stop: Some(until),
        bodies: vec![
            Body::wall([0.0; 3], [width, low, cell]),
            Body::wall([0.0, high, 0.0], [width, top + cell, cell])
                .pressing(pressing(until))
                .named("top"),
            Body::liquid([0.0, low, 0.0], [width, high, cell]),
        ],
        history_every: until / 20.0,
        ..CaseText::plane(cell, [width, top])
    };
    let walls = slip.map_or(String::new(), |s| format!("-slip{s}"));
    let name = format!("channel-n{n}-off{offset}{walls}");
    Scene::new(name, "plane Poiseuille", case, move |run| {
        let slip = slip.unwrap_or(0.0) * LUMEN;
        // Plane Poiseuille flow with Navier slip.
        let unit = PF[0] * G / (2.0 * PF[2]);
        let exact = |y: f64| unit * (y * (LUMEN - y) + LUMEN * slip);
        let points = run.points()?;
        let fastest = exact(0.5 * LUMEN);
        let off = points.iter().map(|p| p.velocity[0] - exact(p.at[1] - low));
        let worst = worst(off.map(|off| off / fastest)).unwrap_or(f64::NAN);
        Ok(vec![
            mean_against(run, low, exact)?,
            Measured::absolute("worst point, over the fastest", worst),
        ])
    })
}

/// Speed of the upper wall of a Couette flow, m/s.
const WALL: f64 = 0.5;

/// Couette flow with partial slip: the speed of the liquid at the walls. A gap of `n` cells, lower wall `offset` cells off the nodes, influence length `slip` widths.
pub fn couette_scene(n: u32, offset: f64, slip: f64, until: f64) -> Scene {
    let mut case = CaseText {
        title: format!(
            "Couette flow with partial slip, gap of {n} cells, walls {offset} cell off the nodes.\nAgainst v l/(H + 2 l) at the resting wall."
        ),
        gravity: [0.0; 3],
        ..scene(n, offset, Some(slip), until).case
    };
    let (low, area) = (case.bodies[0].max[1], case.size[0] * case.cell);
    case.bodies[0] = case.bodies[0].clone().named("bottom");
    let upper = &mut case.bodies[1];
    (upper.min[0], upper.max[0]) = (-1e-3, 1e-3);
    *upper = upper.clone().moving([WALL, 0.0, 0.0]);
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
        let exact = WALL * length / (LUMEN + 2.0 * length);
        // Power over the wall's speed and area, which is exact where the law of the walls counts.
        let [power] = run.ends(["viscous_power_W"])?;
        let mut list = Vec::new();
        // Three cells may have one row of points there.
        let apart = |(y, _): &(f64, f64)| (y - points[0].0).abs() > 0.01 * LUMEN;
        if points.iter().any(apart) {
            let [found, _] = line(&points);
            list.push(Measured::relative("slip velocity", found, exact));
        }
        list.push(Measured::relative(
            "stress, from the power dissipated",
            power / (WALL * area),
            PF[2] * exact / length,
        ));
        Ok(list)
    })
}

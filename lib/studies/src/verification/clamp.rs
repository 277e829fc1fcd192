//! Load control: a squeeze film whose force runs into the pressure limit, held there, then
//! closed to the end.

use super::squeeze::plates;
use super::{Measured, Scene};
use crate::case_text::{Body, CaseText};
use crate::numbers::largest;

const CELL: f64 = 2.9e-6;
/// Closing speed, m/s.
const SPEED: f64 = 1.0;
/// Pressure limit, Pa.
const LIMIT: f64 = 2.5e6;

/// A film of half-length 16 cells from a gap of 8 cells by `travel` cells.
pub fn scene(travel: f64) -> Scene {
    let (low, gap, half) = (2.0 * CELL, 8.0 * CELL, 16.0 * CELL);
    let (right, top) = (half + 24.0 * CELL, low + gap + 2.0 * CELL);
    let limit = LIMIT * half / right;
    let case = CaseText {
        title: format!(
            "A squeeze film closed by {travel} cells under a pressure limit.\nAgainst the limit, the closing speed and the travel."
        ),
        clamp: Some(format!(
            "closing_speed = \"{SPEED} m/s\"\nmax_pressure = \"{limit} Pa\"\nstop = \"closed\"\ntravel = \"{:.6} um\"\n",
            travel * CELL * 1e6
        )),
        bodies: plates(
            [right, CELL],
            [low, low + gap, top + 8.0 * CELL],
            Body::clamped,
        )
        .chain([Body::liquid([0.0, low, 0.0], [half, low + gap, CELL])])
        .collect(),
        history_every: 0.02e-6,
        ..CaseText::plane(CELL, [right, top])
    };
    let name = format!("clamp-travel{travel}");
    Scene::new(name, "settings of the clamp", case, move |run| {
        let [pressure, speed] = run.columns(["pressure_top_Pa", "closing_speed_m_s"])?;
        let [end] = run.ends(["displacement_m"])?;
        let over = (largest(pressure.iter().copied()) / limit - 1.0).max(0.0);
        let mut list = vec![Measured::absolute("overshoot over the limit", over)];
        // Held from the second microsecond after the limit was met on.
        if let Some(met) = pressure.iter().position(|&p| p >= 0.98 * limit) {
            let held = &pressure[(met + 100).min(pressure.len() - 1)..];
            let worst = largest(held.iter().map(|p| (p / limit - 1.0).abs()));
            let what = "worst error of the pressure held";
            list.push(Measured::absolute(what, worst));
        }
        let wrong = largest(speed.iter().map(|v| (-v).max(v - SPEED)));
        list.push(Measured::absolute("speed outside 0 to 1 m/s", wrong));
        list.push(Measured::relative("travel at the end", end, travel * CELL));
        Ok(list)
    })
}

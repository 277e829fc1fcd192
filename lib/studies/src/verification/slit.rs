//! A piston pushes liquid from a reservoir, four slit widths wide, into a slit: the mission's
//! own flow; at constant speed and at constant pressure. Against finite elements behind a tracked front (lib/studies/reference).

use super::{LUMEN, Measured, Scene};
use crate::Result;
use crate::case_text::{Body, CaseText, PF};
use crate::numbers::{at_middle, crossing};
use crate::outputs::Run;

/// Piston speed, m/s; the slit is a quarter of the reservoir, so it flows four times faster.
const SPEED: f64 = 0.5;

/// Filled length in slit widths and the equivalent length that piston, entrance and moving front
/// add to it in the piston force, less what the liquid's compression takes, for a piston whose
/// sides give way over 1/24 H (lib/studies/reference/slit-filling.csv).
const ENTRANCE: [(f64, f64); 4] = [(1.0, 0.246), (2.0, 0.235), (3.0, 0.260), (4.0, 0.346)];

/// More of it each time that length is divided by e: the force of a piston on liquid that sticks
/// to its sides has no limit, since both corners are Taylor's scraper (pressure as 1/r).
const CORNER: f64 = 0.0223;

/// Width of the reservoir, m.
const WIDTH: f64 = 4.0 * LUMEN;

/// Edge (m) along x of the domain of a reservoir in cells of `h` (m).
pub(super) fn domain(h: f64) -> f64 {
    WIDTH + 6.0 * h
}

/// A reservoir from `x0` on whose piston comes from above, in cells of `h`; the slit leads down from its
/// `shoulder`, as in a clamped bond line. The piston, `driven`, goes on `above` the domain. All m.
pub(super) fn reservoir(
    h: f64,
    [x0, shoulder, piston]: [f64; 3],
    above: f64,
    driven: fn(Body) -> Body,
) -> CaseText {
    let (x1, right, top) = (x0 + WIDTH, domain(h), piston + 3.0 * h);
    let slit = [0.5 * WIDTH - 0.5 * LUMEN, 0.5 * WIDTH + 0.5 * LUMEN].map(|x| x0 + x);
    let wall = |[x, y]: [f64; 2], [to_x, to_y]: [f64; 2]| {
        Body::wall([x, y, 0.0], [to_x, to_y, h]).named("bottom")
    };
    CaseText {
        bodies: vec![
            wall([0.0, 0.0], [x0, top]),
            wall([x1, 0.0], [right, top]),
            wall([x0, 0.0], [slit[0], shoulder]),
            wall([slit[1], 0.0], [x1, shoulder]),
            driven(wall([x0, piston], [x1, top + above]).named("top")),
            Body::liquid([x0, shoulder, 0.0], [x1, piston, h]),
        ],
        history_every: 0.05e-6,
        ..CaseText::plane(h, [right, top])
    }
}

/// Slit of `n` cells, walls offset by `offset` cells along x and y.
pub fn scene(n: u32, offset: [f64; 2]) -> Scene {
    let h = LUMEN / f64::from(n);
    let [aside, up] = offset;
    let shoulder = 7.0 * LUMEN + 2.0 * h;
    let piston = shoulder + 2.0 * LUMEN + up * h;
    let case = CaseText {
        title: format!(
            "A piston pushes liquid from a reservoir into a slit of {n} cells, walls ({aside}, {up}) cell off the nodes."
        ),
        stop: Some(0.55 * 2.0 * LUMEN / SPEED),
        ..reservoir(h, [(2.0 + aside) * h, shoulder, piston], LUMEN, |piston| {
            piston.moving([0.0, -SPEED, 0.0])
        })
    };
    let name = format!("slit-n{n}-off{aside}-{up}");
    Scene::new(name, "finite elements", case, move |run| {
        let (filled, force): (Vec<f64>, Vec<f64>) =
            curve(run, n)?.iter().map(|p| (p[0], p[1])).unzip();
        let mut list = Vec::new();
        for [length, exact] in reference(n) {
            if let Some(f) = at_middle(&filled, &force, length - 0.25, length + 0.25) {
                let what = format!("piston force at L = {length} H");
                list.push(Measured::relative(what, f, exact));
            }
        }
        let time = run.summary("time_s").unwrap_or(f64::NAN);
        let room = (piston - SPEED * time - shoulder) * WIDTH * h;
        let points = run.points()?;
        let above = points.iter().filter(|p| p.at[1] > shoulder);
        let dense = above.map(|p| p.volume).sum::<f64>() / room - 1.0;
        list.push(Measured::absolute("density in the reservoir", dense));
        Ok(list)
    })
}

/// Filled length in slit widths and force on the piston over that of one filled width, row by
/// row of the history of a run with `n` cells.
pub(super) fn curve(run: &Run, n: u32) -> Result<Vec<[f64; 2]>> {
    let time = run.history("time_s")?;
    let pressure = run.history("pressure_top_Pa")?;
    // History pressures refer to the whole cross-section of the domain.
    let section = (4.0 * f64::from(n) + 6.0) / (4.0 * f64::from(n));
    let unit = 12.0 * PF[2] * 4.0 * SPEED / LUMEN;
    let row = |(t, p): (&f64, &f64)| [4.0 * SPEED * t / LUMEN, p * section / unit];
    Ok(time.iter().zip(&pressure).map(row).collect())
}

/// What the corners of the piston add where its sides give way over one of `n` cells.
fn corner(n: u32) -> f64 {
    CORNER * (f64::from(n) / 24.0).ln()
}

/// Filled lengths and forces of the reference for `n` cells.
pub(super) fn reference(n: u32) -> [[f64; 2]; 4] {
    ENTRANCE.map(|(length, more)| [length, length + more + corner(n)])
}

/// Piston pressure, Pa.
const PRESSURE: f64 = 1e6;

/// Time to fill five widths in units of 12 eta/p by finite elements (lib/studies/reference) for a
/// piston whose sides give way over 1/24 H.
const TIME_TO_FIVE: f64 = 13.87;

/// Equivalent length of entrance and front over the width in `n` cells, from that time.
pub(super) fn entrance(n: u32) -> f64 {
    (TIME_TO_FIVE - 12.5) / 5.0 + corner(n)
}

/// Lines of `[clamp]` that hold the piston of a reservoir in cells of `h` (m) at a pressure (Pa), for a time (s).
pub(super) fn held(h: f64, pressure: f64, time: f64) -> String {
    let limit = pressure * 4.0 * LUMEN / domain(h);
    let (stop, travel) = (time * 1e6, 2.0 * LUMEN * 1e6);
    format!(
        "closing_speed = \"20 m/s\"\nmax_pressure = \"{limit} Pa\"\nstop = \"{stop} us\"\ntravel = \"{travel} um\"\n"
    )
}

/// Filled at constant pressure: slit of `n` cells, walls `offset` cells off the nodes along x.
pub(super) fn filled_scene(n: u32, offset: f64) -> Scene {
    let h = LUMEN / f64::from(n);
    let shoulder = 8.0 * LUMEN + 2.0 * h;
    let places = [(2.0 + offset) * h, shoulder, shoulder + 2.5 * LUMEN];
    let unit = 12.0 * PF[2] / PRESSURE;
    let case = CaseText {
        title: format!(
            "A slit of {n} cells filled at constant pressure, walls {offset} cell off the nodes.\nAgainst Washburn's law with entrance correction."
        ),
        clamp: Some(held(h, PRESSURE, 20.0 * 12.0 * PF[2] / PRESSURE)),
        ..reservoir(h, places, 4.0 * LUMEN, Body::clamped)
    };
    let name = format!("washburn-n{n}-off{offset}");
    Scene::new(name, "finite elements", case, move |run| {
        let [time, travel] = run.columns(["time_s", "displacement_m"])?;
        let found = crossing(&travel, &time, 5.0 * LUMEN / 4.0);
        let found = found.ok_or("the slit was not filled to five widths")? / unit;
        let reference = TIME_TO_FIVE + 5.0 * corner(n);
        // L grows with the square root of time, so its error is half that of the time.
        let length_error = (reference / found).sqrt() - 1.0;
        Ok(vec![
            Measured::relative("time to L = 5 H", found, reference),
            Measured::absolute("L(t) at that time, relative", length_error),
        ])
    })
}

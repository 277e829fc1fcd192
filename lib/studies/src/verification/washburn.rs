//! Filling a slit from a reservoir at constant pressure.

use super::{LUMEN, Measured, Scene, slit};
use crate::case_text::{Body, CaseText, PF};
use crate::numbers::crossing;

/// Piston pressure, Pa.
const PRESSURE: f64 = 1e6;

/// Time to fill five widths in units of 12 eta/p by finite elements (lib/studies/reference) for a
/// piston whose sides give way over 1/24 H.
const TIME_TO_FIVE: f64 = 13.87;

/// Equivalent length of entrance and front over the width in `n` cells, from that time.
pub(super) fn entrance(n: u32) -> f64 {
    (TIME_TO_FIVE - 12.5) / 5.0 + slit::corner(n)
}

/// Lines of `[clamp]` that hold the piston of a reservoir in cells of `h` (m) at a pressure (Pa), for a time (s).
pub(super) fn held(h: f64, pressure: f64, time: f64) -> String {
    let limit = pressure * 4.0 * LUMEN / slit::domain(h);
    let (stop, travel) = (time * 1e6, 2.0 * LUMEN * 1e6);
    format!(
        "closing_speed = \"20 m/s\"\nmax_pressure = \"{limit} Pa\"\nstop = \"{stop} us\"\ntravel = \"{travel} um\"\n"
    )
}

/// Slit of `n` cells, walls `offset` cells off the nodes along x.
pub(super) fn scene(n: u32, offset: f64) -> Scene {
    let h = LUMEN / f64::from(n);
    let shoulder = 8.0 * LUMEN + 2.0 * h;
    let places = [(2.0 + offset) * h, shoulder, shoulder + 2.5 * LUMEN];
    let unit = 12.0 * PF[2] / PRESSURE;
    let case = CaseText {
        title: format!(
            "A slit of {n} cells filled at constant pressure, walls {offset} cell off the nodes.\nAgainst Washburn's law with entrance correction."
        ),
        clamp: Some(held(h, PRESSURE, 20.0 * 12.0 * PF[2] / PRESSURE)),
        ..slit::reservoir(h, places, 4.0 * LUMEN, Body::clamped)
    };
    let name = format!("washburn-n{n}-off{offset}");
    Scene::new(name, "finite elements", case, move |run| {
        let [time, travel] = run.columns(["time_s", "displacement_m"])?;
        let found = crossing(&travel, &time, 5.0 * LUMEN / 4.0);
        let found = found.ok_or("the slit was not filled to five widths")? / unit;
        let reference = TIME_TO_FIVE + 5.0 * slit::corner(n);
        // L grows with the square root of time, so its error is half that of the time.
        let length_error = (reference / found).sqrt() - 1.0;
        Ok(vec![
            Measured::relative("time to L = 5 H", found, reference),
            Measured::absolute("L(t) at that time, relative", length_error),
        ])
    })
}

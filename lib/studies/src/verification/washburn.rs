//! Filling a slit from a reservoir at constant pressure.

use super::{LUMEN, Measured, Scene, slit};
use crate::case_text::{Body, CaseText, PF};

/// Piston pressure, Pa.
const PRESSURE: f64 = 1e6;

/// Time to fill five widths in units of 12 eta/p by finite elements (lib/studies/reference) for a
/// piston whose sides give way over 1/24 H.
pub(super) const TIME_TO_FIVE: f64 = 13.87;

/// Slit of `n` cells, walls `offset` cells off the nodes along x.
pub fn scene(n: u32, offset: f64) -> Scene {
    let h = LUMEN / f64::from(n);
    let (x0, width) = ((2.0 + offset) * h, 4.0 * LUMEN);
    let (centre, half) = (x0 + 0.5 * width, 0.5 * LUMEN);
    let right = width + 6.0 * h;
    let shoulder = 8.0 * LUMEN + 2.0 * h;
    let piston = shoulder + 2.5 * LUMEN;
    let top = piston + 3.0 * h;
    let limit = PRESSURE * width / right;
    let case = CaseText {
        clamp: Some(format!(
            "closing_speed = \"20 m/s\"\nmax_pressure = \"{limit} Pa\"\nstop = \"{} us\"\ntravel = \"{} um\"\n",
            20.0 * 12.0 * PF[2] / PRESSURE * 1e6,
            2.0 * LUMEN * 1e6
        )),
        bodies: vec![
            Body::wall([0.0, 0.0, 0.0], [x0, top, h]).named("bottom"),
            Body::wall([x0 + width, 0.0, 0.0], [right, top, h]).named("bottom"),
            Body::wall([x0, 0.0, 0.0], [centre - half, shoulder, h]).named("bottom"),
            Body::wall([centre + half, 0.0, 0.0], [x0 + width, shoulder, h]).named("bottom"),
            Body::wall([x0, piston, 0.0], [x0 + width, top + 4.0 * LUMEN, h])
                .clamped()
                .named("top"),
            Body::liquid([x0, shoulder, 0.0], [x0 + width, piston, h]),
        ],
        history_every: 0.05e-6,
        ..CaseText::new(
            format!(
                "A slit of {n} cells filled at constant pressure, walls {offset} cell off the nodes.\nAgainst Washburn's law with entrance correction."
            ),
            h,
            2,
            [right, top, h],
        )
    };
    Scene {
        name: format!("washburn-n{n}-off{offset}"),
        case,
        against: "finite elements",
        measure: Box::new(move |run| {
            let time = run.history("time_s")?;
            let travel = run.history("displacement_m")?;
            let goal = 5.0 * LUMEN / 4.0;
            let i = travel
                .iter()
                .position(|&s| s >= goal)
                .filter(|&i| i > 0)
                .ok_or("the slit was not filled to five widths")?;
            let part = (goal - travel[i - 1]) / (travel[i] - travel[i - 1]);
            let t = time[i - 1] + part * (time[i] - time[i - 1]);
            let unit = 12.0 * PF[2] / PRESSURE;
            let reference = TIME_TO_FIVE + 5.0 * slit::corner(n);
            // L grows with the square root of time, so its error is half that of the time.
            let mut list = vec![Measured::relative("time to L = 5 H", t / unit, reference)];
            let length_error = (reference / (t / unit)).sqrt() - 1.0;
            list.push(Measured::absolute(
                "L(t) at that time, relative",
                length_error,
            ));
            Ok(list)
        }),
    }
}

//! Filling a slit whose end is closed: the air in it is compressed, and holds the liquid where Boyle's law says.

use super::{LUMEN, Measured, Scene, slit, washburn};
use crate::case_text::{Body, CaseText, PF};

/// Piston pressure over that outside, and the absolute pressure there, Pa.
const PRESSURE: f64 = 4e5;
const OUTSIDE: f64 = 1e5;
/// Length of the slit, in widths.
const LENGTH: f64 = 8.0;
/// Unit of time: in it a length of sqrt 2 widths is filled without air or entrance, s.
const UNIT: f64 = 12.0 * PF[2] / PRESSURE;

/// A slit of `n` cells; `leak_time` in units of [`UNIT`] where its air leaks.
pub fn scene(n: u32, leak_time: Option<f64>) -> Scene {
    let h = LUMEN / f64::from(n);
    let (x0, width) = (2.0 * h, 4.0 * LUMEN);
    let (centre, half) = (x0 + 0.5 * width, 0.5 * LUMEN);
    let right = width + 6.0 * h;
    let shoulder = LENGTH * LUMEN + 2.0 * h;
    // As deep under the piston as the reservoir is wide, at the end a quarter less than at the start.
    let piston = shoulder + 4.5 * LUMEN;
    let top = piston + 3.0 * h;
    let until = leak_time.map_or(150.0, |_| 60.0);
    let leak = leak_time.map_or(String::new(), |time| {
        format!("leak_time = \"{} s\"\n", time * UNIT)
    });
    let case = CaseText {
        clamp: Some(format!(
            "closing_speed = \"20 m/s\"\nmax_pressure = \"{} Pa\"\nstop = \"{} us\"\ntravel = \"{} um\"\n",
            PRESSURE * width / right,
            until * UNIT * 1e6,
            2.0 * LUMEN * 1e6
        )),
        air: Some(format!("pressure = \"{OUTSIDE} Pa\"\n{leak}")),
        bodies: vec![
            Body::wall([0.0, 0.0, 0.0], [x0, top, h]).named("bottom"),
            Body::wall([x0 + width, 0.0, 0.0], [right, top, h]).named("bottom"),
            Body::wall([x0, 0.0, 0.0], [centre - half, shoulder, h]).named("bottom"),
            Body::wall([centre + half, 0.0, 0.0], [x0 + width, shoulder, h]).named("bottom"),
            // The end: with a clamp the side of the domain there would be open to air.
            Body::wall([centre - half, 0.0, 0.0], [centre + half, 2.0 * h, h]).named("bottom"),
            Body::wall([x0, piston, 0.0], [x0 + width, top + 4.0 * LUMEN, h])
                .clamped()
                .named("top"),
            Body::liquid([x0, shoulder, 0.0], [x0 + width, piston, h]),
        ],
        history_every: UNIT / 100.0,
        ..CaseText::new(
            "A slit with a closed end filled at constant pressure.\nAgainst Boyle's law and Washburn's with entrance.",
            h,
            2,
            [right, top, h],
        )
    };
    let name = leak_time.map_or("tight", |_| "leak");
    Scene {
        name: format!("air-n{n}-{name}"),
        case,
        against: "Boyle",
        measure: Box::new(move |run| {
            let entrance = (washburn::TIME_TO_FIVE - 12.5) / 5.0 + slit::corner(n);
            let (times, travel) = (run.history("time_s")?, run.history("displacement_m")?);
            let filled: Vec<f64> = travel.iter().map(|s| 4.0 * s / LUMEN).collect();
            let first = filled.iter().position(|&l| l >= 1.0);
            let first = first.ok_or("it was not filled to one width")?;
            let mut column = Column {
                filled: filled[first],
                air: LENGTH,
                entrance,
                leak_time,
            };
            let mut worst: f64 = 0.0;
            for i in first + 1..times.len() {
                column.advance((times[i] - times[i - 1]) / UNIT);
                let error = filled[i] / column.filled - 1.0;
                worst = if error.abs() > worst.abs() {
                    error
                } else {
                    worst
                };
            }
            let last = filled[filled.len() - 1];
            let mut list = vec![
                Measured::absolute("L(t) from L = d on, worst", worst),
                Measured::relative("L at the end", last, column.filled),
            ];
            if leak_time.is_none() {
                let boyle = LENGTH * PRESSURE / (PRESSURE + OUTSIDE);
                list.push(Measured::relative("L at the end, Boyle", last, boyle));
            }
            Ok(list)
        }),
    }
}

/// Liquid and air in the slit, lengths in its widths, times in [`UNIT`].
#[derive(Clone, Copy)]
struct Column {
    /// Length of the liquid.
    filled: f64,
    /// Length that the air had outside.
    air: f64,
    /// Equivalent length of entrance and front.
    entrance: f64,
    leak_time: Option<f64>,
}

impl Column {
    /// dL/dt = (1 - (p - p_0)/P)/(L + e) and dm/dt = -(p/p_0 - 1) (L_0 - L)/t_leak, p/p_0 = m/(L_0 - L).
    fn rates(self) -> [f64; 2] {
        let rest = LENGTH - self.filled;
        let excess = self.air / rest - 1.0;
        let speed = (1.0 - excess * OUTSIDE / PRESSURE) / (self.filled + self.entrance);
        [
            speed,
            self.leak_time.map_or(0.0, |time| -excess * rest / time),
        ]
    }

    fn after(self, [speed, loss]: [f64; 2], time: f64) -> Self {
        Self {
            filled: self.filled + time * speed,
            air: self.air + time * loss,
            ..self
        }
    }

    /// By the midpoint rule, in parts of a thousandth of the unit.
    fn advance(&mut self, time: f64) {
        let parts = (1e3 * time).ceil().max(1.0);
        for _ in 0..parts as u64 {
            let middle = self.after(self.rates(), 0.5 * time / parts);
            *self = self.after(middle.rates(), time / parts);
        }
    }
}

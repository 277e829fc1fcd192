//! Filling a slit whose end is closed: the air in it is compressed, and holds the liquid where Boyle's law says.

use super::{LUMEN, Measured, Scene, slit};
use crate::case_text::{Body, CaseText, PF};
use crate::numbers::worst;

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
    let x0 = 2.0 * h;
    let shoulder = LENGTH * LUMEN + 2.0 * h;
    // As deep under the piston as the reservoir is wide, at the end a quarter less than at the start.
    let places = [x0, shoulder, shoulder + 4.5 * LUMEN];
    let until = leak_time.map_or(150.0, |_| 60.0);
    let leak = leak_time.map_or(String::new(), |time| {
        format!("leak_time = \"{} s\"\n", time * UNIT)
    });
    let mut case = CaseText {
        title: "A slit with a closed end filled at constant pressure.\nAgainst Boyle's law and Washburn's with entrance.".into(),
        clamp: Some(slit::held(h, PRESSURE, until * UNIT)),
        air: Some(format!("pressure = \"{OUTSIDE} Pa\"\n{leak}")),
        history_every: UNIT / 100.0,
        ..slit::reservoir(h, places, 4.0 * LUMEN, Body::clamped)
    };
    // The end: with a clamp the side of the domain there would be open to air.
    let end = [x0 + 1.5 * LUMEN, x0 + 2.5 * LUMEN];
    let end = Body::wall([end[0], 0.0, 0.0], [end[1], 2.0 * h, h]);
    case.bodies.insert(4, end.named("bottom"));
    let name = format!("air-n{n}-{}", leak_time.map_or("tight", |_| "leak"));
    Scene::new(name, "Boyle", case, move |run| {
        let [times, travel] = run.columns(["time_s", "displacement_m"])?;
        let filled: Vec<f64> = travel.iter().map(|s| 4.0 * s / LUMEN).collect();
        let first = filled.iter().position(|&l| l >= 1.0);
        let first = first.ok_or("it was not filled to one width")?;
        let mut column = Column {
            filled: filled[first],
            air: LENGTH,
            entrance: slit::entrance(n),
            leak_time,
        };
        let errors = (first + 1..times.len()).map(|i| {
            column.advance((times[i] - times[i - 1]) / UNIT);
            filled[i] / column.filled - 1.0
        });
        let worst = worst(errors).unwrap_or(0.0);
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
    })
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
        let loss = self.leak_time.map_or(0.0, |time| excess * rest / time);
        [speed, -loss]
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

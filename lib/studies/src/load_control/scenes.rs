//! The scenes: films, lumens and blocks that a clamp presses on at a pressure limit.

use crate::case_text::{CaseText, Viscosity};
use crate::lines::{self, Values};
use crate::press::Press;

/// Edge of a cell, m.
pub(super) const CELL: f64 = 2e-6;
/// Closing speed, m/s.
const SPEED: f64 = 1.0;

/// A press by its name in tables.
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    pub(super) name: &'static str,
    pub(super) press: Press,
}

/// The presses of shapes.txt.
pub fn shapes() -> Vec<Shape> {
    lines::read(include_str!("shapes.txt"), |line| {
        let (name, words) = line.split_once(" | ")?;
        let shape = |of: Values| {
            let n = |key| of.number(key);
            let off = n("off")?;
            let press = Press {
                width: n("width")?,
                liquid: [n("from")?, n("to")?],
                slab: n("slab")?,
                air: n("air")?,
                floors: [2.0 + off, 10.0 + off],
                lumen: n("lumen").zip(n("end")).map(|(from, to)| [from, to]),
                travel: n("travel")?,
                depth: [n("deep")?, n("wet")?],
            };
            of.stray().is_none().then_some(Shape { name, press })
        };
        Values::all(words).into_iter().map(shape).collect()
    })
}

impl Shape {
    /// Distance between the plates at the start, m.
    pub(super) fn gap(&self) -> f64 {
        (self.press.slab + self.press.air) * CELL
    }

    /// Way of the clamp, m.
    pub(super) fn way(&self) -> f64 {
        self.press.travel * CELL
    }

    /// Whether the upper plate touches the liquid from the start.
    pub(super) fn touches(&self) -> bool {
        self.press.air == 0.0
    }

    /// The case for a liquid of `viscosity` (Pa s) under a limit of `pressure` (Pa).
    pub(super) fn case(&self, pressure: f64, viscosity: f64) -> CaseText {
        // The slowest takes some hundred times the viscosity over the pressure.
        let limit = 20.0 * self.way() / SPEED + 2000.0 * viscosity / pressure;
        let (travel, limit) = (self.way() * 1e6, limit * 1e6);
        CaseText {
            title: format!("{}: a press at a pressure limit.", self.name),
            viscosity: Viscosity::Newtonian(viscosity),
            clamp: Some(format!(
                "closing_speed = \"{SPEED} m/s\"\nmax_pressure = \"{pressure} Pa\"\ntravel = \"{travel} um\"\ntime_limit = \"{limit} us\"\n"
            )),
            // A row for every step.
            history_every: 1e-15,
            ..self.press.case(CELL)
        }
    }
}

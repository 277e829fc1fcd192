//! Wall time of each part of a step.

use std::cell::Cell;
use std::time::{Duration, Instant};

use physics::StageTime;

/// Parts of a step whose time is reported, in its order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stage {
    Geometry,
    Water,
    Viscosity,
    Assembly,
    Solve,
    Forces,
    Transport,
}

const NAMES: [&str; 7] = [
    "geometry",
    "loss of water",
    "viscosity",
    "assembly",
    "linear solve",
    "forces",
    "transport",
];

/// Wall time of each part so far.
#[derive(Debug, Default)]
pub(crate) struct Clock([Cell<Duration>; 7]);

impl Clock {
    /// Adds the time since `begun` to a part.
    pub(crate) fn add(&self, part: Stage, begun: Instant) {
        let time = &self.0[part as usize];
        time.set(time.get() + begun.elapsed());
    }

    /// Times of the parts; the loss of water is one where the liquid holds `water`.
    pub(crate) fn report(&self, water: bool) -> Vec<StageTime> {
        (NAMES.into_iter().zip(&self.0))
            .filter(|(name, _)| water || *name != NAMES[Stage::Water as usize])
            .map(|(name, time)| StageTime {
                name,
                wall_s: time.get().as_secs_f64(),
            })
            .collect()
    }
}

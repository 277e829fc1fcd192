//! Wall time of each part of a step.

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

/// Time spent so far.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Clock([Duration; 7]);

impl Clock {
    /// Counts what a part took that began at an instant.
    pub(crate) fn add(&mut self, part: Stage, begun: Instant) {
        self.0[part as usize] += begun.elapsed();
    }

    /// Times of the parts, but for those that a run is `without`.
    pub(crate) fn report(&self, without: &[Stage]) -> Vec<StageTime> {
        let times = NAMES.iter().zip(&self.0).enumerate();
        times
            .filter(|(part, _)| !without.iter().any(|without| *without as usize == *part))
            .map(|(_, time)| time)
            .map(|(&name, time)| StageTime {
                name,
                wall_s: time.as_secs_f64(),
            })
            .collect()
    }
}

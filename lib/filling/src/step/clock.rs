//! Wall time of each part of the step.

use std::time::{Duration, Instant};

use physics::StageTime;

/// Parts of a step whose time is reported, in its order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    Geometry,
    Fractions,
    Water,
    Assembly,
    Solve,
    Forces,
    Advection,
    Density,
}

const NAMES: [&str; 8] = [
    "geometry",
    "liquid fractions",
    "loss of water",
    "assembly",
    "linear solve",
    "forces",
    "advection",
    "density projection",
];

/// Time spent so far.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Clock([Duration; 8]);

impl Clock {
    /// Runs `work` and counts its time.
    pub(super) fn time<T>(&mut self, part: Part, work: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = work();
        self.0[part as usize] += start.elapsed();
        result
    }

    pub(super) fn report(&self) -> Vec<StageTime> {
        let skipped =
            |part: &Duration, name: &str| part.is_zero() && name == NAMES[Part::Water as usize];
        (NAMES.iter().zip(&self.0))
            .filter(|(name, time)| !skipped(time, name))
            .map(|(&name, time)| StageTime {
                name,
                wall_s: time.as_secs_f64(),
            })
            .collect()
    }
}

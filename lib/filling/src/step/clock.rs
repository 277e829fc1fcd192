//! Wall time of each part of the step.

use std::time::{Duration, Instant};

use physics::StageTime;

/// Parts of a step whose time is reported, in its order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Part {
    Geometry,
    Fractions,
    Assembly,
    Solve,
    Forces,
    Advection,
    Density,
}

const NAMES: [&str; 7] = [
    "geometry",
    "liquid fractions",
    "assembly",
    "linear solve",
    "forces",
    "advection",
    "density projection",
];

/// Time spent so far.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Clock([Duration; 7]);

impl Clock {
    /// Runs `work` and counts its time.
    pub(super) fn time<T>(&mut self, part: Part, work: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = work();
        self.0[part as usize] += start.elapsed();
        result
    }

    pub(super) fn report(&self) -> Vec<StageTime> {
        (NAMES.iter().zip(&self.0))
            .map(|(&name, time)| StageTime {
                name,
                wall_s: time.as_secs_f64(),
            })
            .collect()
    }
}

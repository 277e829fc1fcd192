//! The stages of an explicit step: which a run has, which it does without, and their times.

use std::time::Instant;

use physics::{Scene, StageTime, Stages};

use crate::settings::{PressureFrom, Settings, VelocityUpdate};

const FILTER: &str = "velocity filter";
const AFFINE: &str = "affine velocity field";
const CELL_MEAN: &str = "cell-mean pressure";
const PROJECTION: &str = "density projection";

/// The stages of a run of `scene` with `settings`.
pub(crate) fn stages(scene: &Scene, settings: &Settings) -> Stages {
    let absent = |absent: bool, why: &str| absent.then(|| why.to_owned());
    let filter = match settings.velocity_update {
        VelocityUpdate::Xpic(2..) | VelocityUpdate::Fmpm(2..) => None,
        VelocityUpdate::Xpic(_) | VelocityUpdate::Fmpm(_) => Some("order 1 is plain PIC".into()),
        _ => Some("only xpic and fmpm pass velocities between points and nodes again".into()),
    };
    let no_field = settings.velocity_update != VelocityUpdate::Apic;
    let own_pressure = settings.pressure == PressureFrom::Point;
    let no_projection = settings.density_projection.is_none();
    Stages::of(scene)
        .and(FILTER, filter)
        .and(AFFINE, absent(no_field, "only points of apic carry one"))
        .and(CELL_MEAN, absent(own_pressure, "each point has its own"))
        .and(PROJECTION, absent(no_projection, "no density_projection"))
        .and("shear rate of points", None)
}

/// The list resolved for the step and for what tiles and blocks hold: no scene pays for what it
/// does not use.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Present {
    pub(crate) three: bool,
    pub(crate) contact: bool,
    pub(crate) friction: bool,
    pub(crate) force: bool,
    pub(crate) clamp: bool,
    pub(crate) load: bool,
    pub(crate) filter: bool,
    pub(crate) affine: bool,
    pub(crate) cell_mean: bool,
    pub(crate) projection: bool,
}

impl From<&Stages> for Present {
    fn from(list: &Stages) -> Self {
        Self {
            three: list.has(Stages::THIRD_DIMENSION),
            contact: list.has(Stages::CONTACT),
            friction: list.has(Stages::FRICTION),
            force: list.has(Stages::FORCE),
            clamp: list.has(Stages::CLAMP),
            load: list.has(Stages::LOAD),
            filter: list.has(FILTER),
            affine: list.has(AFFINE),
            cell_mean: list.has(CELL_MEAN),
            projection: list.has(PROJECTION),
        }
    }
}

/// Parts of a step whose time is reported.
#[derive(Clone, Copy)]
pub(crate) enum Stage {
    Bodies,
    PointsToNodes,
    Nodes,
    Filter,
    NodesToPoints,
    Sort,
}

const PARTS: [&str; 6] = [
    "bodies at nodes",
    "points to nodes",
    "contact and momentum",
    FILTER,
    "nodes to points and stress",
    "sort and control",
];

/// Wall time of each part so far.
pub(crate) struct Clock {
    seconds: [f64; 6],
    last: Instant,
}

impl Clock {
    pub(crate) fn new() -> Self {
        Self {
            seconds: [0.0; 6],
            last: Instant::now(),
        }
    }

    /// A step begins.
    pub(crate) fn start(&mut self) {
        self.last = Instant::now();
    }

    /// `part` is done.
    pub(crate) fn lap(&mut self, part: Stage) {
        let now = Instant::now();
        self.seconds[part as usize] += (now - self.last).as_secs_f64();
        self.last = now;
    }

    pub(crate) fn times(&self) -> Vec<StageTime> {
        (PARTS.iter().zip(self.seconds))
            .map(|(&name, wall_s)| StageTime { name, wall_s })
            .collect()
    }
}

//! The length of a step: foreseen from the last flow, and corrected by the flow found (docs/methods.md section 3.1, item 2).

use physics::{PressRun, StepLimit};

use super::mid_step::{MidStep, Void};
use super::trial::Solved;
use super::{Implicit, LN_VISCOSITY_STEP};
use crate::settings::{ITERATION_TOLERANCE, LARGEST_CFL};
use crate::system::Flow;

/// Factor by which a step may exceed its bounds, and the part of a bound which the next attempt aims at: so few steps are
/// solved twice.
const EXCESS: f64 = 1.1;
const TARGET: f64 = 0.95;
/// Largest change of the gap's height in a step, as a part of it. A film between plates, whose flow goes with the cube of the
/// height, then closes within 1 % of its time.
const GAP_STEP: f64 = 0.25;
/// Gap, voxels, below which [`GAP_STEP`] is a part of this height instead, so that bodies of given speed can meet.
const THIN: f64 = 0.1;
/// Largest ratio of successive step lengths with menisci. A pinned meniscus breaks loose from rest, where no speed bounds the
/// step, and steps that grow at once do not settle to rest (docs/decisions/menisci.md).
const MAX_LENGTH_RATIO: f64 = 2.0;
/// Parts of a step within which an event does not shorten it: nearer to its start it counts for all of the step, nearer to its
/// end for none of it.
const EVENT: [f64; 2] = [0.2, 0.97];
/// Bound on the lengths that a step tries for an event: what is left of it counts for the whole step.
const MAX_EVENTS: usize = 2;
/// Share of the flow into all voids from which the filling of one ends a step.
const LARGE_VOID: f64 = 0.1;
/// Most equal steps into which a time or travel that is left is divided.
const MOST_PARTS: f64 = 4.0;
/// Share of the remaining travel from which on a step is fitted to end the travel. A smaller one lengthens steps too much; a
/// larger one leaves a last step that hardly moves.
const FIT_FROM: f64 = 0.7;
/// Fraction of the faces, the fastest ones, that the Courant number ignores. A larger one misplaces liquid; with none, jets
/// through holes of one voxel would set the step length.
const IGNORED_FACES: f64 = 1e-3;

/// The lengths tried for a step.
pub(super) struct Attempts {
    /// Length and the clamp's speed of the last solve.
    before: Option<[f64; 2]>,
    /// Least length that was too long, s.
    too_long: f64,
    /// How often an event shortened it.
    events: usize,
}

impl Attempts {
    /// None yet.
    pub(super) fn none() -> Self {
        Self {
            before: None,
            too_long: f64::INFINITY,
            events: 0,
        }
    }
}

/// Length of the step that covers the travel `left`. The clamp's speed is taken as linear in the length, through the last solve
/// and the one `before`, each given as length and speed.
fn length_to_end_of_travel(left: f64, [dt, speed]: [f64; 2], before: Option<[f64; 2]>) -> f64 {
    let slope = before.map_or(0.0, |[other, slower]| (speed - slower) / (dt - other));
    let first = speed - slope * dt;
    let end = 2.0 * left / (first + (first * first + 4.0 * slope * left).sqrt());
    if end > 0.0 && end.is_finite() {
        end
    } else {
        left / speed
    }
}

/// The longest step of at most `dt` that divides `left` evenly, if few such steps are left.
fn even_part(dt: f64, left: f64) -> f64 {
    let parts = (left / dt / EXCESS).ceil().max(1.0);
    match parts <= MOST_PARTS {
        true => left / parts,
        false => dt,
    }
}

/// When each of `voids` is full that takes a large share of the flow, over the length `dt` (s) of a step.
fn large_voids(voids: &[Void], dt: f64) -> impl Iterator<Item = (&Void, f64)> {
    let all: f64 = voids.iter().map(|void| void.inflow.max(0.0)).sum();
    let large = move |void: &&Void| void.inflow > LARGE_VOID * all;
    let filled = move |void: &'_ Void| void.free / (void.inflow * dt);
    voids
        .iter()
        .filter(large)
        .map(move |void| (void, filled(void)))
}

/// Large voids that end a step of `dt` (s) because they are full within it, and the time of each, s.
pub(super) fn filled_within(voids: &[Void], dt: f64) -> impl Iterator<Item = (&Void, f64)> {
    let within = large_voids(voids, dt).filter(|(_, part)| *part > EVENT[0] && *part < EVENT[1]);
    within.map(move |(void, part)| (void, part * dt))
}

/// Whether a large void is full at the end of a step of `dt` (s).
pub(super) fn filled_by(voids: &[Void], dt: f64) -> bool {
    large_voids(voids, dt).any(|(_, part)| part * EVENT[1] < 1.0)
}

impl Implicit {
    /// Time in which the flow of the last step, times its expected growth, crosses a cell, s.
    pub(super) fn cell_crossing_time(&self) -> f64 {
        let courant_speed = self.state.courant_speed.max(self.state.flow.speed.abs());
        1.0 / (self.state.growth * courant_speed)
    }

    /// Length of the next step by the flow of the last one, s.
    pub(super) fn step_length(&self, limit: StepLimit) -> f64 {
        let (state, liquid, units) = (&self.state, &self.setup.liquid, self.setup.units);
        let cfl = self.setup.settings.cfl;
        let mut dt = cfl * self.cell_crossing_time();
        // A step has the viscosity of its middle, so cure must not change it much.
        if let Some(cure) = &liquid.cure {
            dt = dt.min(cure.steady(state.time, LN_VISCOSITY_STEP));
        }
        if let Some(balance) = &state.water {
            dt = dt.min(balance.steady_time());
        }
        // The first step starts from rest, where weight sets the speed.
        if state.steps == 0 {
            dt = dt.min((2.0 * cfl / self.setup.gravity_acceleration()).sqrt());
        }
        // A clamp that starts to retreat, in a stage that begins below the pressure reached, is bounded by its full speed only: with
        // air behind it no earlier step tells the speed.
        let retreating = (state.drive.programme.as_ref()).filter(|run| run.gives_way());
        if let Some(run) = retreating {
            dt = dt.min(cfl * units.cell_m / run.stage().speed);
        }
        // The first step is bounded by the capillary speed, tension over viscosity. Later ones may grow by a factor only, since
        // contact-line friction is evaluated at the velocity of the step before.
        if let Some(wetting) = liquid.wetting {
            dt = dt.min(match state.steps {
                0 => units.cell_m * units.viscosity / wetting.tension,
                _ => MAX_LENGTH_RATIO * state.dt,
            });
        }
        dt = dt.min(self.gap_step() / state.flow.speed.abs());
        if state.steps > 0 && self.setup.gas.is_none() {
            let voids = self.voids(&self.mesh, &self.full_pores(), &state.flow, self.height());
            dt = (filled_within(&voids, dt).map(|event| event.1)).fold(dt, f64::min);
        }
        let left = self.travel_left(limit);
        if left > 0.0 && left.is_finite() {
            dt = even_part(dt, left / state.flow.speed.max(f64::MIN_POSITIVE));
        }
        even_part(dt, limit.time_s)
    }

    /// Largest change of the gap's height in a step, cells; infinite where nothing closes.
    fn gap_step(&self) -> f64 {
        match self.setup.lattice.moving {
            Some(_) => GAP_STEP * self.height().max(THIN / self.mesh.k as f64),
            None => f64::INFINITY,
        }
    }

    /// Travel that is left, cells, at most the gap; infinite in a programme whose clamp has closed and now stands or retreats.
    pub(super) fn travel_left(&self, limit: StepLimit) -> f64 {
        let programme = self.state.drive.programme.as_ref();
        if programme.is_some_and(PressRun::is_closed) {
            return f64::INFINITY;
        }
        let travel = limit.travel_m / self.setup.units.cell_m;
        match self.setup.lattice.moving {
            Some(_) => travel.min(self.height()),
            None => travel,
        }
    }

    /// A length at which to repeat a step, s; `None` where the one solved will do. Sets whether the step
    /// ends the travel.
    pub(super) fn better_length(
        &self,
        solved: &mut Solved,
        limit: StepLimit,
        attempts: &mut Attempts,
    ) -> Option<f64> {
        let (dt, flow) = (solved.trial.middle.dt, &solved.flow);
        let cfl = self.setup.settings.cfl;
        let bounded = |crossed: f64, most: f64| {
            let shorter = crossed > EXCESS * most;
            shorter.then(|| TARGET * dt * most / crossed)
        };
        let crossed = dt * courant_speed(flow, cfl).max(flow.speed.abs());
        let mut crossing = bounded(crossed, cfl);
        // A pocket without air collapses by the same volume whatever the length, so the speed grows as the step shrinks.
        if self.setup.gas.is_some() && attempts.before.is_some() {
            crossing = crossing.map(|length| length.min(0.5 * dt));
        }
        let pressures = self.pressures(flow, &solved.forces);
        let event = match attempts.events < MAX_EVENTS {
            true => [
                self.limit_reached(solved, pressures[2]),
                self.void_filled(&solved.trial.middle, flow),
            ],
            false => [None; 2],
        };
        let event = event.into_iter().flatten().reduce(f64::min);
        attempts.events += usize::from(event.is_some());
        let gap = bounded(dt * flow.speed.abs(), self.gap_step());
        let shorter = [solved.dries_too_fast(), crossing, gap, event];
        let now = [dt, flow.speed];
        let before = attempts.before.replace(now);
        if let Some(shortest) = shorter.into_iter().flatten().reduce(f64::min) {
            attempts.too_long = attempts.too_long.min(dt);
            return Some(shortest);
        }
        let left = self.travel_left(limit);
        if left == f64::INFINITY || left == 0.0 {
            return None;
        }
        let reach = dt * flow.speed;
        // An absolute tolerance too: the speed in a thin film is known no better.
        let tolerance = ITERATION_TOLERANCE * left.max(self.height());
        solved.ends_travel = (reach - left).abs() <= tolerance;
        let end = length_to_end_of_travel(left, now, before);
        let may_end = end < attempts.too_long.min(limit.time_s);
        let fits = !solved.ends_travel && reach > FIT_FROM * left && (may_end || reach > left);
        fits.then_some(end)
    }

    /// When a large void is full, if that is within the step.
    fn void_filled(&self, middle: &MidStep, flow: &Flow) -> Option<f64> {
        if self.setup.gas.is_some() {
            return None;
        }
        let voids = self.voids(&middle.mesh, &middle.full, flow, middle.end_height);
        let times = filled_within(&voids, middle.dt).map(|event| event.1);
        times.reduce(f64::min)
    }

    /// When the pressure at full speed reaches the limit, if that is within the step.
    fn limit_reached(&self, solved: &Solved, pressure: f64) -> Option<f64> {
        let dt = solved.trial.middle.dt;
        let [limit, pressure] = solved.trial.drive.at_full_speed(pressure)?;
        let (start, [_, _, before]) = solved.before;
        // In proportion while pressure grows by a factor, evenly from none.
        let grown = match before > 0.1 * pressure {
            true => (limit / before).ln() / (pressure / before).ln(),
            false => (limit - before) / (pressure - before),
        };
        let time = start + (0.5 * dt - start) * grown;
        (time > EVENT[0] * dt && time < EVENT[1] * dt && pressure > before).then_some(time)
    }
}

/// Flow speed for the Courant number, cells/s: that of the fastest faces but for the ignored ones, which may reach
/// [`LARGEST_CFL`] cells a step.
pub(super) fn courant_speed(flow: &Flow, cfl: f64) -> f64 {
    let mut speeds: Vec<f64> = (flow.velocity.iter())
        .filter(|v| **v != 0.0)
        .map(|v| v.abs())
        .collect();
    if speeds.is_empty() {
        return 0.0;
    }
    let at = ((1.0 - IGNORED_FACES) * (speeds.len() - 1) as f64) as usize;
    let most = speeds.iter().fold(0.0, |most: f64, &v| v.max(most));
    let (_, &mut counted, _) = speeds.select_nth_unstable_by(at, f64::total_cmp);
    counted.max(most * cfl / LARGEST_CFL)
}

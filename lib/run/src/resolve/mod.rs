//! A case and its bodies or bond file, resolved to a [`Scene`] in SI.

mod bond;
mod clearance;
mod collisions;
mod intervals;
mod liquid;
mod periodic;
mod plausible;
mod press;
mod primitives;
mod seed;

use particle_file::{ParticleFile, limits};
use physics::{
    Amount, Boundary, Clamp, Dimensions, Pid, Points, PressStage, RigidBody, Scene, Seed, Stop,
    WallLaw,
};

use crate::case::{Case, ClampTable, ContactTable, StopRule};
use crate::failure::{RunFailure, refused};

pub(crate) use bond::swap;
pub(crate) use plausible::OVERLAP_CELLS;
use seed::Seeds;

/// A number of cells along an axis, rounded up.
fn cells_along(n: f64) -> Result<usize, RunFailure> {
    if n <= limits::PER_AXIS as f64 {
        return Ok(n.ceil().max(1.0) as usize);
    }
    refused(format!(
        "the domain is {n:.3e} cells long, more than {}: the cell is too small",
        limits::PER_AXIS
    ))
}

/// A run resolved to SI: the scene, and what the time loop needs beside it.
#[derive(Debug)]
pub struct Setup {
    /// The scene; its points are made by [`Setup::points`].
    pub scene: Scene,
    /// Liquid at the start.
    pub liquid: Amount,
    seeds: Seeds,
    /// Latest end, s.
    pub time_limit_s: f64,
    /// Travel of the clamp until its body meets an obstacle, m, and the name of the obstacle.
    pub clamp_clearance: Option<(f64, String)>,
    /// Travel of the clamp at which the gap counts as closed, m; `None` without a clamp.
    pub initial_gap_m: Option<f64>,
    /// Duration over which snapshots and rows of the history are spread, s.
    pub nominal_duration_s: f64,
    /// Time between rows of the history, s; 0 for a row after every step.
    pub history_every_s: f64,
    /// Bond normal in the files; in the scene it is y.
    pub normal: units::Axis,
}

impl Setup {
    /// The material points of the liquid, made one by one: a run need not hold millions of them twice, and a plan needs none.
    pub(crate) fn points(&self) -> impl Iterator<Item = Seed> {
        self.seeds.points()
    }
}

/// Low and high corner of a box, m.
type Corners = ([f64; 3], [f64; 3]);

/// Geometry of a scene, from a bond file or from `[[body]]` tables.
struct Geometry {
    grid: physics::GridBox,
    seeds: Seeds,
    bodies: Vec<RigidBody>,
    bottom: Option<usize>,
    top: Option<usize>,
    travel_m: Option<f64>,
    normal: units::Axis,
}

/// Resolves `case`, with its bond file if given.
///
/// # Errors
/// One sentence about keys that contradict each other or geometry that does not fit.
pub fn resolve(case: &Case, bond: Option<&ParticleFile>) -> Result<Setup, RunFailure> {
    let dimensions = match case.grid.dimensions {
        2 => Dimensions::Two,
        3 => Dimensions::Three,
        n => {
            let said = format!("[grid] dimensions = {n} is not accepted: 2 or 3 is needed");
            return refused(said);
        }
    };
    if !(1..=4).contains(&case.grid.points_per_direction) {
        return refused("[grid] points_per_direction must be 1 to 4");
    }
    let geometry = match bond {
        Some(bond) if case.body.is_empty() => bond::geometry(case, dimensions, bond)?,
        Some(_) => {
            return refused(
                "the case has [[body]] tables and --particles: only one of them can describe the scene",
            );
        }
        None if case.body.is_empty() => {
            return refused(
                "nothing describes the scene: give --particles BOND or [[body]] tables",
            );
        }
        None => primitives::geometry(case, dimensions)?,
    };
    resolve_geometry(case, dimensions, geometry)
}

fn resolve_geometry(
    case: &Case,
    dimensions: Dimensions,
    geometry: Geometry,
) -> Result<Setup, RunFailure> {
    let cell = geometry.grid.cell_m;
    let programme = match &case.clamp {
        Some(table) => press::programme(table, geometry.travel_m)?,
        None => Vec::new(),
    };
    let clamp = match &case.clamp {
        Some(table) if programme.is_empty() => Some(clamp(table)?),
        Some(_) => Some(press::clamp(&programme)),
        None => None,
    };
    let (stop, time_limit_s, nominal) = stop(case, clamp, &programme, geometry.travel_m)?;
    let scene = Scene {
        dimensions,
        grid: geometry.grid,
        boundary: boundary(case, dimensions)?,
        liquid: liquid::liquid(&case.adhesive)?,
        points: Points::default(),
        wall: wall(case.contact.as_ref(), cell, !geometry.bodies.is_empty())?,
        bodies: geometry.bodies,
        gravity: (case.gravity.as_ref()).map_or([0.0; 3], |g| g.acceleration.map(|a| a.si())),
        clamp,
        programme,
        stop,
        bottom: geometry.bottom,
        top: geometry.top,
    };
    liquid::check_walls(&scene.liquid, &scene.bodies)?;
    let liquid = geometry.seeds.amount().map_err(RunFailure::Usage)?;
    plausible::check(&scene, &liquid, time_limit_s)?;
    let initial_gap_m = scene.clamp.and(geometry.travel_m);
    // Steps of a press programme last from microseconds to hours: each gets a row.
    let history_every_s = match (case.output.history_every, scene.programme.is_empty()) {
        (Some(every), _) => every.si(),
        (None, true) => 1e-3 * nominal,
        (None, false) => 0.0,
    };
    Ok(Setup {
        clamp_clearance: plausible::clamp_clearance(&scene, time_limit_s),
        scene,
        liquid,
        seeds: geometry.seeds,
        time_limit_s,
        initial_gap_m,
        nominal_duration_s: nominal,
        history_every_s,
        normal: geometry.normal,
    })
}

/// A clamp of one speed and one limit.
fn clamp(table: &ClampTable) -> Result<Clamp, RunFailure> {
    let Some(closing_speed) = table.closing_speed else {
        return refused("[clamp] needs closing_speed, or a list of [[clamp.stage]]");
    };
    let pid = table.pid.map(|g| Pid {
        kp: g.kp,
        ki: g.ki,
        kd: g.kd,
    });
    let sound = |gain: f64| gain.is_finite() && gain >= 0.0;
    if pid.is_some_and(|pid| ![pid.kp, pid.ki, pid.kd].into_iter().all(sound)) {
        return refused("[clamp] pid: kp, ki and kd must be numbers of at least 0");
    }
    Ok(Clamp {
        closing_speed: closing_speed.si(),
        max_pressure: table.max_pressure.map(|p| p.si()),
        pid,
    })
}

/// The stop rule, the latest end and the nominal duration.
fn stop(
    case: &Case,
    clamp: Option<Clamp>,
    programme: &[PressStage],
    travel: Option<f64>,
) -> Result<(Stop, f64, f64), RunFailure> {
    let (Some(table), Some(clamp)) = (&case.clamp, clamp) else {
        let Some(stop) = &case.stop else {
            return refused("the case has no end: give [stop] time, or a [clamp] with stop");
        };
        let time = stop.time.si();
        return Ok((Stop::Time(time), time, time));
    };
    if case.stop.is_some() {
        return refused("[stop] is for runs without [clamp]; use the clamp's own stop");
    }
    if let (false, Some(travel_m)) = (programme.is_empty(), travel) {
        let longest = programme.iter().map(|stage| stage.time_s).sum();
        return Ok((Stop::Closed { travel_m }, longest, longest));
    }
    match table.stop.unwrap_or(StopRule::Closed) {
        StopRule::Time(t) => Ok((Stop::Time(t), t, t)),
        StopRule::Closed => {
            let Some(travel_m) = travel else {
                return refused("stop = \"closed\" needs the clamp's travel: give [clamp] travel");
            };
            let nominal = travel_m / clamp.closing_speed;
            // Under load control the bond may never close (paper Fig. 5): the paper's runs had stopped moving by twice the time at
            // full speed.
            let limit = table.time_limit.map_or(2.0 * nominal, |t| t.si());
            Ok((Stop::Closed { travel_m }, limit, nominal))
        }
    }
}

fn boundary(case: &Case, dimensions: Dimensions) -> Result<[Boundary; 3], RunFailure> {
    let sides = [case.boundary.x, case.boundary.y, case.boundary.z];
    if dimensions == Dimensions::Two && sides[2] != Boundary::Symmetry {
        return refused("[boundary] z has no meaning in plane strain (dimensions = 2)");
    }
    if case.clamp.is_some() && sides[1] == Boundary::Periodic {
        return refused(
            "[boundary] y = \"periodic\" has no meaning with [clamp], which closes the bond along y: use \"symmetry\" or \"open\"",
        );
    }
    Ok(sides)
}

fn wall(contact: Option<&ContactTable>, cell: f64, walls: bool) -> Result<WallLaw, RunFailure> {
    let Some(contact) = contact else {
        return match walls {
            true => refused("the scene has rigid bodies: [contact] law is needed"),
            false => Ok(WallLaw::Frictionless),
        };
    };
    match (contact.law, contact.influence_length) {
        (WallLaw::PartialSlip { .. }, Some(l)) => Ok(WallLaw::PartialSlip {
            influence_length_m: l.si(cell),
        }),
        (WallLaw::PartialSlip { .. }, None) => refused(
            "[contact] law = \"partial-slip\" needs influence_length, such as \"0.01 cell\"",
        ),
        (WallLaw::Frictionless | WallLaw::Stick, Some(_)) => {
            refused("[contact] influence_length is for law = \"partial-slip\" only")
        }
        (law, None) => Ok(law),
    }
}

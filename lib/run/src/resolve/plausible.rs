//! Checks that refuse scenes for which no scheme can give a meaningful result.

use physics::{Amount, Clamp, Motion, Scene, Stop};

use super::collisions::{self, Obstacle};
use crate::failure::{RunFailure, refused};
use crate::verdict::MOST_PRESSURE;

/// Overlap of bodies that is accepted, cells. It is far below the resolution of walls, and some scenes move touching bodies
/// against each other only to report their reactions separately.
pub(crate) const OVERLAP_CELLS: f64 = 0.02;

/// Most periods that a body may travel through periodic sides, so that the search for collisions ends.
const MOST_PERIODS: f64 = 1e6;

/// Refuses a scene in which nothing is pressed, bodies would overlap, or speed or weight are too large for a nearly
/// incompressible liquid. The run ends at `limit_s` (s) at the latest.
pub(super) fn check(scene: &Scene, liquid: &Amount, limit_s: f64) -> Result<(), RunFailure> {
    check_speed(scene, liquid)?;
    check_weight(scene)?;
    check_periods(scene, limit_s)?;
    if let Some(clamp) = scene.clamp {
        if !scene.bodies.iter().any(|b| b.motion == Motion::Clamped) {
            return refused(
                "[clamp] has nothing to move: give a [[body]] of material = \"rigid\" velocity = \"clamp\", or leave [clamp] out",
            );
        }
        let travel_m = match scene.stop {
            Stop::Closed { travel_m } => travel_m,
            Stop::Time(time) => time * clamp.closing_speed,
        };
        check_clamp_reaches_liquid(scene, liquid, travel_m)?;
        check_clamp_clearance(scene, clamp, travel_m, limit_s)?;
    }
    check_given_velocities(scene, limit_s)
}

/// Refuses a clamp that would run into another body within `travel_m` (m).
fn check_clamp_clearance(
    scene: &Scene,
    clamp: Clamp,
    travel_m: f64,
    limit_s: f64,
) -> Result<(), RunFailure> {
    let slack = OVERLAP_CELLS * scene.grid.cell_m;
    if clamp.max_pressure.is_some() {
        let most_m = match scene.stop {
            Stop::Closed { travel_m } => travel_m,
            Stop::Time(_) => f64::INFINITY,
        };
        if let Some(other) = collisions::may_meet_clamp(scene, limit_s, most_m, slack) {
            return refused(format!(
                "'{}' of given velocity may meet the clamp's body, whose motion depends on [clamp] max_pressure, and bodies cannot overlap: no max_pressure, another velocity or an earlier end is needed",
                other.name
            ));
        }
    }
    // If a pressure limit may stop the clamp first, the run checks its travel at each step.
    let certain = matches!(scene.stop, Stop::Closed { .. }) || clamp.max_pressure.is_none();
    match clamp_clearance(scene, limit_s) {
        Some((clearance_m, other))
            if (certain || clearance_m < -slack) && travel_m > clearance_m + slack =>
        {
            refused(format!(
                "the clamp would travel {:.4} um, but its body meets {other} after {:.4} um and bodies cannot overlap: a smaller [clamp] travel (or stop time) is needed",
                1e6 * travel_m,
                1e6 * clearance_m.max(0.0)
            ))
        }
        _ => Ok(()),
    }
}

/// Travel of the clamp until its body meets an obstacle before `limit_s` (s), m, and the name of the obstacle.
pub(super) fn clamp_clearance(scene: &Scene, limit_s: f64) -> Option<(f64, String)> {
    let collision = collisions::first_collision(scene, true, limit_s)?;
    let travel_m = collision.time_s * scene.clamp?.closing_speed;
    Some((travel_m, collision.with.to_string()))
}

/// Refuses bodies that travel through more than [`MOST_PERIODS`].
fn check_periods(scene: &Scene, limit_s: f64) -> Result<(), RunFailure> {
    for body in &scene.bodies {
        let v = scene.velocity(body.motion);
        for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
            let count = (scene.period(axis)).map_or(0.0, |length| v[axis].abs() * limit_s / length);
            if count > MOST_PERIODS {
                return refused(format!(
                    "the body '{}' would go over {count:.1e} periods of the domain along {name} by {limit_s:.4e} s; accepted are {MOST_PERIODS:.0e}: a lower velocity or an earlier end is needed",
                    body.name
                ));
            }
        }
    }
    Ok(())
}

fn check_speed(scene: &Scene, liquid: &Amount) -> Result<(), RunFailure> {
    let (speed, sound) = (scene.speed_with(liquid), scene.liquid.sound_speed());
    if speed <= sound {
        return Ok(());
    }
    let who = match scene.clamp {
        Some(clamp) if clamp.closing_speed == speed && scene.programme.is_empty() => {
            "[clamp] closing_speed"
        }
        Some(clamp) if clamp.closing_speed == speed => "the speed of a [[clamp.stage]]",
        _ if liquid.speed == speed => "the velocity of an adhesive body",
        _ => "the velocity of a rigid body",
    };
    refused(format!(
        "{who} is {speed:.4e} m/s, above the liquid's speed of sound sqrt(K/rho) = {sound:.4e} m/s, which causes shock waves; a lower speed, a higher bulk_modulus or a lower density is needed"
    ))
}

/// Refuses gravity under which a domain full of liquid exceeds the pressure range of Tait's law.
fn check_weight(scene: &Scene) -> Result<(), RunFailure> {
    let (low, high) = (scene.grid.min_m, scene.grid.max_m());
    let pressure: f64 = (0..3)
        .map(|a| scene.liquid.density * scene.gravity[a].abs() * (high[a] - low[a]))
        .sum();
    let most = MOST_PRESSURE * scene.liquid.tait.bulk_modulus;
    if pressure <= most {
        return Ok(());
    }
    refused(format!(
        "[gravity] acceleration gives a domain full of liquid a pressure of {pressure:.3e} Pa at its floor, above {most:.3e} Pa ({MOST_PRESSURE} of the bulk modulus), the limit of the pressure law: a smaller acceleration is needed"
    ))
}

/// Refuses a clamp whose body never comes near liquid. Scenes with other motion are accepted: liquid may come to the clamp.
fn check_clamp_reaches_liquid(
    scene: &Scene,
    liquid: &Amount,
    travel_m: f64,
) -> Result<(), RunFailure> {
    let moved = scene
        .bodies
        .iter()
        .any(|b| matches!(b.motion, Motion::Constant(_)));
    if moved || liquid.speed > 0.0 || scene.gravity != [0.0; 3] {
        return Ok(());
    }
    let near = scene.grid.cell_m;
    let clamped = scene.bodies.iter().filter(|b| b.motion == Motion::Clamped);
    let passes = clamped.flat_map(|b| &b.blocks).any(|block| {
        let (mut low, high) = (block.origin(), block.max());
        low[1] -= travel_m;
        (0..3).all(|a| low[a] - near <= liquid.high_m[a] && high[a] + near >= liquid.low_m[a])
    });
    if passes {
        return Ok(());
    }
    refused(format!(
        "the clamp's body does not reach the adhesive within its travel of {:.4} um: nothing would be pressed",
        1e6 * travel_m
    ))
}

/// Refuses bodies of given velocities that would collide before the end.
fn check_given_velocities(scene: &Scene, limit_s: f64) -> Result<(), RunFailure> {
    let end_s = match (scene.stop, scene.clamp) {
        (Stop::Closed { travel_m }, Some(clamp))
            if scene.programme.is_empty() && clamp.max_pressure.is_none() =>
        {
            limit_s.min(travel_m / clamp.closing_speed)
        }
        _ => limit_s,
    };
    let Some(met) = collisions::first_collision(scene, false, end_s) else {
        return Ok(());
    };
    if met.speed * (end_s - met.time_s) <= OVERLAP_CELLS * scene.grid.cell_m {
        return Ok(());
    }
    let (name, from_s) = (&met.body.name, met.time_s.max(0.0));
    refused(match met.with {
        Obstacle::Body(other) => format!(
            "the bodies '{name}' and '{}' would overlap from {from_s:.4e} s on, before the end at {end_s:.4e} s: other velocities or an earlier end are needed",
            other.name
        ),
        side @ Obstacle::Mirror(..) => format!(
            "the body '{name}' would go through {side} from {from_s:.4e} s on, before the end at {end_s:.4e} s: another velocity, an open side or an earlier end is needed"
        ),
    })
}

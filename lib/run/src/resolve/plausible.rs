//! Scenes that no scheme can give a meaningful answer to, refused before they start.

use physics::{Amount, Motion, Scene, Stop};

use super::meeting;
use crate::case::CaseError;
use crate::verdict::MOST_PRESSURE;

/// Cells by which bodies may come to overlap: far below what walls are resolved to, and some scenes
/// let touching bodies move against each other only to tell their reactions apart.
pub(crate) const OVERLAP: f64 = 0.02;

/// Refuses a scene in which nothing is pressed, bodies would overlap, or speeds or weights are
/// beyond what a nearly incompressible liquid can follow.
pub(super) fn check(scene: &Scene, liquid: &Amount) -> Result<(), CaseError> {
    slower_than_sound(scene, liquid)?;
    weight(scene)?;
    if let Some(clamp) = scene.clamp {
        if !scene.bodies.iter().any(|b| b.motion == Motion::Clamped) {
            return Err(CaseError(
                "[clamp] has nothing to move: give a [[body]] of material = \"rigid\" velocity = \"clamp\", or leave [clamp] out"
                    .into(),
            ));
        }
        let travel_m = match scene.stop {
            Stop::Closed { travel_m } => travel_m,
            Stop::Time(time) => time * clamp.closing_speed,
        };
        reached(scene, liquid, travel_m)?;
        // Where pressure may stop the clamp before, the run itself looks at its travel.
        let certain = matches!(scene.stop, Stop::Closed { .. }) || clamp.max_pressure.is_none();
        if clamp.max_pressure.is_some() {
            let (end_s, most_m) = match scene.stop {
                Stop::Closed { travel_m } => (f64::INFINITY, travel_m),
                Stop::Time(time) => (time, f64::INFINITY),
            };
            let slack = OVERLAP * scene.grid.cell_m;
            if let Some(other) = meeting::possible(scene, end_s, most_m, slack) {
                return Err(CaseError(format!(
                    "where the clamp is when '{}' of given velocity comes into its way depends on [clamp] max_pressure, and bodies cannot overlap: no max_pressure, another velocity or an earlier end is needed",
                    other.name
                )));
            }
        }
        if let Some((room_m, other)) = clamp_room(scene)
            .filter(|(room_m, _)| certain || *room_m < -OVERLAP * scene.grid.cell_m)
            && travel_m > room_m + OVERLAP * scene.grid.cell_m
        {
            return Err(CaseError(format!(
                "the clamp would travel {:.4} um, but its body meets '{other}' after {:.4} um and bodies cannot overlap: a smaller [clamp] travel (or stop time) is needed",
                1e6 * travel_m,
                1e6 * room_m.max(0.0)
            )));
        }
    }
    apart(scene)
}

/// How far the clamp can travel before its body meets another one, m, and the name of that one.
pub(super) fn clamp_room(scene: &Scene) -> Option<(f64, String)> {
    let meeting = meeting::first(scene, true)?;
    let [a, b] = meeting.bodies;
    let other = if a.motion == Motion::Clamped { b } else { a };
    Some((
        meeting.time_s * scene.clamp?.closing_speed,
        other.name.clone(),
    ))
}

fn slower_than_sound(scene: &Scene, liquid: &Amount) -> Result<(), CaseError> {
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
    Err(CaseError(format!(
        "{who} is {speed:.4e} m/s, above the liquid's speed of sound sqrt(K/rho) = {sound:.4e} m/s: such a liquid is shocked, not pressed; a lower speed, a higher bulk_modulus or a lower density is needed"
    )))
}

/// Pressure under the weight of a domain full of liquid against what Tait's law holds for.
fn weight(scene: &Scene) -> Result<(), CaseError> {
    let (low, high) = (scene.grid.min_m, scene.grid.max_m());
    let pressure: f64 = (0..3)
        .map(|a| scene.liquid.density * scene.gravity[a].abs() * (high[a] - low[a]))
        .sum();
    let most = MOST_PRESSURE * scene.liquid.tait.bulk_modulus;
    if pressure <= most {
        return Ok(());
    }
    Err(CaseError(format!(
        "[gravity] acceleration makes a domain full of liquid weigh {pressure:.3e} Pa on its floor, more than the {most:.3e} Pa ({MOST_PRESSURE} of the bulk modulus) to which the pressure law holds: a smaller acceleration is needed"
    )))
}

/// A clamp whose body passes no place near liquid presses nothing. Liquid that moves of itself may
/// yet come to it.
fn reached(scene: &Scene, liquid: &Amount, travel_m: f64) -> Result<(), CaseError> {
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
    Err(CaseError(format!(
        "the clamp's body does not come near the adhesive within its travel of {:.4} um: nothing would be pressed",
        1e6 * travel_m
    )))
}

/// Bodies of given velocities that would meet before the end.
fn apart(scene: &Scene) -> Result<(), CaseError> {
    let end_s = match (scene.stop, scene.clamp) {
        _ if !scene.programme.is_empty() => scene.programme.iter().map(|s| s.time_s).sum(),
        (Stop::Time(time), _) => time,
        (Stop::Closed { travel_m }, Some(clamp)) => travel_m / clamp.closing_speed,
        (Stop::Closed { .. }, None) => return Ok(()),
    };
    match meeting::first(scene, false) {
        Some(meeting) if overlap(scene, &meeting, end_s) > OVERLAP * scene.grid.cell_m => {
            Err(CaseError(format!(
                "the bodies '{}' and '{}' would overlap from {:.4e} s on, before the end at {end_s:.4e} s: other velocities or an earlier end are needed",
                meeting.bodies[0].name,
                meeting.bodies[1].name,
                meeting.time_s.max(0.0)
            )))
        }
        _ => Ok(()),
    }
}

/// How far two bodies that meet have gone on at the end, m.
fn overlap(scene: &Scene, meeting: &meeting::Meeting, end_s: f64) -> f64 {
    let [a, b] = meeting.bodies.map(|body| scene.velocity(body.motion));
    let square: f64 = (0..3).map(|i| (a[i] - b[i]).powi(2)).sum();
    square.sqrt() * (end_s - meeting.time_s)
}

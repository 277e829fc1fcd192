//! The stages of a press programme, resolved to SI and checked against one another.

use physics::{Choice, Clamp, Press, PressStage};

use crate::case::{ClampTable, StageTable};
use crate::failure::{RunFailure, refused};
use crate::summary;

/// Default duration of an approach, over the time in which the clamp closes at full speed: it ends by closure before.
const APPROACH: f64 = 2.0;

/// The stages of a programme for a clamp that can travel `travel_m` (m); empty for a clamp without a programme.
/// Errors: keys of a clamp without stages, and stages that contradict themselves or one another.
pub(super) fn programme(
    table: &ClampTable,
    travel_m: Option<f64>,
) -> Result<Vec<PressStage>, RunFailure> {
    if table.stage.is_empty() {
        return Ok(Vec::new());
    }
    let stray = [
        (table.closing_speed.is_some(), "closing_speed"),
        (table.max_pressure.is_some(), "max_pressure"),
        (table.pid.is_some(), "pid"),
        (table.stop.is_some(), "stop"),
        (table.time_limit.is_some(), "time_limit"),
    ];
    if let Some((_, key)) = stray.iter().find(|(given, _)| *given) {
        return refused(format!(
            "[clamp] {key} is for a clamp without [[clamp.stage]]: stages have their own speed, pressure and time"
        ));
    }
    let Some(room_m) = travel_m else {
        return refused("[[clamp.stage]] needs the clamp's travel: give [clamp] travel");
    };
    let mut stages: Vec<PressStage> = Vec::new();
    for (index, stage) in table.stage.iter().enumerate() {
        let stage = resolved(stage, stages.last(), room_m).map_err(|said| {
            let kind = stage.kind.name();
            RunFailure::Usage(format!(
                "[[clamp.stage]] number {} ({kind}): {said}",
                index + 1
            ))
        })?;
        stages.push(stage);
    }
    Ok(stages)
}

/// The clamp of a programme, with its largest speed and pressure.
pub(super) fn clamp(stages: &[PressStage]) -> Clamp {
    let speeds = stages.iter().map(|stage| stage.speed);
    let pressures = stages.iter().filter_map(|stage| stage.pressure);
    Clamp {
        closing_speed: speeds.fold(0.0, f64::max),
        max_pressure: pressures.reduce(f64::max),
        pid: None,
    }
}

/// Resolves a stage that follows the stage `before`.
fn resolved(
    table: &StageTable,
    before: Option<&PressStage>,
    room_m: f64,
) -> Result<PressStage, String> {
    stray(table)?;
    let speed = (table.speed.map(|speed| speed.si()))
        .or(before.map(|before| before.speed))
        .ok_or("the first stage needs a speed such as \"1 mm/s\", which later stages keep")?;
    let travel_m = table.travel.map(|travel| travel.si());
    let gone = before.and_then(|before| before.travel_m).unwrap_or(0.0);
    if let Some(travel) = travel_m.filter(|travel| *travel <= gone || *travel > room_m) {
        return Err(format!(
            "its travel of {:.4} um since the start of the run must be more than the {:.4} um of the stage before and at most the {:.4} um that the clamp has",
            1e6 * travel,
            1e6 * gone,
            1e6 * room_m
        ));
    }
    let time_s = match (table.time, table.kind) {
        (Some(time), _) => time.si(),
        (None, Press::Approach) => APPROACH * room_m / speed,
        (None, _) => return Err("it needs a time (its longest duration) such as \"5 min\"".into()),
    };
    Ok(PressStage {
        kind: table.kind,
        speed,
        pressure: pressure(table, before)?,
        time_s,
        travel_m,
        contact: table.contact,
        slower: table.slower.map(|speed| speed.si()),
    })
}

/// Refuses keys that this kind of stage does not use.
fn stray(table: &StageTable) -> Result<(), String> {
    let kind = table.kind;
    if table.contact && kind != Press::Approach {
        return Err("only an approach can end with contact".into());
    }
    if table.slower.is_some() && !matches!(kind, Press::Hold | Press::Release) {
        return Err("only a hold or a release can end with slower".into());
    }
    if table.pressure.is_some() && kind == Press::Release {
        return Err("a release has no pressure".into());
    }
    Ok(())
}

/// Pressure at the end of a stage, Pa.
fn pressure(table: &StageTable, before: Option<&PressStage>) -> Result<Option<f64>, String> {
    let given = table.pressure.map(|pressure| pressure.si());
    let kept = before.and_then(|before| before.pressure);
    // An approach may end, by time or travel, at any pressure.
    let set = before.filter(|before| before.kind != Press::Approach);
    match (table.kind, given) {
        (Press::Approach, given) => Ok(given),
        (Press::Ramp, None) => Err("it needs a pressure".into()),
        (Press::Ramp, Some(to)) if set.is_some() && kept == Some(to) => Err(format!(
            "the pressure is {} already: use a hold",
            summary::pressure(to, 4)
        )),
        (Press::Hold, Some(at)) if set.is_some() && kept != Some(at) => Err(format!(
            "it is at {} and the stage before ends at {}: a ramp between them is needed",
            summary::pressure(at, 4),
            summary::pressure(kept.unwrap_or(0.0), 4)
        )),
        (Press::Hold, None) => (kept.filter(|kept| *kept > 0.0))
            .map(Some)
            .ok_or_else(|| "it needs a pressure: the stage before ends without one".into()),
        (Press::Release, _) if kept.is_none() => {
            Err("the stage before ends without a pressure".into())
        }
        (Press::Release, _) => Ok(Some(0.0)),
        (_, given) => Ok(given),
    }
}

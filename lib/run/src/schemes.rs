//! The scheme a case asks for, with its settings and its forecast.

use implicit::Implicit;
use mpm::{Explicit, PressureFrom, VelocityUpdate};
use physics::{Choice, Scene, Scheme};

use crate::case::{Case, CaseError, SchemeName};
use crate::failure::RunFailure;
use crate::forecast::Forecast;
use crate::resolve::Setup;

/// The Courant number of a case, or its scheme's own.
pub(crate) fn cfl(case: &Case) -> f64 {
    case.integrator.cfl.unwrap_or_else(|| default_cfl(case))
}

/// The Courant number of a case that names none.
pub(crate) fn default_cfl(case: &Case) -> f64 {
    match case.integrator.scheme {
        SchemeName::Explicit => mpm::Settings::default().cfl,
        SchemeName::Implicit => implicit::Settings::default().cfl,
    }
}

/// The scheme at the start of its scene.
///
/// # Errors
/// Settings that are not of this scheme, and scenes it cannot do.
pub(crate) fn build(case: &Case, setup: &Setup) -> Result<Box<dyn Scheme>, RunFailure> {
    let scene = &setup.scene;
    Ok(match case.integrator.scheme {
        SchemeName::Explicit => {
            let scheme = Explicit::of_points(
                scene,
                &setup.liquid,
                setup.points(),
                &explicit(case, setup.scene.grid.cell_m)?,
            );
            Box::new(scheme.map_err(RunFailure::Usage)?)
        }
        SchemeName::Implicit => {
            let scene = Scene {
                points: setup.points().collect(),
                ..scene.clone()
            };
            Box::new(Implicit::new(&scene, implicit(case)?).map_err(RunFailure::Usage)?)
        }
    })
}

/// What a run is expected to take.
pub(crate) fn forecast(case: &Case, setup: &Setup) -> Result<Forecast, RunFailure> {
    match case.integrator.scheme {
        SchemeName::Explicit => explicit_forecast(&explicit(case, setup.scene.grid.cell_m)?, setup),
        SchemeName::Implicit => Ok(implicit_forecast(&implicit(case)?, setup)),
    }
}

fn explicit(case: &Case, cell: f64) -> Result<mpm::Settings, CaseError> {
    let table = &case.integrator;
    if table.tolerance.is_some() {
        return Err(CaseError(
            "[integrator] tolerance is for scheme = \"implicit\" only".into(),
        ));
    }
    if case.adhesive.cure.is_some() {
        return Err(CaseError(
            "[adhesive.cure] is for scheme = \"implicit\" only: explicit steps do not reach the time of cure"
                .into(),
        ));
    }
    if case.adhesive.water.is_some() {
        return Err(CaseError(
            "[adhesive.water] is for scheme = \"implicit\" only: explicit steps do not reach the time in which wood takes water"
                .into(),
        ));
    }
    if case.adhesive.surface_tension.is_some() {
        return Err(CaseError(
            "[adhesive] surface_tension is for scheme = \"implicit\" only: explicit steps are too short for liquid to be drawn anywhere"
                .into(),
        ));
    }
    if case.adhesive.dynamic_angle.is_some() {
        return Err(CaseError(
            "[adhesive] dynamic_angle is for scheme = \"implicit\" only".into(),
        ));
    }
    if case.air.is_some() {
        return Err(CaseError(
            "[air] is for scheme = \"implicit\" only: the explicit scheme has no pressure in what it leaves empty"
                .into(),
        ));
    }
    if (case.clamp.as_ref()).is_some_and(|clamp| !clamp.stage.is_empty()) {
        return Err(CaseError(
            "[[clamp.stage]] is for scheme = \"implicit\" only: explicit steps are too short for a press"
                .into(),
        ));
    }
    let update = table.velocity_update.unwrap_or_default();
    let velocity_update = match (update, table.order.map(u32::from)) {
        (VelocityUpdate::Xpic(_), Some(order)) => VelocityUpdate::Xpic(order),
        (VelocityUpdate::Fmpm(_), Some(order)) => VelocityUpdate::Fmpm(order),
        (VelocityUpdate::Xpic(_) | VelocityUpdate::Fmpm(_), None) => {
            return Err(CaseError(format!(
                "[integrator] velocity_update = \"{}\" needs an order, such as order = 5",
                update.name()
            )));
        }
        (_, Some(_)) => {
            return Err(CaseError(
                "[integrator] order is for velocity_update = \"xpic\" and \"fmpm\" only".into(),
            ));
        }
        (update, None) => update,
    };
    let settings = mpm::Settings {
        shape: case.grid.shape.unwrap_or_default(),
        velocity_update,
        cfl: cfl(case),
        pressure: table.pressure.unwrap_or_default(),
        density_projection: table.density_projection.map(|length| length.cells(cell)),
        separation: (case.contact.as_ref())
            .and_then(|contact| contact.separation)
            .map(|length| length.cells(cell)),
    };
    settings.check().map_err(CaseError)?;
    Ok(settings)
}

fn implicit(case: &Case) -> Result<implicit::Settings, CaseError> {
    let table = &case.integrator;
    let stray = [
        (
            table.velocity_update.is_some(),
            "[integrator] velocity_update",
        ),
        (table.order.is_some(), "[integrator] order"),
        (table.pressure.is_some(), "[integrator] pressure"),
        (
            table.density_projection.is_some(),
            "[integrator] density_projection",
        ),
        (case.grid.shape.is_some(), "[grid] shape"),
        (
            case.contact
                .as_ref()
                .is_some_and(|c| c.separation.is_some()),
            "[contact] separation",
        ),
    ];
    if let Some((_, key)) = stray.iter().find(|(given, _)| *given) {
        return Err(CaseError(format!(
            "{key} is for scheme = \"explicit\" only"
        )));
    }
    let default = implicit::Settings::default();
    let settings = implicit::Settings {
        cfl: cfl(case),
        tolerance: table.tolerance.unwrap_or(default.tolerance),
        air_pressure: case.air.as_ref().map(|air| air.pressure.si()),
        air_leak_time: (case.air.as_ref())
            .and_then(|air| air.leak_time)
            .map_or(default.air_leak_time, |time| time.si()),
        dynamic_angle: case.adhesive.dynamic_angle.unwrap_or_default(),
    };
    settings.check().map_err(CaseError)?;
    Ok(settings)
}

/// Liquid particle-steps per second and thread of FLIP in a scene with walls, as measured
/// (docs/results/full-size.md).
const EXPLICIT_SPEED: f64 = 11e6;
/// What each further order of a velocity filter costs, in FLIP steps, by the same measurement.
const FILTER_ORDER: f64 = 0.32;
/// What an APIC step costs, in FLIP steps, by the same measurement.
const APIC_STEP: f64 = 1.3;

/// Latest over nominal end of a run whose clamp a pressure limit may hold.
fn latest(setup: &Setup) -> f64 {
    match setup.scene.clamp {
        Some(clamp) if clamp.max_pressure.is_some() => {
            (setup.time_limit_s / setup.nominal_duration_s).max(1.0)
        }
        _ => 1.0,
    }
}

/// Bytes of a point as it is handed to the implicit scheme: position, velocity and volume.
const POINT_BYTES: f64 = 56.0;

fn explicit_forecast(settings: &mpm::Settings, setup: &Setup) -> Result<Forecast, RunFailure> {
    let plan = mpm::Plan::new(&setup.scene, &setup.liquid, settings);
    let points = setup.liquid.points as f64;
    let cost = match settings.velocity_update {
        VelocityUpdate::Apic => APIC_STEP,
        update => 1.0 + FILTER_ORDER * f64::from(update.order() - 1),
    };
    let mut notes = vec![format!(
        "limits             acoustic {:.3e} s, viscous {:.3e} s; the Courant number {} is of the smaller",
        plan.acoustic_s, plan.viscous_s, settings.cfl
    )];
    if setup.scene.liquid.viscosity.largest() > plan.viscosity_cap {
        notes.push(format!(
            "viscosity cap      {:.3} Pa s: this step carries no more, and the table goes to {} Pa s",
            plan.viscosity_cap,
            setup.scene.liquid.viscosity.largest()
        ));
    }
    notes.extend(departures(settings));
    Ok(Forecast {
        dt_s: plan.dt_s,
        limit: plan.limit.to_string(),
        steps: plan.steps,
        // Its step does not grow while the clamp is held.
        most_steps: plan.steps * latest(setup),
        memory_bytes: plan.memory_bytes,
        step_s: points * cost / (EXPLICIT_SPEED * rayon::current_num_threads() as f64),
        notes,
        stages: plan.stages,
    })
}

/// What the settings change of the paper's method, none of it silently.
fn departures(settings: &mpm::Settings) -> Vec<String> {
    let mut list = Vec::new();
    if settings.pressure == PressureFrom::CellMean {
        list.push("pressure           from the mean J of each cell, not the paper's".to_owned());
    }
    if let Some(cells) = settings.density_projection {
        list.push(format!(
            "density projection after every {cells} cell of motion, not the paper's"
        ));
    }
    if let Some(cells) = settings.separation {
        list.push(format!(
            "contact separation {cells} cell, not the shape function's own"
        ));
    }
    list
}

fn implicit_forecast(settings: &implicit::Settings, setup: &Setup) -> Forecast {
    let plan = implicit::Plan::new(&setup.scene, &setup.liquid, settings);
    let mut notes = vec![format!(
        "unknowns           {:.2e} velocities and pressures in {:.2e} liquid cells",
        plan.unknowns, plan.liquid_cells
    )];
    notes.extend(settings.air_pressure.map(|pressure| {
        let kilopascals = pressure / 1e3;
        let leak = match settings.air_leak_time.is_finite() {
            true => format!(", leaking in {:.3e} s", settings.air_leak_time),
            false => String::new(),
        };
        format!("trapped air        closed off at {kilopascals} kPa (absolute){leak}: a pressure for each pocket")
    }));
    Forecast {
        dt_s: plan.dt_s,
        limit: "advective, cfl cell/|v|, shorter as the liquid gets faster".into(),
        steps: plan.steps,
        // Its step grows as the clamp slows down: what counts is the way.
        most_steps: plan.steps,
        memory_bytes: plan.memory_bytes + POINT_BYTES * setup.liquid.points as f64,
        step_s: plan.cpu_s / plan.steps / rayon::current_num_threads() as f64,
        notes,
        stages: plan.stages,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::tests::setup;

    #[test]
    fn threads_share_the_time_of_an_implicit_run() {
        let (mut setup, settings) = (setup(), implicit::Settings::default());
        // Half a cell of 1 um in 50 ns: 20 steps.
        setup.liquid.speed = 10.0;
        let plan = implicit::Plan::new(&setup.scene, &setup.liquid, &settings);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build();
        let forecast = (pool.unwrap()).install(|| implicit_forecast(&settings, &setup));
        assert!(forecast.steps > 2.0, "{}", forecast.steps);
        let run_s = forecast.step_s * forecast.steps;
        assert!((run_s / plan.cpu_s - 0.5).abs() < 1e-12, "{run_s} s");
    }
}

//! The scheme of a case, its settings and its forecast.

use implicit::Implicit;
use mpm::{Explicit, PressureFrom, VelocityUpdate};
use physics::{Choice, Scene, Scheme};

use crate::case::{Case, EdgeLength, SchemeName};
use crate::failure::{RunFailure, refused};
use crate::forecast::{Forecast, line};
use crate::resolve::Setup;

/// The Courant number of a case, or the default of its scheme.
pub(crate) fn cfl(case: &Case) -> f64 {
    case.integrator.cfl.unwrap_or_else(|| default_cfl(case))
}

/// The default Courant number of a case's scheme.
pub(crate) fn default_cfl(case: &Case) -> f64 {
    match case.integrator.scheme {
        SchemeName::Explicit => mpm::Settings::default().cfl,
        SchemeName::Implicit => implicit::Settings::default().cfl,
    }
}

/// The scheme in its initial state.
/// Errors: settings of the other scheme, and scenes that this scheme cannot compute.
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

/// The forecast of steps, time and memory.
pub(crate) fn forecast(case: &Case, setup: &Setup) -> Result<Forecast, RunFailure> {
    match case.integrator.scheme {
        SchemeName::Explicit => explicit_forecast(&explicit(case, setup.scene.grid.cell_m)?, setup),
        SchemeName::Implicit => {
            implicit::check(&setup.scene).map_err(RunFailure::Usage)?;
            Ok(implicit_forecast(&implicit(case)?, setup))
        }
    }
}

/// Refuses keys that only `scheme` has: names the first of `keys` that is given, and the reason.
fn refuse_stray(scheme: &str, keys: &[(bool, &str, &str)]) -> Result<(), RunFailure> {
    match keys.iter().find(|(given, ..)| *given) {
        None => Ok(()),
        Some((_, key, why)) => refused(format!("{key} is for scheme = \"{scheme}\" only{why}")),
    }
}

fn separation(case: &Case) -> Option<EdgeLength> {
    case.contact.as_ref()?.separation
}

fn explicit(case: &Case, cell: f64) -> Result<mpm::Settings, RunFailure> {
    let (table, adhesive) = (&case.integrator, &case.adhesive);
    let staged = case.clamp.as_ref().is_some_and(|c| !c.stage.is_empty());
    #[rustfmt::skip]
    let stray = [
        (table.tolerance.is_some(), "[integrator] tolerance", ""),
        (adhesive.cure.is_some(), "[adhesive.cure]", ": explicit runs are too short for cure"),
        (adhesive.water.is_some(), "[adhesive.water]", ": explicit runs are too short for loss of water"),
        (adhesive.surface_tension.is_some(), "[adhesive] surface_tension", ": explicit runs are too short for capillary flow"),
        (adhesive.dynamic_angle.is_some(), "[adhesive] dynamic_angle", ""),
        (case.air.is_some(), "[air]", ": the explicit scheme has no pressure outside the liquid"),
        (staged, "[[clamp.stage]]", ": explicit runs are too short for a press programme"),
    ];
    refuse_stray("implicit", &stray)?;
    let update = table.velocity_update.unwrap_or_default();
    let velocity_update = match (update, table.order.map(u32::from)) {
        (VelocityUpdate::Xpic(_), Some(order)) => VelocityUpdate::Xpic(order),
        (VelocityUpdate::Fmpm(_), Some(order)) => VelocityUpdate::Fmpm(order),
        (VelocityUpdate::Xpic(_) | VelocityUpdate::Fmpm(_), None) => {
            return refused(format!(
                "[integrator] velocity_update = \"{}\" needs an order, such as order = 5",
                update.name()
            ));
        }
        (_, Some(_)) => {
            return refused(
                "[integrator] order is for velocity_update = \"xpic\" and \"fmpm\" only",
            );
        }
        (update, None) => update,
    };
    let settings = mpm::Settings {
        shape: case.grid.shape.unwrap_or_default(),
        velocity_update,
        cfl: cfl(case),
        pressure: table.pressure.unwrap_or_default(),
        density_projection: table.density_projection.map(|length| length.edges(cell)),
        separation: separation(case).map(|length| length.edges(cell)),
    };
    settings.check().map_err(RunFailure::Usage)?;
    Ok(settings)
}

fn implicit(case: &Case) -> Result<implicit::Settings, RunFailure> {
    let table = &case.integrator;
    #[rustfmt::skip]
    let stray = [
        (table.velocity_update.is_some(), "[integrator] velocity_update", ""),
        (table.order.is_some(), "[integrator] order", ""),
        (table.pressure.is_some(), "[integrator] pressure", ""),
        (table.density_projection.is_some(), "[integrator] density_projection", ""),
        (case.grid.shape.is_some(), "[grid] shape", ""),
        (separation(case).is_some(), "[contact] separation", ""),
    ];
    refuse_stray("explicit", &stray)?;
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
    settings.check().map_err(RunFailure::Usage)?;
    Ok(settings)
}

/// Liquid particle-steps per second and thread of FLIP in a scene with walls, as measured
/// (docs/results/full-size.md).
const EXPLICIT_SPEED: f64 = 11e6;
/// Cost of each further order of a velocity filter, in FLIP steps, by the same measurement.
const FILTER_ORDER: f64 = 0.32;
/// Cost of an APIC step, in FLIP steps, by the same measurement.
const APIC_STEP: f64 = 1.3;

/// Latest over nominal end of a run: above 1 if a pressure limit may hold the clamp.
fn latest_over_nominal(setup: &Setup) -> f64 {
    match setup.scene.clamp {
        Some(clamp) if clamp.max_pressure.is_some() => {
            (setup.time_limit_s / setup.nominal_duration_s).max(1.0)
        }
        _ => 1.0,
    }
}

/// Bytes of an initial material point of the implicit scheme: position, velocity and volume.
const POINT_BYTES: f64 = 56.0;

fn explicit_forecast(settings: &mpm::Settings, setup: &Setup) -> Result<Forecast, RunFailure> {
    let plan = mpm::Plan::new(&setup.scene, &setup.liquid, settings);
    let points = setup.liquid.points as f64;
    let cost = match settings.velocity_update {
        VelocityUpdate::Apic => APIC_STEP,
        update => 1.0 + FILTER_ORDER * f64::from(update.order() - 1),
    };
    let mut notes = line(
        "limits",
        format!(
            "acoustic {:.3e} s, viscous {:.3e} s; the step is {} (Courant number) times the smaller",
            plan.acoustic_s, plan.viscous_s, settings.cfl
        ),
    );
    let (cap, largest) = (plan.viscosity_cap, setup.scene.liquid.viscosity.largest());
    if largest > cap {
        let said = format!(
            "{cap:.3} Pa s, the largest that is stable at this step; the law reaches {largest} Pa s"
        );
        notes += &line("viscosity cap", said);
    }
    notes += &departures(settings);
    Ok(Forecast {
        dt_s: plan.dt_s,
        limit: plan.limit.to_string(),
        steps: plan.steps,
        // The explicit step does not grow while the clamp is held.
        most_steps: plan.steps * latest_over_nominal(setup),
        memory_bytes: plan.memory_bytes,
        step_s: points * cost / (EXPLICIT_SPEED * rayon::current_num_threads() as f64),
        notes,
        stages: plan.stages,
    })
}

/// Lines on the settings that depart from the paper's method.
fn departures(settings: &mpm::Settings) -> String {
    let mut out = String::new();
    if settings.pressure == PressureFrom::CellMean {
        out += &line("pressure", "from the mean J of each cell, not the paper's");
    }
    if let Some(cells) = settings.density_projection {
        let said = format!("after every {cells} cell of motion, not the paper's");
        out += &line("density projection", said);
    }
    if let Some(cells) = settings.separation {
        let said = format!("{cells} cell, not the shape function's own");
        out += &line("contact separation", said);
    }
    out
}

fn implicit_forecast(settings: &implicit::Settings, setup: &Setup) -> Forecast {
    let plan = implicit::Plan::new(&setup.scene, &setup.liquid, settings);
    let mut notes = line(
        "unknowns",
        format!(
            "{:.2e} velocities and pressures in {:.2e} liquid cells",
            plan.unknowns, plan.liquid_cells
        ),
    );
    if let Some(pressure) = settings.air_pressure {
        let kilopascals = pressure / 1e3;
        let leak = match settings.air_leak_time.is_finite() {
            true => format!(", leaking in {:.3e} s", settings.air_leak_time),
            false => String::new(),
        };
        let said =
            format!("closed off at {kilopascals} kPa (absolute){leak}: a pressure for each pocket");
        notes += &line("trapped air", said);
        // Measured for hot presses and presses at 1 m/s.
        let longer =
            "a step takes two to six times the run time stated here (docs/results/press.md)";
        notes += &line("", longer);
    }
    Forecast {
        dt_s: plan.dt_s,
        limit: "advective (cfl cell/|v|), shorter where the liquid is faster".into(),
        steps: plan.steps,
        // The step grows as the clamp slows down: the number of steps follows from the travel.
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

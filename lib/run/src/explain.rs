//! `--explain`: the plan of a run as text.

use physics::{
    Choice, Cure, Dimensions, Motion, Press, PressStage, Regime, SET, Scene, Stop, Viscosity,
    VoxelBlock, WallLaw, Water, Wetting,
};
use units::shortened;

use crate::case::{Case, SchemeName};
use crate::forecast::{Forecast, line};
use crate::omissions::{Remark, omissions};
use crate::resolve::Setup;
use crate::room::room;
use crate::{chords, expected_error, summary};

/// The plan of a run.
pub(crate) fn text(case: &Case, setup: &Setup, forecast: &Forecast) -> String {
    let scheme = match case.integrator.scheme {
        SchemeName::Explicit => "explicit material point method",
        SchemeName::Implicit => "implicit, liquid as volume fractions",
    };
    let regime = Regime::of(&setup.scene, &setup.liquid).to_string();
    let regime: String = regime.lines().map(|line| format!("  {line}\n")).collect();
    let lines = |items: Vec<Remark>| -> String {
        (items.iter().map(|item| line(item.what, &item.why))).collect()
    };
    [
        "scene\n",
        &scene(setup),
        &line("scheme", scheme),
        "\ncost (estimated)\n",
        &cost(setup, forecast),
        &expected_error::text(case, setup.scene.grid.cell_m),
        &lines(chords::remarks(&setup.scene)),
        "\nregime\n",
        &regime,
        "\nleft out\n",
        &lines(omissions(case, setup, &forecast.stages)),
    ]
    .concat()
}

fn scene(setup: &Setup) -> String {
    let scene = &setup.scene;
    let [nx, ny, nz] = scene.grid.cells;
    let um = 1e6 * scene.grid.cell_m;
    let dimensions = match scene.dimensions {
        Dimensions::Two => "plane strain",
        Dimensions::Three => "3D",
    };
    let grid = format!("{nx} x {ny} x {nz} cells of {um:.4} um, {dimensions}");
    let mut out = line("grid", grid) + &liquid(setup) + &walls(scene);
    let [x, y, z] = scene.boundary.map(Choice::name);
    out += &line("sides", format!("x {x}, y {y}, z {z}"));
    for (index, stage) in scene.programme.iter().enumerate() {
        out += &line(&format!("stage {}", index + 1), stage_text(index, stage));
    }
    if let Some(clamp) = scene.clamp.filter(|_| scene.programme.is_empty()) {
        let limit = clamp.max_pressure.map_or("no pressure limit".into(), |p| {
            format!("at most {}", summary::pressure(p, 4))
        });
        out += &line(
            "clamp",
            format!("{} m/s, {limit}", shortened(clamp.closing_speed)),
        );
    }
    out += &line("end", end(setup));
    out.extend(room(setup).map(|room| line("voids", room)));
    out
}

/// The liquid and its laws.
fn liquid(setup: &Setup) -> String {
    let (liquid, cell_m) = (&setup.scene.liquid, setup.scene.grid.cell_m);
    let (points, volume) = (setup.liquid.points, setup.liquid.volume_m3);
    let amount = format!("{points} material points, {volume:.4e} m3");
    let mut out = line("liquid", amount);
    let viscosity = match &liquid.viscosity {
        Viscosity::Newtonian(law) => format!("{} Pa s", shortened(law.0)),
        Viscosity::Law(law) => law.to_string(),
        table => {
            let [rest, fast] = [0.0, 1e6].map(|rate| shortened(table.at(rate)));
            format!("table, {rest} Pa s at rest, {fast} Pa s at 1e6 1/s")
        }
    };
    let (density, bulk) = (shortened(liquid.density), liquid.tait.bulk_modulus);
    let laws = format!("{density} kg/m3, K {bulk:.3e} Pa, viscosity {viscosity}");
    out += &line("", laws);
    if let Some(cure) = &liquid.cure {
        let set = cure.set_at().map_or("never sets".to_owned(), |set| {
            format!("sets ({SET:e} times that) at {set:.4e} s")
        });
        let factor = cure.factor(0.0);
        let start = format!("viscosity times {factor:.4} at the start, {set}");
        out += &line("cure", start);
    }
    if let Some(wetting) = &liquid.wetting {
        out += &line("wetting", wetting_text(wetting, cell_m));
    }
    if let Some(water) = &liquid.water {
        out += &line("loss of water", drying_text(water, cell_m));
    }
    out
}

/// Wetting, with the capillary pressure in a slit six cells of `cell_m` (m) wide.
fn wetting_text(wetting: &Wetting, cell_m: f64) -> String {
    let way = match wetting.adhesion() >= 0.0 {
        true => "drawn in",
        false => "held back",
    };
    format!(
        "{:.4} N/m at {:.1} degrees: {way} with {:.3e} Pa in a slit of six cells",
        wetting.tension,
        wetting.contact_angle.to_degrees(),
        (2.0 * wetting.adhesion() / (6.0 * cell_m)).abs()
    )
}

/// Loss of water, with the times of drying and diffusion in a tube six cells of `cell_m` (m) wide without inflow.
fn drying_text(water: &Water, cell_m: f64) -> String {
    let radius = 3.0 * cell_m;
    let [start, least] = [water.start(), water.least()];
    let leaves = (start - least) / (1.0 + start);
    format!(
        "{:.1} to {:.1} % solids, viscosity times {:.4}; in a tube of six cells without flow, drying takes {:.3e} s and diffusion to the wall {:.1e} s",
        100.0 * water.solids(start),
        100.0 * water.solids(least),
        water.factor(least),
        0.5 * radius * leaves / water.uptake(),
        radius * radius / water.diffusivity()
    )
}

/// The rigid bodies and the wall law.
fn walls(scene: &Scene) -> String {
    let mut out = String::new();
    for body in &scene.bodies {
        let name = &body.name;
        let solid: u64 = body.blocks.iter().map(VoxelBlock::count).sum();
        let motion = match body.motion {
            Motion::Fixed => "at rest".to_owned(),
            Motion::Constant(v) => {
                let [x, y, z] = v.map(shortened);
                format!("moves at ({x}, {y}, {z}) m/s")
            }
            Motion::Clamped => "driven by the clamp".to_owned(),
        };
        out += &line("rigid body", format!("{name}: {solid} voxels, {motion}"));
    }
    let law = match scene.wall {
        _ if scene.bodies.is_empty() => return out,
        WallLaw::PartialSlip {
            influence_length_m: length,
        } => {
            let k = 1.0 / length;
            format!("partial slip, influence length {length:.4e} m (k = {k:.3e} 1/m)")
        }
        law => law.name().to_owned(),
    };
    out + &line("walls", law)
}

/// When the run ends.
fn end(setup: &Setup) -> String {
    let scene = &setup.scene;
    let latest = setup.time_limit_s;
    match scene.stop {
        Stop::Closed { travel_m } if !scene.programme.is_empty() => {
            let set = scene.liquid.cure.as_ref().and_then(Cure::set_at);
            format!(
                "with the last stage, at {:.4e} s at the latest; the clamp stops after {:.2} um of travel",
                set.map_or(latest, |set| set.min(latest)),
                travel_m * 1e6
            )
        }
        Stop::Time(t) => format!("at {t:.4e} s"),
        Stop::Closed { travel_m } => format!(
            "closed after {:.2} um of travel, at {latest:.4e} s at the latest",
            travel_m * 1e6
        ),
    }
}

/// A stage of a press programme.
fn stage_text(index: usize, stage: &PressStage) -> String {
    let mut said = format!(
        "{} (--set clamp.stage.{index}...), at most {:.4e} m/s",
        stage.kind.name(),
        stage.speed
    );
    if let Some(pressure) = stage.pressure {
        let where_to = match stage.kind {
            Press::Approach => "until",
            Press::Ramp => "to",
            Press::Hold | Press::Release => "at",
        };
        said += &format!(", {where_to} {}", summary::pressure(pressure, 4));
    }
    if stage.contact {
        said += ", until liquid presses on the clamp's body";
    }
    if let Some(travel) = stage.travel_m {
        said += &format!(", until {:.4} um of travel", 1e6 * travel);
    }
    if let Some(slower) = stage.slower {
        said += &format!(", until slower than {slower:.4e} m/s");
    }
    said + &format!(", for at most {:.4e} s", stage.time_s)
}

fn cost(setup: &Setup, forecast: &Forecast) -> String {
    let [steps, time] = steps(setup, forecast);
    let threads = rayon::current_num_threads();
    let mut out = [
        line(
            "time step",
            format!("{:.4e} s, set by {}", forecast.dt_s, forecast.limit),
        ),
        line("steps", steps),
        line("memory", machine::bytes(forecast.memory_bytes as u64)),
        line("run time", format!("{time} on {threads} threads")),
    ]
    .concat();
    out += &forecast.notes;
    if let Some(excess) = forecast.excess() {
        out += &line("refused", format!("unless --yes-really is given: {excess}"));
    }
    out
}

/// Number of steps, and run time.
fn steps(setup: &Setup, forecast: &Forecast) -> [String; 2] {
    if !setup.scene.programme.is_empty() {
        let not = "no forecast for a press programme: tens to hundreds (docs/results/press.md), more with surface tension";
        return [not.into(), format!("{:.1e} s a step", forecast.step_s)];
    }
    let set = setup.scene.liquid.cure.as_ref().and_then(Cure::set_at);
    let end_s = setup.nominal_duration_s.min(set.unwrap_or(f64::INFINITY));
    let held = match forecast.most_steps > forecast.steps {
        true => format!(
            ", at most {} where the pressure limit holds the clamp",
            count(forecast.most_steps)
        ),
        false => String::new(),
    };
    [
        format!("about {} until {end_s:.4e} s{held}", count(forecast.steps)),
        cli::duration(forecast.steps * forecast.step_s),
    ]
}

/// A number of steps, in full below 1e9.
fn count(steps: f64) -> String {
    if steps < 1e9 {
        format!("{steps:.0}")
    } else {
        format!("{steps:.2e}")
    }
}

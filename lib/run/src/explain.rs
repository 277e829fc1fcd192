//! `--explain`: the plan of a run as text.

use std::fmt::Write;

use physics::{
    Choice, Cure, Dimensions, Motion, Press, PressStage, Regime, SET, Scene, Stop, Viscosity,
    WallLaw, Water,
};

use crate::case::{Case, SchemeName};
use crate::forecast::{Forecast, duration};
use crate::left_out::left_out;
use crate::resolve::Setup;
use crate::{chords, expected_error};

/// What the loss of water does in a tube of six cells of `cell_m` that nothing flows into.
fn dried(water: &Water, cell_m: f64) -> String {
    let radius = 3.0 * cell_m;
    let [start, least] = [water.start(), water.least()];
    let leaves = (start - least) / (1.0 + start);
    format!(
        "{:.1} to {:.1} % solids, viscosity times {:.4}; a tube of six cells at rest is there after {:.3e} s, its middle feeds its wall within {:.1e} s",
        100.0 * water.solids(start),
        100.0 * water.solids(least),
        water.factor(least),
        0.5 * radius * leaves / water.uptake(),
        radius * radius / water.diffusivity()
    )
}

/// The plan of a run.
pub(crate) fn text(case: &Case, setup: &Setup, forecast: &Forecast) -> String {
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = scene(&mut out, case, setup);
    let _ = cost(&mut out, setup, forecast);
    out.push_str(&expected_error::text(case, setup.scene.grid.cell_m));
    out.push_str(&chords::text(&setup.scene));
    let _ = writeln!(
        out,
        "\nregime\n{}",
        indent(&Regime::of(&setup.scene, &setup.liquid).to_string())
    );
    let _ = writeln!(out, "\nleft out");
    for item in left_out(case, setup, &forecast.stages) {
        let _ = writeln!(out, "  {:<18} {}", item.what, item.why);
    }
    out
}

fn indent(text: &str) -> String {
    text.lines()
        .map(|l| format!("  {l}"))
        .collect::<Vec<_>>()
        .join("\n")
}

fn scene(out: &mut String, case: &Case, setup: &Setup) -> std::fmt::Result {
    let scene = &setup.scene;
    let [nx, ny, nz] = scene.grid.cells;
    let um = 1e6 * scene.grid.cell_m;
    writeln!(out, "scene")?;
    let dimensions = match scene.dimensions {
        Dimensions::Two => "plane strain",
        Dimensions::Three => "3D",
    };
    writeln!(
        out,
        "  grid               {nx} x {ny} x {nz} cells of {um:.4} um, {dimensions}"
    )?;
    liquid_lines(out, setup)?;
    wall_lines(out, scene)?;
    let [x, y, z] = scene.boundary.map(Choice::name);
    writeln!(out, "  sides              x {x}, y {y}, z {z}")?;
    for (index, stage) in scene.programme.iter().enumerate() {
        writeln!(out, "  stage {:<12} {}", index + 1, told(stage))?;
    }
    if let Some(clamp) = scene.clamp.filter(|_| scene.programme.is_empty()) {
        let limit = clamp.max_pressure.map_or("no pressure limit".into(), |p| {
            format!("at most {:.4} MPa", p / 1e6)
        });
        writeln!(
            out,
            "  clamp              {} m/s, {limit}",
            clamp.closing_speed
        )?;
    }
    writeln!(out, "  end                {}", end(setup))?;
    let scheme = match case.integrator.scheme {
        SchemeName::Explicit => "explicit material point method",
        SchemeName::Implicit => "implicit, liquid as volume fractions",
    };
    writeln!(out, "  scheme             {scheme}")
}

/// What the liquid is and does.
fn liquid_lines(out: &mut String, setup: &Setup) -> std::fmt::Result {
    let scene = &setup.scene;
    writeln!(
        out,
        "  liquid             {} material points, {:.4e} m3",
        setup.liquid.points, setup.liquid.volume_m3
    )?;
    let liquid = &scene.liquid;
    let viscosity = match &liquid.viscosity {
        Viscosity::Newtonian(law) => format!("{} Pa s", law.0),
        Viscosity::Law(law) => law.to_string(),
        table => format!(
            "table, {} Pa s at rest, {} Pa s at 1e6 1/s",
            table.at(0.0),
            table.at(1e6)
        ),
    };
    writeln!(
        out,
        "                     {} kg/m3, K {:.3e} Pa, viscosity {viscosity}",
        liquid.density, liquid.tait.bulk_modulus
    )?;
    if let Some(cure) = &liquid.cure {
        let set = cure.set_at().map_or("never sets".to_owned(), |set| {
            format!("sets ({SET:e} times that) at {set:.4e} s")
        });
        writeln!(
            out,
            "  cure               viscosity times {:.4} at the start, {set}",
            cure.factor(0.0)
        )?;
    }
    if let Some(wetting) = &liquid.wetting {
        writeln!(
            out,
            "  wetting            {:.4} N/m at {:.1} degrees: it is {} with {:.3e} Pa in a slit of six cells",
            wetting.tension,
            wetting.contact_angle.to_degrees(),
            if wetting.adhesion() >= 0.0 {
                "drawn in"
            } else {
                "held back"
            },
            (2.0 * wetting.adhesion() / (6.0 * scene.grid.cell_m)).abs()
        )?;
    }
    if let Some(water) = &liquid.water {
        writeln!(
            out,
            "  loss of water      {}",
            dried(water, scene.grid.cell_m)
        )?;
    }
    Ok(())
}

/// What is rigid.
fn wall_lines(out: &mut String, scene: &Scene) -> std::fmt::Result {
    for body in &scene.bodies {
        let solid: u64 = body.blocks.iter().map(physics::VoxelBlock::count).sum();
        let motion = match body.motion {
            Motion::Fixed => "at rest".to_owned(),
            Motion::Constant(v) => format!("moves at ({}, {}, {}) m/s", v[0], v[1], v[2]),
            Motion::Clamped => "driven by the clamp".to_owned(),
        };
        writeln!(
            out,
            "  rigid body         {}: {solid} voxels, {motion}",
            body.name
        )?;
    }
    if !scene.bodies.is_empty() {
        let law = match scene.wall {
            WallLaw::PartialSlip { influence_length_m } => {
                format!(
                    "partial slip, influence length {:.4e} m (k = {:.3e} 1/m)",
                    influence_length_m,
                    1.0 / influence_length_m
                )
            }
            law => law.name().to_owned(),
        };
        writeln!(out, "  walls              {law}")?;
    }
    Ok(())
}

/// When the run ends.
fn end(setup: &Setup) -> String {
    let scene = &setup.scene;
    match scene.stop {
        Stop::Closed { travel_m } if !scene.programme.is_empty() => format!(
            "with the last stage, at the latest at {:.4e} s; the clamp stands after {:.2} um of travel",
            (scene.liquid.cure.as_ref().and_then(|cure| cure.set_at()))
                .map_or(setup.time_limit_s, |set| set.min(setup.time_limit_s)),
            travel_m * 1e6
        ),
        Stop::Time(t) => format!("at {t:.4e} s"),
        Stop::Closed { travel_m } => {
            format!(
                "closed after {:.2} um of travel, at the latest at {:.4e} s",
                travel_m * 1e6,
                setup.time_limit_s
            )
        }
    }
}

/// A stage of a press programme.
fn told(stage: &PressStage) -> String {
    let mut said = format!("{}, at most {:.4e} m/s", stage.kind.name(), stage.speed);
    if let Some(pressure) = stage.pressure {
        said += &match stage.kind {
            Press::Approach => format!(", until {:.4} MPa", 1e-6 * pressure),
            Press::Ramp => format!(", to {:.4} MPa", 1e-6 * pressure),
            Press::Hold | Press::Release => format!(", at {:.4} MPa", 1e-6 * pressure),
        };
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
    said + &format!(", {:.4e} s at the longest", stage.time_s)
}

fn cost(out: &mut String, setup: &Setup, forecast: &Forecast) -> std::fmt::Result {
    let set = setup.scene.liquid.cure.as_ref().and_then(Cure::set_at);
    writeln!(out, "\ncost (estimated)")?;
    writeln!(
        out,
        "  time step          {:.4e} s, set by {}",
        forecast.dt_s, forecast.limit
    )?;
    writeln!(
        out,
        "  steps              about {} to {:.4e} s{}",
        count(forecast.steps),
        setup.nominal_duration_s.min(set.unwrap_or(f64::INFINITY)),
        if forecast.most_steps > forecast.steps {
            format!(
                ", at most {} where the pressure limit holds the clamp",
                count(forecast.most_steps)
            )
        } else {
            String::new()
        }
    )?;
    writeln!(
        out,
        "  memory             {:.0} MB",
        forecast.memory_bytes / 1e6
    )?;
    writeln!(
        out,
        "  run time           {} on {} threads",
        duration(forecast.steps * forecast.step_s),
        rayon::current_num_threads()
    )?;
    for note in &forecast.notes {
        writeln!(out, "  {note}")?;
    }
    if let Some(excess) = forecast.excess() {
        writeln!(
            out,
            "  refused            unless --yes-really is given: {excess}"
        )?;
    }
    Ok(())
}

/// A number of steps, in full where it is readable.
fn count(steps: f64) -> String {
    if steps < 1e9 {
        format!("{steps:.0}")
    } else {
        format!("{steps:.2e}")
    }
}

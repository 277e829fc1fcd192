//! What a run does not compute because its scene does not need it, and why.

use physics::{Boundary, Dimensions, Regime, Viscosity, WallLaw};

use crate::case::{Integrator, SchemeName, UpdateName};
use crate::resolve::Setup;

/// One thing left out.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct LeftOut {
    /// What.
    pub what: &'static str,
    /// Why, in a few words with numbers.
    pub why: String,
}

/// Everything a run leaves out.
pub(crate) fn left_out(setup: &Setup, integrator: &Integrator, snapshots: bool) -> Vec<LeftOut> {
    let scene = &setup.scene;
    let mut list = Vec::new();
    let mut add = |what, why: String| list.push(LeftOut { what, why });
    if scene.dimensions == Dimensions::Two {
        add(
            "third dimension",
            "plane strain: one layer of cells, no z velocity".into(),
        );
    }
    if scene.bodies.is_empty() {
        add("wall contact", "the scene has no rigid body".into());
    } else if scene.wall == WallLaw::Frictionless {
        add("wall friction", "frictionless walls (k = 0)".into());
    }
    if let Viscosity::Newtonian(law) = &scene.liquid.viscosity {
        add(
            "viscosity table",
            format!("Newtonian liquid, {} Pa s", law.0),
        );
    }
    if scene.gravity == [0.0; 3] {
        add("body force", "no [gravity]".into());
    }
    match scene.clamp {
        None => add("clamp control", "no [clamp]".into()),
        Some(clamp) if clamp.max_pressure.is_none() => {
            add(
                "load control",
                "constant closing speed: no max_pressure".into(),
            );
        }
        Some(_) => {}
    }
    if scene.boundary.iter().all(|&b| b != Boundary::Periodic) {
        add("periodic images", "no periodic side".into());
    }
    if !snapshots {
        add(
            "shear rate of points between snapshots",
            "no snapshots asked for".into(),
        );
    }
    let regime = Regime::of(scene, &setup.liquid);
    add(
        "wood deformation",
        "adherends are rigid (paper section 2.2)".into(),
    );
    add("trapped air", "voids are empty: p = 0".into());
    let capillary = match regime.max_pressure {
        Some(limit) => format!(
            "{:.1} kPa in a six-cell lumen, {:.2} % of the pressure limit",
            regime.capillary_pressure / 1e3,
            100.0 * regime.capillary_pressure / limit
        ),
        None => format!(
            "{:.1} kPa in a six-cell lumen",
            regime.capillary_pressure / 1e3
        ),
    };
    add("capillary pressure", capillary);
    let filtered = matches!(
        integrator.velocity_update,
        Some(UpdateName::Xpic | UpdateName::Fmpm)
    );
    if integrator.scheme == SchemeName::Explicit && !filtered {
        add(
            "velocity filter",
            "only xpic and fmpm pass velocities between points and nodes again".into(),
        );
    }
    if integrator.scheme == SchemeName::Implicit {
        add(
            "sound waves",
            format!(
                "Mach {:.1e}: the step follows the flow, not the sound",
                regime.mach
            ),
        );
    }
    list
}

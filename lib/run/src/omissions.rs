//! Omissions of a run and their reasons: stages that its scheme does without, and physics that is not modelled.

use physics::{Boundary, Dimensions, Regime, Stages};

use crate::case::{AirTable, Case, SchemeName};
use crate::resolve::Setup;

/// Name of the remark on air that mirror or periodic sides close off.
pub(crate) const BEYOND_SIDES: &str = "beyond the sides";
/// Uncertainty of WP due to such air.
pub(crate) const UNCERTAIN: &str =
    "with an error of up to its difference from the same run without [air]";

/// A remark on a run: something it leaves out, or lumens of few cells.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Remark {
    /// Subject.
    pub what: &'static str,
    /// Reason, in a few words with numbers.
    pub why: String,
}

/// All omissions of a run; `stages` are those of its scheme.
pub(crate) fn omissions(case: &Case, setup: &Setup, stages: &Stages) -> Vec<Remark> {
    let regime = Regime::of(&setup.scene, &setup.liquid);
    let absent = |stage: &physics::Stage| {
        let why = stage.absent.clone()?;
        Some(Remark {
            what: stage.name,
            why,
        })
    };
    let mut list: Vec<Remark> = stages.iter().filter_map(absent).collect();
    let mut add = |what, why: String| list.push(Remark { what, why });
    add(
        "wood deformation",
        "adherends are rigid (paper section 2.2)".into(),
    );
    match &case.air {
        None => add("trapped air", "voids are empty (p = 0): no [air]".into()),
        Some(air) if closes_off(air, setup) => add(
            BEYOND_SIDES,
            format!(
                "the sides of the specimen trap air in lumens, which diverts liquid into the few open ones: WP is {UNCERTAIN}; give leak_time for lumens that continue beyond the sides"
            ),
        ),
        Some(_) => {}
    }
    if setup.scene.liquid.cure.is_none() {
        add(
            "cure",
            "the viscosity does not change with time: no [adhesive.cure]".into(),
        );
    }
    if setup.scene.liquid.water.is_none() {
        add(
            "loss of water",
            "the adhesive keeps its water: no [adhesive.water]".into(),
        );
    }
    if setup.scene.liquid.wetting.is_none() {
        let share = regime.max_pressure.map_or(String::new(), |limit| {
            let percent = 100.0 * regime.capillary_pressure / limit;
            format!(", {percent:.2} % of the pressure limit")
        });
        let lumen = regime.capillary_pressure / 1e3;
        add(
            "capillary pressure",
            format!("{lumen:.1} kPa in a six-cell lumen{share}: no surface_tension"),
        );
    }
    if case.integrator.scheme != SchemeName::Explicit {
        add(
            "sound waves",
            format!(
                "Mach {:.1e}: time steps follow the flow, not the sound",
                regime.mach
            ),
        );
    }
    list
}

/// Whether the sides of the specimen trap air: a side along the bond is not open, and the leak time exceeds the run.
fn closes_off(air: &AirTable, setup: &Setup) -> bool {
    let [x, _, z] = setup.scene.boundary;
    let solid = setup.scene.dimensions == Dimensions::Three;
    let open = x == Boundary::Open && (!solid || z == Boundary::Open);
    let leak_time = air.leak_time.map_or(f64::INFINITY, |time| time.si());
    !open && leak_time > setup.time_limit_s
}

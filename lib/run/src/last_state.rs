//! The end of a run: its last state judged and measured.

use physics::{Cure, LiquidState, Scheme};

use crate::bond_measures::Watch;
use crate::case::Case;
use crate::courant::Courant;
use crate::expected_error;
use crate::failure::RunFailure;
use crate::invariants;
use crate::left_out::LeftOut;
use crate::resolve::Setup;
use crate::snapshot::in_file_axes;
use crate::summary::{self, Facts, Summary};
use crate::time_loop::Outcome;
use crate::verdict;

/// What a summary repeats of the run as it was asked for.
pub(crate) struct Asked {
    pub(crate) courant_numbers: Vec<Courant>,
    pub(crate) left_out: Vec<LeftOut>,
    pub(crate) provenance: serde_json::Value,
}

/// The summary of a run, its liquid in the axes of the bond file, and the displacements of its bodies (m). The
/// scheme, most of a run's memory, is gone before the liquid is measured.
///
/// # Errors
/// A bond file that cannot be read any more.
pub(crate) fn conclude(
    case: &Case,
    setup: &Setup,
    scheme: Box<dyn Scheme>,
    outcome: &Outcome,
    watch: Option<&Watch>,
    asked: Asked,
) -> Result<(Summary, LiquidState, Vec<[f64; 3]>), RunFailure> {
    let (mut liquid, displacements) = (scheme.liquid(), scheme.displacements());
    let (stages, counts) = (scheme.stage_times(), scheme.counts());
    let programme = summary::programme(scheme.programme());
    let (objection, follows) = (scheme.objection(), scheme.follows_points());
    drop(scheme);
    let (begun_m3, water) = (setup.liquid.volume_m3, outcome.diagnostics.water);
    let invariants = invariants::check(&setup.scene, begun_m3, &liquid, &displacements)
        .with_water(water, begun_m3);
    let lost = outcome.clock.last.lost;
    let verdict = verdict::judge(setup, &liquid, &invariants, water, lost, follows).and(objection);
    in_file_axes(&mut liquid, setup.normal);
    let penetration = watch
        .map(|watch| watch.look_closely(&liquid, &displacements))
        .transpose()?;
    let facts = Facts {
        courant_numbers: asked.courant_numbers,
        liquid_points: setup.liquid.points,
        initial_gap_m: setup.initial_gap_m,
        stages,
        counts,
        verdict,
        programme,
        penetration,
        set_s: setup.scene.liquid.cure.as_ref().and_then(Cure::set_at),
        invariants,
        expected_error: expected_error::of(case, setup.scene.grid.cell_m),
        left_out: asked.left_out,
        provenance: asked.provenance,
    };
    Ok((Summary::new(outcome, facts), liquid, displacements))
}

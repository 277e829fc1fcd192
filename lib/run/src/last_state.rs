//! The last state of a run, judged and measured for its summary.

use physics::{Cure, LiquidState, Scheme, StageTime};
use serde_json::json;

use crate::bond_measures::BondMeter;
use crate::failure::RunFailure;
use crate::invariants;
use crate::outlook::outlook;
use crate::resolve::Setup;
use crate::snapshot::in_file_axes;
use crate::summary::{self, Preliminaries, Summary};
use crate::time_loop::Outcome;
use crate::verdict;

/// Returns the summary, the liquid in the axes of the bond file, and the displacements of the bodies (m). `history` is the
/// text of the history, for press programmes. The scheme, which takes most of the memory, is dropped before the liquid is
/// measured.
pub(crate) fn summarise(
    setup: &Setup,
    scheme: Box<dyn Scheme>,
    outcome: Outcome,
    meter: Option<&BondMeter>,
    preliminaries: Preliminaries,
    history: &str,
) -> Result<(Summary, LiquidState, Vec<[f64; 3]>), RunFailure> {
    let (mut liquid, displacements) = (scheme.liquid(), scheme.displacements());
    let (stages, counts) = (scheme.stage_times(), scheme.counts());
    let programme = summary::ended_stages(scheme.programme(), history);
    let stage = |time: &StageTime| json!({ "name": time.name, "wall_s": time.wall_s });
    let (objection, follows) = (scheme.objection(), scheme.follows_points());
    drop(scheme);
    let (begun_m3, diagnostics) = (setup.liquid.volume_m3, outcome.diagnostics);
    let (clock, water) = (outcome.clock, diagnostics.water);
    let lost = clock.last_step.lost;
    let invariants = invariants::check(&setup.scene, begun_m3, &liquid, &displacements)
        .with_water(water, begun_m3);
    let verdict = verdict::judge(setup, &liquid, &invariants, water, lost, follows).and(objection);
    in_file_axes(&mut liquid, setup.normal);
    let penetration = meter
        .map(|meter| meter.measure_state(&liquid, &displacements, lost))
        .transpose()?;
    let wall = outcome.stepping.as_secs_f64();
    let work = outcome.steps_here as f64 * setup.liquid.points as f64;
    let summary = Summary {
        end: outcome.end,
        verdict,
        steps: clock.step,
        courant_numbers: outcome.courant,
        time_s: clock.time_s,
        travel_m: clock.travel_m,
        gap_m: setup.initial_gap_m.map(|g| g - clock.travel_m),
        final_pressure_pa: clock.last_step.pressure_top,
        liquid_points: setup.liquid.points,
        points_left: lost,
        kinetic_energy_j: diagnostics.kinetic_energy,
        capped_viscosity_fraction: diagnostics.capped_fraction,
        stepping_wall_s: wall,
        cpu_s: machine::cpu_seconds(),
        threads: rayon::current_num_threads(),
        particle_steps_per_s: if wall > 0.0 { work / wall } else { 0.0 },
        peak_memory_bytes: machine::peak_memory_bytes(),
        programme,
        penetration,
        outlook: outlook(outcome.end, &clock, setup.initial_gap_m, preliminaries.room),
        set_s: setup.scene.liquid.cure.as_ref().and_then(Cure::set_at),
        stages: stages.iter().map(stage).collect(),
        counts: counts.into_iter().collect(),
        invariants,
        preliminaries,
    };
    Ok((summary, liquid, displacements))
}

//! `summary.json`: what a run was, did and cost.

use std::collections::BTreeMap;

use physics::{Choice, Diagnostics, PressRun, StageTime};
use serde::Serialize;

use crate::bond_measures::Answers;
use crate::courant::Courant;
use crate::ends::End;
use crate::expected_error::ExpectedError;
use crate::invariants::Invariants;
use crate::left_out::LeftOut;
use crate::time_loop::Outcome;
use crate::verdict::Verdict;

/// Content of `summary.json`.
#[derive(Debug, Serialize)]
pub struct Summary {
    /// How the run ended.
    pub end: End,
    /// Whether the last state is sound.
    pub verdict: Verdict,
    /// Steps since the start.
    pub steps: u64,
    /// Which of them were taken at which Courant number.
    pub courant_numbers: Vec<Courant>,
    /// Simulated time, s.
    pub time_s: f64,
    /// Clamp travel, m.
    pub travel_m: f64,
    /// Gap left, m.
    pub gap_m: Option<f64>,
    /// Pressure on the upper body, which a clamp drives and controls, in the last step, Pa.
    pub final_pressure_pa: f64,
    /// Liquid material points.
    pub liquid_points: u64,
    /// Of them, those that left the domain.
    pub points_left: u64,
    /// Kinetic energy of the liquid at the end, J.
    pub kinetic_energy_j: f64,
    /// Volume fraction whose viscosity was capped in the last step.
    pub capped_viscosity_fraction: f64,
    /// Wall time of this process in steps, s.
    pub stepping_wall_s: f64,
    /// CPU time of this process, s.
    pub cpu_s: Option<f64>,
    /// Worker threads.
    pub threads: usize,
    /// Liquid material points times steps per second of wall time.
    pub particle_steps_per_s: f64,
    /// Largest resident memory, bytes.
    pub peak_memory_bytes: Option<u64>,
    /// How the stages of a press programme ended.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub programme: Vec<PressedStage>,
    /// What the press has come to, of a bond in three dimensions.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub penetration: Option<Answers>,
    /// When the adhesive sets, s: the run ends there. Of a liquid that does.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub set_s: Option<f64>,
    /// Wall time per stage of a step, s.
    pub stages: Vec<Stage>,
    /// How often the scheme had to step in.
    pub counts: BTreeMap<&'static str, u64>,
    /// Checks of the final state.
    pub invariants: Invariants,
    /// What was measured of the error of its scheme and options.
    pub expected_error: ExpectedError,
    /// What the run did not compute, and why.
    pub left_out: Vec<LeftOut>,
    /// What made this run folder.
    pub provenance: serde_json::Value,
}

/// `summary.json` of a run that failed: what its folder has to say of it.
#[derive(Debug, Serialize)]
pub(crate) struct Failed {
    /// `failed`.
    pub end: &'static str,
    /// Not sound, with the sentence that the run ended with.
    pub verdict: Verdict,
    /// Steps that were good.
    pub steps: u64,
    /// Time they came to, s.
    pub time_s: f64,
    /// As of a run that ended.
    pub expected_error: ExpectedError,
    /// As of a run that ended.
    pub left_out: Vec<LeftOut>,
    /// What made this run folder.
    pub provenance: serde_json::Value,
}

/// How a stage of a press programme ended.
#[derive(Debug, Serialize)]
pub struct PressedStage {
    /// What it did.
    pub kind: &'static str,
    /// What ended it.
    pub ended_by: &'static str,
    /// When, s since the start of the run.
    pub end_s: f64,
    /// Clamp travel then, m.
    pub travel_m: f64,
    /// Pressure on the clamp's body then, Pa.
    pub pressure_pa: f64,
}

/// How the stages of a programme ended so far.
pub(crate) fn programme(run: Option<&PressRun>) -> Vec<PressedStage> {
    let stages = run.into_iter().flat_map(PressRun::ended);
    let ended = stages.map(|(stage, end)| PressedStage {
        kind: stage.kind.name(),
        ended_by: end.reason.name(),
        end_s: end.time_s,
        travel_m: end.travel_m,
        pressure_pa: end.pressure,
    });
    ended.collect()
}

/// A summary as text.
pub(crate) fn text(summary: &impl Serialize) -> String {
    serde_json::to_string_pretty(summary).unwrap_or_default() + "\n"
}

/// A time (s) in the unit that suits it, with `digits` behind the point.
pub(crate) fn time(seconds: f64, digits: usize) -> String {
    match seconds {
        s if s < 1e-2 => format!("{:.digits$} us", s * 1e6),
        s if s < 600.0 => format!("{s:.digits$} s"),
        s => format!("{:.digits$} min", s / 60.0),
    }
}

/// Wall time of one stage.
#[derive(Debug, Serialize)]
pub struct Stage {
    /// Name.
    pub name: &'static str,
    /// Seconds.
    pub wall_s: f64,
}

/// What a summary needs beside the loop's outcome.
pub(crate) struct Facts {
    pub courant_numbers: Vec<Courant>,
    pub liquid_points: u64,
    pub initial_gap_m: Option<f64>,
    pub stages: Vec<StageTime>,
    pub counts: Vec<(&'static str, u64)>,
    pub verdict: Verdict,
    pub programme: Vec<PressedStage>,
    pub penetration: Option<Answers>,
    pub set_s: Option<f64>,
    pub invariants: Invariants,
    pub expected_error: ExpectedError,
    pub left_out: Vec<LeftOut>,
    pub provenance: serde_json::Value,
}

impl Summary {
    pub(crate) fn new(outcome: &Outcome, facts: Facts) -> Self {
        let Diagnostics {
            kinetic_energy,
            capped_fraction,
            ..
        } = outcome.diagnostics;
        let last = outcome.clock.last;
        let wall = outcome.stepping.as_secs_f64();
        let work = outcome.steps_here as f64 * facts.liquid_points as f64;
        Self {
            end: outcome.end,
            verdict: facts.verdict,
            steps: outcome.clock.step,
            courant_numbers: facts.courant_numbers,
            time_s: outcome.clock.time_s,
            travel_m: outcome.clock.travel_m,
            gap_m: facts.initial_gap_m.map(|g| g - outcome.clock.travel_m),
            final_pressure_pa: last.pressure_top,
            liquid_points: facts.liquid_points,
            points_left: last.lost,
            kinetic_energy_j: kinetic_energy,
            capped_viscosity_fraction: capped_fraction,
            stepping_wall_s: wall,
            cpu_s: machine::cpu_seconds(),
            threads: rayon::current_num_threads(),
            particle_steps_per_s: if wall > 0.0 { work / wall } else { 0.0 },
            peak_memory_bytes: machine::peak_memory_bytes(),
            programme: facts.programme,
            penetration: facts.penetration,
            set_s: facts.set_s,
            stages: facts
                .stages
                .iter()
                .map(|s| Stage {
                    name: s.name,
                    wall_s: s.wall_s,
                })
                .collect(),
            counts: facts.counts.into_iter().collect(),
            invariants: facts.invariants,
            expected_error: facts.expected_error,
            left_out: facts.left_out,
            provenance: facts.provenance,
        }
    }

    /// One sentence for the terminal.
    pub fn sentence(&self) -> String {
        let end = match self.end {
            End::Closed => "closed",
            End::Time => "reached its time",
            End::Programme => "went through its press programme",
            End::TimeLimit => "reached its time limit before closing",
            End::Set => "ended because the adhesive has set",
            End::Interrupted => "was interrupted",
        };
        let gap = self.gap_m.map_or(String::new(), |g| {
            format!(", gap {:.2} um", g.max(0.0) * 1e6)
        });
        let line = self.penetration.as_ref().map_or(String::new(), |found| {
            let line = match found.bond_line.as_str() {
                "filled" => String::new(),
                other => format!(", bond line {other}"),
            };
            match found.outer_face_reached {
                true => line + ", adhesive at the outer face of the wood",
                false => line,
            }
        });
        let left = match self.points_left {
            0 => String::new(),
            n => format!(" ({n} points left through open sides)"),
        };
        format!(
            "The run {end} after {} steps at {}{gap}{line}, {:.3} MPa; volume {:+.3} %{left}, {} points in wood (deepest {:.3} um), {} in unreachable voids; {:.1} s, {:.2} M particle-steps/s; {}.",
            self.steps,
            time(self.time_s, 2),
            self.final_pressure_pa / 1e6,
            100.0 * self.invariants.volume_change,
            self.invariants.points_in_wood,
            self.invariants.deepest_m * 1e6,
            self.invariants.points_in_unreachable_voids,
            self.stepping_wall_s,
            self.particle_steps_per_s / 1e6,
            if self.verdict.sound {
                "sound"
            } else {
                "not sound"
            },
        )
    }
}

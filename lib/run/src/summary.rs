//! `summary.json`: end, verdict, measures and cost of a run.

use std::collections::BTreeMap;

use bondline::Room;
use particle_file::Provenance;
use physics::{Choice, PressRun};
use serde::Serialize;

use crate::bond_measures::BondMeasures;
use crate::courant::Courant;
use crate::end_conditions::End;
use crate::expected_error::ExpectedError;
use crate::history;
use crate::invariants::Invariants;
use crate::omissions::{BEYOND_SIDES, Remark, UNCERTAIN};
use crate::outlook::Outlook;
use crate::verdict::Verdict;

/// Content of `summary.json`.
#[derive(Debug, Serialize)]
pub struct Summary {
    /// How the run ended.
    pub end: End,
    /// Whether the last state is sound.
    pub verdict: Verdict,
    /// Steps since the start of the run.
    pub steps: u64,
    /// Courant numbers and the steps from which they held.
    pub courant_numbers: Vec<Courant>,
    /// Simulated time, s.
    pub time_s: f64,
    /// Clamp travel, m.
    pub travel_m: f64,
    /// Travel left until closure, m.
    pub gap_m: Option<f64>,
    /// Pressure on the upper body, which the clamp drives, in the last step, Pa.
    pub final_pressure_pa: f64,
    /// Liquid material points.
    pub liquid_points: u64,
    /// Material points that left the domain.
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
    /// Penetration and bond line, for a bond in three dimensions.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub penetration: Option<BondMeasures>,
    /// Effect of a longer press, of one that did not close.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub outlook: Option<Outlook>,
    /// Time at which the adhesive sets and the run ends, s; absent if it never sets.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub set_s: Option<f64>,
    /// Wall time per stage of a step, s.
    pub stages: Vec<serde_json::Value>,
    /// Interventions of the scheme, counted by kind.
    pub counts: BTreeMap<&'static str, u64>,
    /// Checks of the final state.
    pub invariants: Invariants,
    /// What is known before the run.
    #[serde(flatten)]
    pub preliminaries: Preliminaries,
}

/// The part of the summary that is known before the run.
#[derive(Debug, Serialize)]
pub struct Preliminaries {
    /// Expected error, as measured for the scheme and options.
    pub expected_error: ExpectedError,
    /// Lumen width at the bond, and a proposed cell size if few cells span a lumen.
    pub lumens: Vec<Remark>,
    /// What the run does not compute, and why.
    pub left_out: Vec<Remark>,
    /// Room for the adhesive.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub room: Option<Room>,
    /// Tool, version, command and inputs.
    pub provenance: serde_json::Value,
}

/// `summary.json` of a run that failed.
#[derive(Debug, Serialize)]
pub(crate) struct FailedSummary {
    pub(crate) end: &'static str,
    /// Not sound, with the message of the failure as its reason.
    pub(crate) verdict: Verdict,
    /// Steps before the failure, and their time, s.
    pub(crate) steps: u64,
    pub(crate) time_s: f64,
    #[serde(flatten)]
    pub(crate) preliminaries: Preliminaries,
}

/// How a stage of a press programme ended.
#[derive(Debug, Serialize)]
pub struct PressedStage {
    /// Kind of the stage.
    pub kind: &'static str,
    /// Reason of its end.
    pub ended_by: &'static str,
    /// Time of its end since the start of the run, s.
    pub end_s: f64,
    /// Clamp travel at its end, m.
    pub travel_m: f64,
    /// Pressure on the clamp's body at its end, Pa.
    pub pressure_pa: f64,
    /// Whether the bond had closed by its end, under less than the stage's pressure.
    pub closed_below: bool,
    /// Total WP at its end, m, if the history has it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wp_m: Option<f64>,
}

/// The ended stages of a press programme; `history` is the text of the history, which has their WP.
pub(crate) fn ended_stages(run: Option<&PressRun>, history: &str) -> Vec<PressedStage> {
    let stages = run
        .into_iter()
        .flat_map(|run| run.ended().map(move |at| (run, at)));
    let ended = stages.map(|(run, (stage, end))| PressedStage {
        kind: stage.kind.name(),
        ended_by: end.reason.name(),
        end_s: end.time_s,
        travel_m: end.travel_m,
        pressure_pa: end.pressure,
        closed_below: run.is_closed_below(stage, end),
        wp_m: history::wp_at(history, end.time_s),
    });
    ended.collect()
}

/// A summary as text.
pub(crate) fn text(summary: &impl Serialize) -> String {
    serde_json::to_string_pretty(summary).unwrap_or_default() + "\n"
}

/// A time (s) in a suitable unit, with `digits` decimals.
pub(crate) fn time(seconds: f64, digits: usize) -> String {
    match seconds {
        s if s < 1e-3 => format!("{:.digits$} us", s * 1e6),
        s if s < 1.0 => format!("{:.digits$} ms", s * 1e3),
        s if s < 600.0 => format!("{s:.digits$} s"),
        s => format!("{:.digits$} min", s / 60.0),
    }
}

/// A pressure (Pa) in MPa with `digits` decimals, or in Pa if they would all be 0.
pub(crate) fn pressure(pascal: f64, digits: usize) -> String {
    let last = 1e6 * 0.1_f64.powi(digits as i32);
    match pascal.abs() {
        // Adding 0 removes the sign of -0.
        small if small < 0.5 * last => format!("{:.0} Pa", pascal.round() + 0.0),
        _ => format!("{:.digits$} MPa", pascal / 1e6),
    }
}

/// Provenance in the form of the summary.
pub(crate) fn provenance(by: &Provenance) -> serde_json::Value {
    let inputs = by.inputs.iter();
    let inputs: Vec<_> = inputs
        .map(|(path, hash)| serde_json::json!({ "path": path, "xxh3": format!("{hash:016x}") }))
        .collect();
    serde_json::json!({ "tool": by.tool, "version": by.version, "command": by.command, "inputs": inputs })
}

impl Summary {
    /// Note on WP: its value before a release, after which air may push the adhesive back, and its uncertainty due to air that
    /// the sides trap.
    fn wp_note(&self) -> String {
        let stages = self.programme.windows(2);
        let held = (stages.filter(|stages| stages[1].kind == "release"))
            .find_map(|stages| stages[0].wp_m)
            .map(|wp| format!("{:.2} um before the release", 1e6 * wp));
        let mut left_out = self.preliminaries.left_out.iter();
        let doubt = (left_out.any(|item| item.what == BEYOND_SIDES)).then(|| UNCERTAIN.to_owned());
        let notes: Vec<String> = held.into_iter().chain(doubt).collect();
        match notes.is_empty() {
            true => String::new(),
            false => format!(" ({})", notes.join("; ")),
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
        let outlook = self.outlook.as_ref();
        let outlook = outlook.map_or(String::new(), |ahead| format!(" ({})", ahead.said));
        let closed = self.programme.iter().position(|stage| stage.closed_below);
        let closed = closed.map_or(String::new(), |at| {
            let (stage, kind) = (at + 1, self.programme[at].kind);
            format!(" and closed below its pressure in stage {stage} ({kind})")
        });
        let gap = self.gap_m.map_or(String::new(), |g| {
            format!(", gap {:.2} um", g.max(0.0) * 1e6)
        });
        let line = self.penetration.as_ref().map_or(String::new(), |found| {
            let line = match found.bond_line.as_str() {
                "filled" => String::new(),
                other => format!(", bond line {other}"),
            };
            let line = match found.outer_face_reached {
                true => line + ", adhesive at the outer face of the wood",
                false => line,
            };
            let (wp, note) = (1e6 * found.wp_m.total, self.wp_note());
            let share = 100.0 * found.entered_share.total;
            let depth = match found.mean_depth_m.total {
                depth if depth.is_finite() => format!(", {:.2} um deep on average", 1e6 * depth),
                _ => String::new(),
            };
            format!("; {share:.1} % of the adhesive in the wood{depth}{line}, WP {wp:.2} um{note}")
        });
        let left = match self.points_left {
            0 => String::new(),
            n => format!(" ({n} points left through open sides)"),
        };
        let sound = if self.verdict.sound {
            "sound"
        } else {
            "not sound"
        };
        format!(
            "The run {end}{outlook}{closed} after {} steps at {}{gap}{line}, {}; volume {:+.3} %{left}, {} points in wood (deepest {:.3} um), {} in unreachable voids; {:.1} s, {:.2} M particle-steps/s; {sound}.",
            self.steps,
            time(self.time_s, 2),
            pressure(self.final_pressure_pa, 3),
            (1e5 * self.invariants.volume_change).round() / 1e3 + 0.0,
            self.invariants.points_in_wood,
            self.invariants.deepest_m * 1e6,
            self.invariants.points_in_unreachable_voids,
            self.stepping_wall_s,
            self.particle_steps_per_s / 1e6,
        )
    }
}

//! Instructions of the implicit scheme by stage, on scenes with and without what a stage is for.

use std::path::Path;
use std::process::Command;

use super::{callgrind, pairs};
use crate::case_text::{Body, CaseText, Viscosity};
use crate::job::write_text;
use crate::method::Scheme;
use crate::outputs::{self, Run};
use crate::stability::plan::PVA_PF;
use crate::study::side_by_side;
use crate::verification::slit;

/// Stages in the order of a step, and their functions as module and function, or type and method.
pub(super) const STAGES: &[(&str, &[&str])] = &[
    ("mesh of the gap", &["Implicit::fit_mesh"]),
    (TABLE, &["Viscosities::of"]),
    (
        "assembly",
        &[
            "halves::stiffnesses",
            "Problem::velocity_block",
            "Problem::outflow",
        ],
    ),
    ("linear solve", &["SaddleSolver::solve"]),
    (LOAD, &["SaddleSolver::solve_loaded"]),
    ("transport", &["transport::transport"]),
];
const TABLE: &str = "viscosity of the shear rate";
const LOAD: &str = "solve at the pressure limit";

/// Simulated time of a run, s: some steps of each scene.
const END: f64 = 2e-6;

/// A scene and what it took.
pub(super) struct Scene {
    pub(super) name: &'static str,
    case: CaseText,
    /// Stages that it does without.
    without: &'static [&'static str],
    steps: f64,
    cpu_s: f64,
    /// Instructions of the whole run and of each of [`STAGES`], where valgrind counts.
    instructions: Option<(f64, Vec<f64>)>,
}

/// A piston that pushes liquid into a slit, alone and with one thing more; a drop without walls.
fn scenes() -> Vec<Scene> {
    let slit = CaseText {
        stop: Some(END),
        ..slit::scene(6, [0.0; 2]).case
    };
    let scene = |name, without, case| Scene {
        name,
        case,
        without,
        steps: f64::NAN,
        cpu_s: f64::NAN,
        instructions: None,
    };
    let mut held = CaseText {
        stop: None,
        clamp: Some(format!(
            "closing_speed = \"0.5 m/s\"\nmax_pressure = \"0.3 MPa\"\ntravel = \"5 um\"\ntime_limit = \"{} us\"\n",
            END * 1e6
        )),
        ..slit.clone()
    };
    for body in &mut held.bodies {
        if body.name == Some("top") {
            *body = body.clone().clamped();
        }
    }
    let cell = slit.cell;
    let size = 20.0 * cell;
    let [low, high] = [6.0, 14.0].map(|x| [x * cell, x * cell, 0.0]);
    let drop = CaseText {
        boundary: ["open", "open", "symmetry"],
        stop: Some(END),
        bodies: vec![Body::liquid(low, [high[0], high[1], cell]).moving([0.4, 0.3, 0.0])],
        ..CaseText::plane("A drop in free flight.", cell, [size, size])
    };
    let with = |gravity, viscosity| CaseText {
        gravity,
        viscosity,
        ..slit.clone()
    };
    let newtonian = slit.viscosity.clone();
    vec![
        scene("piston", &[TABLE, LOAD], slit.clone()),
        scene(
            "gravity",
            &[TABLE, LOAD],
            with([0.0, -9.81, 0.0], newtonian),
        ),
        scene(
            "viscosity table",
            &[LOAD],
            with([0.0; 3], Viscosity::Table(PVA_PF.to_vec())),
        ),
        scene("pressure limit", &[TABLE], held),
        scene("free drop", &[TABLE, LOAD], drop),
    ]
}

/// Runs the scenes in `folder`.
///
/// # Errors
/// What a run said; that no scene has a stage, because its functions are gone or were inlined.
pub(super) fn measure(folder: &Path) -> Result<Vec<Scene>, String> {
    let mut scenes = scenes();
    let measured = side_by_side(&scenes, |scene| measure_one(scene, folder));
    for (scene, measured) in scenes.iter_mut().zip(measured) {
        (scene.steps, scene.cpu_s, scene.instructions) = measured?;
    }
    for (i, (stage, functions)) in STAGES.iter().enumerate() {
        let counts = scenes
            .iter()
            .filter_map(|s| Some(s.instructions.as_ref()?.1[i]));
        if counts.clone().count() > 0 && counts.sum::<f64>() == 0.0 {
            return Err(format!(
                "stage '{stage}': no run has a function {functions:?}"
            ));
        }
    }
    Ok(scenes)
}

type Measured = (f64, f64, Option<(f64, Vec<f64>)>);

fn measure_one(scene: &Scene, folder: &Path) -> Result<Measured, String> {
    let named = |ending: &str| folder.join(format!("{}{ending}", scene.name.replace(' ', "-")));
    let (case, run) = (named(".toml"), named(""));
    write_text(&case, &scene.case.text(Scheme::Implicit.integrator()))?;
    let mut command = Command::new(outputs::bin_folder().join("mpm-run"));
    command
        .arg(&case)
        .args(["--threads", "1", "--quiet", "--overwrite", "-o"]);
    command.arg(&run);
    let cpu_s = pairs::cpu_seconds(&command)?;
    let steps = Run { folder: run }.summary("steps");
    let steps = steps.ok_or("the run's summary has no steps")?;
    let instructions = callgrind::profile(&command).map(|(total, functions)| {
        let of_stage = |(_, names): &(_, &[&str])| {
            let ours = functions.iter().filter(|(function, _)| {
                let at_end = |name: &&str| function.ends_with(&format!("::{name}"));
                names.iter().any(at_end)
            });
            ours.map(|(_, cost)| cost).sum()
        };
        (total, STAGES.iter().map(of_stage).collect())
    });
    Ok((steps, cpu_s, instructions))
}

/// Whether no scene has instructions in a stage that it does without.
pub(super) fn absent_are_zero(scenes: &[Scene]) -> bool {
    scenes.iter().all(|scene| {
        let Some((_, counts)) = &scene.instructions else {
            return true;
        };
        let absent = |stage: &str| scene.without.contains(&stage);
        (STAGES.iter().zip(counts)).all(|((stage, _), count)| !absent(stage) || *count == 0.0)
    })
}

impl Scene {
    /// Millions of instructions per step of stage `i`.
    pub(super) fn cell(&self, i: usize) -> String {
        match &self.instructions {
            Some((_, counts)) if counts[i] == 0.0 => "0".into(),
            Some((_, counts)) => self.per_step(counts[i]),
            None => "-".into(),
        }
    }

    /// The same of the whole run.
    pub(super) fn whole(&self) -> String {
        let total = self.instructions.as_ref().map(|(total, _)| *total);
        total.map_or("-".into(), |total| self.per_step(total))
    }

    /// CPU time, ms per step.
    pub(super) fn cpu(&self) -> String {
        format!("{:.1}", 1e3 * self.cpu_s / self.steps)
    }

    fn per_step(&self, count: f64) -> String {
        format!("{:.3}", count / self.steps / 1e6)
    }

    /// Rows of the CSV file.
    pub(super) fn rows(&self) -> Vec<Vec<String>> {
        let row = |what: &str, value: String| vec![self.name.to_owned(), what.to_owned(), value];
        let mut rows = vec![
            row("steps", format!("{}", self.steps)),
            row("CPU, ms per step", self.cpu()),
            row("whole step, million instructions", self.whole()),
        ];
        for (i, (stage, _)) in STAGES.iter().enumerate() {
            rows.push(row(&format!("{stage}, million instructions"), self.cell(i)));
        }
        rows
    }
}

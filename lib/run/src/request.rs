//! A run as a tool asks for it: case file, bond file, changed keys; then explained or executed.

use std::path::Path;

use particle_file::{ParticleFile, Provenance};
use physics::{Regime, StepReport};
use xxhash_rust::xxh3::xxh3_64;

use crate::case::{Case, CaseError};
use crate::changes::changed;
use crate::checkpoint::{self, Checkpoint, Clock};
use crate::courant::{continued, without_cfl};
use crate::drive::{self, Controls, RunError};
use crate::folder::{self, Mode};
use crate::history::History;
use crate::invariants;
use crate::left_out::left_out;
use crate::load;
use crate::resolve::{self, Setup};
use crate::schemes;
use crate::snapshot::{SnapshotWriter, is_final_of};
use crate::summary::{Facts, Summary};

/// Why a run could not be made ready or did not end well; tools map it to exit status.
#[derive(Debug, thiserror::Error)]
pub enum RunFailure {
    /// Usage or case file (exit 2).
    #[error("{0}")]
    Usage(String),
    /// Unreadable or corrupt data (exit 3).
    #[error("{0}")]
    Data(String),
    /// The run failed (exit 1).
    #[error("{0}")]
    Run(String),
}

impl From<CaseError> for RunFailure {
    fn from(error: CaseError) -> Self {
        RunFailure::Usage(error.0)
    }
}

impl From<RunError> for RunFailure {
    fn from(error: RunError) -> Self {
        match error {
            RunError::Checkpoint(said) => RunFailure::Data(said),
            other => RunFailure::Run(other.to_string()),
        }
    }
}

/// A run ready to be explained or executed.
#[derive(Debug)]
pub struct Request {
    case: Case,
    /// The case as run: the file with changed keys.
    text: String,
    setup: Setup,
    bond: Option<ParticleFile>,
    inputs: Vec<(String, u64)>,
}

impl Request {
    /// Reads and resolves a case with `changes` (`key=value`) and its bond file.
    ///
    /// # Errors
    /// [`RunFailure::Usage`] and [`RunFailure::Data`].
    pub fn read(case: &Path, bond: Option<&Path>, changes: &[String]) -> Result<Self, RunFailure> {
        let original = load::case_text(case)?;
        let text = changed(&original, case, changes)?;
        let parsed = Case::parse(&text, case)?;
        let mut inputs = vec![(case.display().to_string(), xxh3_64(original.as_bytes()))];
        let bond = match bond {
            Some(path) => {
                let file = ParticleFile::read(path).map_err(|e| RunFailure::Data(e.to_string()))?;
                inputs.push((path.display().to_string(), file.content_hash()));
                Some(file)
            }
            None => None,
        };
        let plain = bond.as_ref().map(load::bond).transpose()?;
        let setup = resolve::resolve(&parsed, plain)?;
        Ok(Self {
            case: parsed,
            text,
            setup,
            bond,
            inputs,
        })
    }

    /// Sentences about terms left out although the regime would need them, and about a step too
    /// short for the run to end.
    pub fn warnings(&self) -> Vec<String> {
        let mut said = Regime::of(&self.setup.scene).warnings();
        // What keeps the scheme from starting is said when it is to start.
        if let Ok(forecast) = schemes::forecast(&self.case, &self.setup) {
            said.extend(forecast.warning());
        }
        said
    }

    /// The plan of the run as text.
    ///
    /// # Errors
    /// What would keep the scheme from starting.
    pub fn explain(&self) -> Result<String, RunFailure> {
        Ok(crate::explain::text(
            &self.case,
            &self.setup,
            &schemes::forecast(&self.case, &self.setup)?,
        ))
    }

    /// Whether `folder` already holds the end of this very run by this version.
    pub fn has_ended(&self, folder: &Path, by: &Provenance) -> bool {
        is_final_of(folder, &self.identity(by))
    }

    /// Runs into `folder`.
    ///
    /// # Errors
    /// All kinds; an unstable state leaves the last good checkpoint.
    pub fn execute(
        mut self,
        folder: &Path,
        mode: Mode,
        by: Provenance,
        interrupted: &dyn Fn() -> bool,
        progress: &mut dyn FnMut(f64, String),
    ) -> Result<Summary, RunFailure> {
        let identity = self.identity(&by);
        let continuable = self.identity_of(&without_cfl(&self.text), &by);
        let by = Provenance {
            inputs: self.inputs.clone(),
            ..by
        };
        // What the scheme refuses must not cost a run folder.
        let mut scheme = schemes::build(&self.case, self.setup.scene_for_scheme())?;
        let cfl = schemes::cfl(&self.case);
        let (clock, courant, mut history) =
            match folder::start(folder, mode, &continuable, &self.text)? {
                Some(Checkpoint {
                    clock,
                    courant,
                    saved,
                }) => {
                    scheme.restore(&saved).map_err(RunFailure::Data)?;
                    let history =
                        History::resume(folder, clock.step).map_err(RunError::write(folder))?;
                    folder::write_text(&folder.join(folder::RESOLVED), &self.text)?;
                    folder::remove_summary(folder)?;
                    (clock, continued(courant, clock.step, cfl), history)
                }
                None => (
                    Clock::default(),
                    continued(Vec::new(), 0, cfl),
                    History::create(folder).map_err(RunError::write(folder))?,
                ),
            };
        let mut controls = Controls {
            history_every_s: self.history_every(),
            snapshot_every_s: self.snapshot_every(),
            interrupted,
            progress: &mut |fraction, time_s, report: &StepReport| {
                let pressure = 0.5 * (report.pressure_bottom + report.pressure_top) / 1e6;
                progress(
                    fraction,
                    format!("{:.3} us, {pressure:.3} MPa", time_s * 1e6),
                );
            },
            identity: continuable,
            courant,
        };
        let provenance = provenance_json(&by);
        let writer = SnapshotWriter::new(folder, &self.setup, self.bond, by, &identity);
        let outcome = drive::drive(
            &self.setup,
            scheme.as_mut(),
            clock,
            &mut history,
            &writer,
            folder,
            &mut controls,
        )?;
        let scene = &self.setup.scene;
        let summary = Summary::new(
            &outcome,
            Facts {
                courant_numbers: controls.courant,
                liquid_points: self.setup.liquid_points,
                initial_gap_m: self.setup.initial_gap_m,
                stages: scheme.stage_times(),
                counts: scheme.counts(),
                invariants: invariants::check(
                    scene,
                    self.setup.liquid_volume_m3,
                    &scheme.liquid(),
                    &scheme.displacements(),
                ),
                left_out: left_out(scene, &self.case.integrator, self.case.output.snapshots > 0),
                provenance,
            },
        );
        folder::write_text(
            &folder.join(folder::SUMMARY),
            &(serde_json::to_string_pretty(&summary).unwrap_or_default() + "\n"),
        )?;
        if outcome.end != drive::End::Interrupted {
            writer.write_final(&outcome.clock, scheme.as_ref())?;
            checkpoint::remove(folder)?;
        }
        Ok(summary)
    }

    /// What makes two runs the same: the case as run, the inputs and the version.
    fn identity(&self, by: &Provenance) -> String {
        self.identity_of(&self.text, by)
    }

    fn identity_of(&self, case: &str, by: &Provenance) -> String {
        let bond = self.inputs.get(1).map_or(0, |i| i.1);
        format!(
            "{} {:016x} {bond:016x}",
            by.version,
            xxh3_64(case.as_bytes())
        )
    }

    fn history_every(&self) -> f64 {
        self.case
            .output
            .history_every
            .map_or(1e-3 * self.setup.nominal_duration_s, |t| t.si())
    }

    fn snapshot_every(&self) -> f64 {
        match self.case.output.snapshots {
            0 => f64::INFINITY,
            n => self.setup.nominal_duration_s / f64::from(n),
        }
    }
}

fn provenance_json(by: &Provenance) -> serde_json::Value {
    let inputs: Vec<_> = by
        .inputs
        .iter()
        .map(|(path, hash)| serde_json::json!({ "path": path, "xxh3": format!("{hash:016x}") }))
        .collect();
    serde_json::json!({ "tool": by.tool, "version": by.version, "command": by.command, "inputs": inputs })
}

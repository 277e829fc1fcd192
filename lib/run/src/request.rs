//! A run as a tool asks for it: case file, bond file, changed keys; then explained or executed.

use std::path::{Path, PathBuf};

use particle_file::{ParticleFile, Provenance};
use physics::{Regime, Scheme, StepReport};
use xxhash_rust::xxh3::xxh3_64;

use crate::bond_measures;
use crate::case::Case;
use crate::changes::changed;
use crate::checkpoint::{self, Checkpoint, Origin};
use crate::clock::Clock;
use crate::courant::{Courant, continued, without_cfl};
use crate::earlier_run::{self, Mode};
use crate::ends::{Ahead, End};
use crate::expected_error;
use crate::failure::{RunError, RunFailure};
use crate::folder::{CHECKPOINT, RunFolder, SUMMARY};
use crate::history::History;
use crate::last_state::{Asked, conclude};
use crate::left_out::{LeftOut, left_out};
use crate::load;
use crate::resolve::{self, Setup};
use crate::resolved;
use crate::schemes;
use crate::snapshot::{SnapshotWriter, is_final_of};
use crate::summary::{self, Summary};
use crate::time_loop::{self, Controls};
use crate::verdict;

/// A run ready to be explained or executed.
#[derive(Debug)]
pub struct Request {
    case: Case,
    /// The case as run: the file with changed keys.
    text: String,
    setup: Setup,
    bond: Option<ParticleFile>,
    inputs: Vec<(String, u64)>,
    /// Where they are: no output may stand there.
    places: Vec<PathBuf>,
}

/// Where a run begins to take steps.
struct Begun {
    clock: Clock,
    courant: Vec<Courant>,
    history: History,
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
        let mut places = vec![case.to_owned()];
        let bond = match bond {
            Some(path) => {
                places.push(if path == "-" {
                    "/dev/stdin".into()
                } else {
                    path.into()
                });
                let file = ParticleFile::read(path).map_err(|e| RunFailure::Data(e.to_string()))?;
                inputs.push((path.display().to_string(), file.content_hash()));
                Some(file)
            }
            None => None,
        };
        let plain = bond.as_ref().map(load::bond).transpose()?;
        let bonded = plain.is_some();
        let setup = resolve::resolve(&parsed, plain)?;
        bond_measures::check(&parsed, bonded, &setup)?;
        Ok(Self {
            case: parsed,
            text,
            setup,
            bond,
            inputs,
            places,
        })
    }

    /// Sentences about terms left out although the regime would need them.
    pub fn warnings(&self) -> Vec<String> {
        Regime::of(&self.setup.scene, &self.setup.liquid).warnings()
    }

    /// What the run is forecast to need beyond all patience or memory, as a sentence.
    ///
    /// # Errors
    /// What would keep the scheme from starting.
    pub fn excess(&self) -> Result<Option<String>, RunFailure> {
        Ok(schemes::forecast(&self.case, &self.setup)?.excess())
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

    /// Runs into `folder`, with `warn` told what the user should know; `None` when `folder` holds
    /// the end of this very run already.
    ///
    /// # Errors
    /// All kinds; an unstable state leaves the last good checkpoint.
    pub fn execute(
        self,
        folder: &Path,
        mode: Mode,
        by: Provenance,
        interrupted: &dyn Fn() -> bool,
        progress: &mut dyn FnMut(&[Ahead], String),
        warn: &dyn Fn(String),
    ) -> Result<Option<Summary>, RunFailure> {
        let identity = self.identity(&by);
        let by = Provenance {
            inputs: self.inputs.clone(),
            ..by
        };
        let origin = Origin {
            identity: self.content_hashes(&without_cfl(&self.text)),
            format: checkpoint::format(self.case.integrator.scheme),
            by: by.clone(),
        };
        let found = RunFolder::find(folder, &by)?;
        if let Some(found) = &found {
            earlier_run::make_room(found, &self.places)?;
        }
        // In a folder without the mark nothing is known to be a run's: making it one refuses.
        if let Some(found) = &found
            && mode.resume
            && is_final_of(folder, &identity, mode.overwrite)?
        {
            earlier_run::tidy(found, &origin)?;
            return Ok(None);
        }
        // What is refused must not cost a run folder.
        let watch = bond_measures::watch(&self.case, self.bond.as_ref(), &self.setup)?;
        self.check_patience(mode, warn)?;
        let stages = schemes::forecast(&self.case, &self.setup)?.stages;
        let resolved = resolved::text(&self.text, &self.case, &self.setup);
        // Read before there is a scheme, beside which its file need not be in memory, too.
        let checkpoint = match &found {
            Some(found) => earlier_run::checkpoint(found, mode, &origin, &resolved)?,
            None => None,
        };
        let mut scheme = schemes::build(&self.case, &self.setup)?;
        let folder = &match found {
            Some(found) => found,
            None => RunFolder::make(folder, &by)?,
        };
        folder.warning().into_iter().for_each(warn);
        let Begun {
            clock,
            courant,
            mut history,
        } = match checkpoint {
            Some(checkpoint) => self.continued(folder, checkpoint, scheme.as_mut(), &resolved)?,
            None => self.anew(folder, mode, &resolved, &by)?,
        };
        let watch = watch.as_ref();
        let mut controls = Controls {
            watch: watch.filter(|_| self.case.output.penetration),
            history_every_s: self.setup.history_every_s,
            snapshot_every_s: self.snapshot_every(),
            snapshots_of_way: self.case.output.snapshots,
            interrupted,
            progress: &mut |ends, time_s, report: &StepReport| {
                let pressure = report.pressure_top / 1e6;
                let state = format!("{}, {pressure:.3} MPa", summary::time(time_s, 3));
                progress(ends, state);
            },
            origin,
            courant,
        };
        let provenance = provenance_json(&by);
        let writer = SnapshotWriter::new(folder, &self.setup, self.bond.as_ref(), by, &identity);
        let ended = time_loop::run_to_its_end(
            &self.setup,
            scheme.as_mut(),
            clock,
            &mut history,
            &writer,
            folder,
            &mut controls,
        );
        let left_out = left_out(&self.case, &self.setup, &stages);
        let outcome = match ended {
            Err(error @ RunError::Unstable { step, time_s, .. }) => {
                let at = (step, time_s);
                return Err(self.failed(folder, error.into(), at, left_out, provenance));
            }
            ended => ended?,
        };
        let asked = Asked {
            courant_numbers: controls.courant,
            left_out,
            provenance,
        };
        let (summary, liquid, displacements) =
            conclude(&self.case, &self.setup, scheme, &outcome, watch, asked)?;
        folder.write_text(SUMMARY, &summary::text(&summary))?;
        if outcome.end != End::Interrupted {
            writer.write_final(&outcome.clock, &liquid, &displacements)?;
            folder.remove(CHECKPOINT)?;
        }
        Ok(Some(summary))
    }

    /// Refuses a run beyond all patience or memory unless `mode` takes it however long, and then warns.
    fn check_patience(&self, mode: Mode, warn: &dyn Fn(String)) -> Result<(), RunFailure> {
        match self.excess()? {
            Some(excess) if mode.however_long => warn(excess),
            Some(excess) => {
                return Err(RunFailure::Usage(format!(
                    "{excess}; --yes-really runs it all the same"
                )));
            }
            None => {}
        }
        Ok(())
    }

    /// Brings `scheme` and `folder` to where `checkpoint` was written.
    fn continued(
        &self,
        folder: &RunFolder,
        checkpoint: Checkpoint,
        scheme: &mut dyn Scheme,
        resolved: &str,
    ) -> Result<Begun, RunFailure> {
        let restored = scheme.restore(&checkpoint.saved);
        restored.map_err(|said| {
            let path = folder.place(CHECKPOINT);
            RunFailure::Data(format!("{}: {said}", path.display()))
        })?;
        let history = History::resume(folder, checkpoint.history)?;
        let clock = checkpoint.clock;
        earlier_run::forget_what_came_after(folder, &clock, resolved)?;
        let cfl = schemes::cfl(&self.case);
        Ok(Begun {
            clock,
            courant: continued(checkpoint.courant, clock.step, cfl),
            history,
        })
    }

    /// Makes `folder` that of a run at its start.
    fn anew(
        &self,
        folder: &RunFolder,
        mode: Mode,
        resolved: &str,
        by: &Provenance,
    ) -> Result<Begun, RunFailure> {
        earlier_run::anew(folder, mode, resolved, by)?;
        let scene = &self.setup.scene;
        let history = History::create(
            folder,
            scene.liquid.cure.is_some(),
            scene.liquid.water.is_some(),
            !scene.programme.is_empty(),
            self.case.output.penetration,
        )?;
        Ok(Begun {
            clock: Clock::default(),
            courant: continued(Vec::new(), 0, schemes::cfl(&self.case)),
            history,
        })
    }

    /// Leaves the summary of a run that failed at this step and time (s).
    fn failed(
        &self,
        folder: &RunFolder,
        failure: RunFailure,
        (steps, time_s): (u64, f64),
        left_out: Vec<LeftOut>,
        provenance: serde_json::Value,
    ) -> RunFailure {
        let failed = summary::Failed {
            end: "failed",
            verdict: verdict::Verdict::because(vec![failure.said()]),
            steps,
            time_s,
            expected_error: expected_error::of(&self.case, self.setup.scene.grid.cell_m),
            left_out,
            provenance,
        };
        // That the run failed is worse than that its folder does not say why.
        let _ = folder.write_text(SUMMARY, &summary::text(&failed));
        failure
    }

    /// What makes two runs the same: the case as run, the inputs and the version.
    fn identity(&self, by: &Provenance) -> String {
        format!("{} {}", by.version, self.content_hashes(&self.text))
    }

    /// Hashes of a case and the bond file.
    fn content_hashes(&self, case: &str) -> String {
        let bond = self.inputs.get(1).map_or(0, |i| i.1);
        format!("{:016x} {bond:016x}", xxh3_64(case.as_bytes()))
    }

    fn snapshot_every(&self) -> f64 {
        match self.case.output.snapshots {
            0 => f64::INFINITY,
            _ if !self.setup.scene.programme.is_empty() => f64::INFINITY,
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

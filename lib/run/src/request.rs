//! A requested run: case file, bond file and changed keys, to be explained or executed.

use std::fs;
use std::path::{Path, PathBuf};

use particle_file::{ParticleFile, Provenance};
use physics::{Regime, Scheme};
use xxhash_rust::xxh3::xxh3_64;

use crate::bond_measures;
use crate::case::{Case, case_text};
use crate::changed_keys::with_changes;
use crate::checkpoint::{self, Checkpoint, Origin};
use crate::chords;
use crate::clock::Clock;
use crate::courant::{Courant, continue_record, without_cfl};
use crate::earlier_run::{self, Mode};
use crate::end_conditions::{End, PossibleEnd};
use crate::expected_error;
use crate::failure::{RunFailure, refused};
use crate::folder::{CHECKPOINT, FINAL, HISTORY, RESOLVED, RunFolder, SUMMARY};
use crate::forecast::Forecast;
use crate::history::History;
use crate::last_state::summarise;
use crate::omissions::omissions;
use crate::resolve::{self, Setup};
use crate::resolved;
use crate::room;
use crate::schemes;
use crate::snapshot::{SnapshotWriter, is_final_of};
use crate::summary::{self, FailedSummary, Preliminaries, Summary};
use crate::time_loop::TimeLoop;
use crate::verdict::Verdict;

/// A run ready to be explained or executed.
#[derive(Debug)]
pub struct Request {
    case: Case,
    /// The case file with the changed keys.
    text: String,
    setup: Setup,
    bond: Option<ParticleFile>,
    inputs: Vec<(String, u64)>,
    /// Paths of the inputs, which no output may replace.
    places: Vec<PathBuf>,
}

/// State in which the time loop starts.
type Start = (Clock, Vec<Courant>, History);

impl Request {
    /// Reads and resolves a case with `changes` (`key=value`) and its bond file.
    ///
    /// # Errors
    /// [`RunFailure::Usage`] and [`RunFailure::Data`].
    pub fn read(case: &Path, bond: Option<&Path>, changes: &[String]) -> Result<Self, RunFailure> {
        let stdin = Path::new("-");
        if case == stdin && bond == Some(stdin) {
            return refused("'-' can be read only once: name a file for the case or the bond");
        }
        let named = Path::new("/dev/stdin");
        let place = |path| PathBuf::from(if path == stdin { named } else { path });
        let original = case_text(case)?;
        let text = with_changes(&original, case, changes)?;
        let parsed = Case::parse(&text, case)?;
        let mut inputs = vec![(case.display().to_string(), xxh3_64(original.as_bytes()))];
        let mut places = vec![place(case)];
        let bond = match bond {
            Some(path) => {
                places.push(place(path));
                let file = ParticleFile::read(path)?;
                inputs.push((path.display().to_string(), file.content_hash()));
                Some(file)
            }
            None => None,
        };
        let setup = resolve::resolve(&parsed, bond.as_ref())?;
        bond_measures::check_output(&parsed, bond.is_some(), &setup)?;
        Ok(Self {
            case: parsed,
            text,
            setup,
            bond,
            inputs,
            places,
        })
    }

    /// Warnings about implausible voxel sizes, about terms that are left out although the regime needs them, and about adhesive
    /// that has no room.
    pub fn warnings(&self) -> Vec<String> {
        let bond = self.bond.iter();
        let voxels = bond.filter_map(|bond| voxels::doubt_of_file(bond.header()));
        let regime = Regime::of(&self.setup.scene, &self.setup.liquid).warnings();
        let room = room::room(&self.setup).filter(|room| room.least_gap_m > 0.0);
        voxels
            .chain(regime)
            .chain(room.map(|room| room.to_string()))
            .collect()
    }

    fn forecast(&self) -> Result<Forecast, RunFailure> {
        schemes::forecast(&self.case, &self.setup)
    }

    /// A sentence if the forecast exceeds the bounds of time or memory.
    ///
    /// # Errors
    /// Settings or scenes that the scheme refuses.
    pub fn excess(&self) -> Result<Option<String>, RunFailure> {
        Ok(self.forecast()?.excess())
    }

    /// The plan of the run as text.
    ///
    /// # Errors
    /// Settings or scenes that the scheme refuses.
    pub fn explain(&self) -> Result<String, RunFailure> {
        let forecast = self.forecast()?;
        Ok(crate::explain::text(&self.case, &self.setup, &forecast))
    }

    /// Runs into `folder` and passes warnings to `warn`; `None` if `folder` already holds the final state of this run.
    ///
    /// # Errors
    /// Any [`RunFailure`]. An unstable state leaves the last good checkpoint.
    pub fn execute(
        self,
        folder: &Path,
        mode: Mode,
        by: Provenance,
        interrupted: &dyn Fn() -> bool,
        progress: &mut dyn FnMut(&[PossibleEnd], String),
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
        let found = RunFolder::lock_existing(folder, &by)?;
        // A folder without the mark is checked by `RunFolder::make` below.
        if let Some(found) = &found {
            earlier_run::make_room(found, &self.places)?;
            if mode.resume && is_final_of(folder, &identity, mode.overwrite)? {
                earlier_run::remove_leftover_checkpoint(found, &origin)?;
                return Ok(None);
            }
        }
        // All that may be refused comes before the folder is changed.
        let meter = bond_measures::bond_meter(&self.case, self.bond.as_ref(), &self.setup)?;
        let preliminaries = self.preliminaries(mode, &by, warn)?;
        let resolved = resolved::text(&self.text, &self.case, &self.setup);
        // Read before the scheme is built, so that the file is not in memory beside it.
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
        let (clock, courant, history) = match checkpoint {
            Some(checkpoint) => self.resume(folder, checkpoint, scheme.as_mut(), &resolved)?,
            None => {
                let what = match folder.path_of(RESOLVED).exists() {
                    true => "no checkpoint of this run: it starts again",
                    false => "no run to continue: a new one starts",
                };
                let start = self.start_anew(folder, mode, &resolved, &by)?;
                if mode.resume {
                    warn(format!("'{}' holds {what}", folder.path().display()));
                }
                start
            }
        };
        let writer = SnapshotWriter::new(folder, &self.setup, self.bond.as_ref(), by, &identity);
        let time_loop = TimeLoop {
            setup: &self.setup,
            folder,
            clock,
            courant,
            history,
            writer: &writer,
            snapshots: self.case.output.snapshots,
            meter: meter.as_ref().filter(|_| self.case.output.penetration),
            origin,
            interrupted,
            progress,
        };
        let outcome = match time_loop.run(scheme.as_mut()) {
            Err(failure) => return Err(write_failure(folder, failure, preliminaries)),
            Ok(outcome) => outcome,
        };
        let (end, clock) = (outcome.end, outcome.clock);
        let rows = match self.setup.scene.programme.is_empty() {
            true => String::new(),
            false => fs::read_to_string(folder.path_of(HISTORY)).unwrap_or_default(),
        };
        let meter = meter.as_ref();
        let (summary, liquid, displacements) =
            summarise(&self.setup, scheme, outcome, meter, preliminaries, &rows)?;
        folder.write_text(SUMMARY, &summary::text(&summary))?;
        if end != End::Interrupted {
            writer.write(FINAL, &clock, &liquid, &displacements)?;
            folder.remove(CHECKPOINT)?;
        }
        Ok(Some(summary))
    }

    /// The part of the summary that is known before the run. Refuses a run beyond the bounds of time or memory; with
    /// `mode.however_long` it only warns.
    fn preliminaries(
        &self,
        mode: Mode,
        by: &Provenance,
        warn: &dyn Fn(String),
    ) -> Result<Preliminaries, RunFailure> {
        let forecast = self.forecast()?;
        match forecast.excess() {
            Some(excess) if mode.however_long => warn(excess),
            Some(excess) => {
                return refused(format!("{excess}; --yes-really runs it anyway"));
            }
            None => {}
        }
        Ok(Preliminaries {
            expected_error: expected_error::expect(&self.case, self.setup.scene.grid.cell_m),
            lumens: chords::remarks(&self.setup.scene),
            left_out: omissions(&self.case, &self.setup, &forecast.stages),
            room: room::room(&self.setup),
            provenance: summary::provenance(by),
        })
    }

    /// Restores `scheme` and `folder` to the state of `checkpoint`.
    fn resume(
        &self,
        folder: &RunFolder,
        checkpoint: Checkpoint,
        scheme: &mut dyn Scheme,
        resolved: &str,
    ) -> Result<Start, RunFailure> {
        let restored = scheme.restore(&checkpoint.saved);
        restored.map_err(|said| {
            let path = folder.path_of(CHECKPOINT);
            RunFailure::Data(format!("{}: {said}", path.display()))
        })?;
        let history = History::resume(folder, checkpoint.history)?;
        let clock = checkpoint.clock;
        earlier_run::prepare_continuation(folder, &clock, resolved)?;
        let cfl = schemes::cfl(&self.case);
        let courant = continue_record(checkpoint.courant, clock.step, cfl);
        Ok((clock, courant, history))
    }

    /// Prepares `folder` for a run from the beginning.
    fn start_anew(
        &self,
        folder: &RunFolder,
        mode: Mode,
        resolved: &str,
        by: &Provenance,
    ) -> Result<Start, RunFailure> {
        earlier_run::start_anew(folder, mode, resolved, by)?;
        let history = History::create(folder, &self.setup.scene, self.case.output.penetration)?;
        let courant = continue_record(Vec::new(), 0, schemes::cfl(&self.case));
        Ok((Clock::default(), courant, history))
    }

    /// Identity of a run: version, case with changed keys, and bond file.
    fn identity(&self, by: &Provenance) -> String {
        format!("{} {}", by.version, self.content_hashes(&self.text))
    }

    /// Hashes of the text of a case and of the bond file.
    fn content_hashes(&self, case: &str) -> String {
        let bond = self.inputs.get(1).map_or(0, |i| i.1);
        format!("{:016x} {bond:016x}", xxh3_64(case.as_bytes()))
    }
}

/// Writes the summary of a run that became unstable.
fn write_failure(
    folder: &RunFolder,
    failure: RunFailure,
    preliminaries: Preliminaries,
) -> RunFailure {
    if let RunFailure::Unstable {
        said, step, time_s, ..
    } = &failure
    {
        let failed = FailedSummary {
            end: "failed",
            verdict: Verdict::because(vec![said.clone()]),
            steps: *step,
            time_s: *time_s,
            preliminaries,
        };
        // The failure itself is reported, even if its summary cannot be written.
        let _ = folder.write_text(SUMMARY, &summary::text(&failed));
    }
    failure
}

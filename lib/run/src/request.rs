//! A run as a tool asks for it: case file, bond file, changed keys; then explained or executed.

use std::fs;
use std::path::{Path, PathBuf};

use particle_file::{ParticleFile, Provenance};
use physics::{Regime, Scheme};
use xxhash_rust::xxh3::xxh3_64;

use crate::bond_measures;
use crate::case::{Case, case_text};
use crate::changes::changed;
use crate::checkpoint::{self, Checkpoint, Origin};
use crate::chords;
use crate::clock::Clock;
use crate::courant::{Courant, continued, without_cfl};
use crate::earlier_run::{self, Mode};
use crate::ends::{Ahead, End};
use crate::expected_error;
use crate::failure::{RunFailure, refused};
use crate::folder::{CHECKPOINT, FINAL, HISTORY, RESOLVED, RunFolder, SUMMARY};
use crate::forecast::Forecast;
use crate::history::History;
use crate::last_state::conclude;
use crate::left_out::left_out;
use crate::resolve::{self, Setup};
use crate::resolved;
use crate::schemes;
use crate::snapshot::{SnapshotWriter, is_final_of};
use crate::summary::{self, Account, Failed, Summary};
use crate::time_loop::TimeLoop;
use crate::verdict::Verdict;

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
type Begun = (Clock, Vec<Courant>, History);

impl Request {
    /// Reads and resolves a case with `changes` (`key=value`) and its bond file.
    ///
    /// # Errors
    /// [`RunFailure::Usage`] and [`RunFailure::Data`].
    pub fn read(case: &Path, bond: Option<&Path>, changes: &[String]) -> Result<Self, RunFailure> {
        let original = case_text(case)?;
        let text = changed(&original, case, changes)?;
        let parsed = Case::parse(&text, case)?;
        let mut inputs = vec![(case.display().to_string(), xxh3_64(original.as_bytes()))];
        let mut places = vec![case.to_owned()];
        let bond = match bond {
            Some(path) => {
                let stdin = path == Path::new("-");
                places.push(if stdin { Path::new("/dev/stdin") } else { path }.into());
                let file = ParticleFile::read(path)?;
                inputs.push((path.display().to_string(), file.content_hash()));
                Some(file)
            }
            None => None,
        };
        let setup = resolve::resolve(&parsed, bond.as_ref())?;
        bond_measures::check(&parsed, bond.is_some(), &setup)?;
        Ok(Self {
            case: parsed,
            text,
            setup,
            bond,
            inputs,
            places,
        })
    }

    /// Sentences about voxels of an odd size, and terms left out although the regime would need them.
    pub fn warnings(&self) -> Vec<String> {
        let bond = self.bond.iter();
        let voxels = bond.filter_map(|bond| voxels::doubt_of_file(bond.header()));
        let regime = Regime::of(&self.setup.scene, &self.setup.liquid).warnings();
        voxels.chain(regime).collect()
    }

    fn forecast(&self) -> Result<Forecast, RunFailure> {
        schemes::forecast(&self.case, &self.setup)
    }

    /// What the run is forecast to need beyond all patience or memory, as a sentence.
    ///
    /// # Errors
    /// What would keep the scheme from starting.
    pub fn excess(&self) -> Result<Option<String>, RunFailure> {
        Ok(self.forecast()?.excess())
    }

    /// The plan of the run as text.
    ///
    /// # Errors
    /// What would keep the scheme from starting.
    pub fn explain(&self) -> Result<String, RunFailure> {
        let forecast = self.forecast()?;
        Ok(crate::explain::text(&self.case, &self.setup, &forecast))
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
        // In a folder without the mark nothing is known to be a run's: making it one refuses.
        if let Some(found) = &found {
            earlier_run::make_room(found, &self.places)?;
            if mode.resume && is_final_of(folder, &identity, mode.overwrite)? {
                earlier_run::tidy(found, &origin)?;
                return Ok(None);
            }
        }
        // What is refused must not cost a run folder.
        let watch = bond_measures::watch(&self.case, self.bond.as_ref(), &self.setup)?;
        let account = self.account(mode, &by, warn)?;
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
        let (clock, courant, history) = match checkpoint {
            Some(checkpoint) => self.continued(folder, checkpoint, scheme.as_mut(), &resolved)?,
            None => {
                let what = match folder.place(RESOLVED).exists() {
                    true => "no checkpoint of this run: it starts again",
                    false => "no run to continue: a new one starts",
                };
                let begun = self.anew(folder, mode, &resolved, &by)?;
                if mode.resume {
                    warn(format!("'{}' holds {what}", folder.path().display()));
                }
                begun
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
            watch: watch.as_ref().filter(|_| self.case.output.penetration),
            origin,
            interrupted,
            progress,
        };
        let outcome = match time_loop.run(scheme.as_mut()) {
            Err(failure) => return Err(failed(folder, failure, account)),
            Ok(outcome) => outcome,
        };
        let (end, clock) = (outcome.end, outcome.clock);
        let rows = match self.setup.scene.programme.is_empty() {
            true => String::new(),
            false => fs::read_to_string(folder.place(HISTORY)).unwrap_or_default(),
        };
        let watch = watch.as_ref();
        let (summary, liquid, displacements) =
            conclude(&self.setup, scheme, outcome, watch, account, &rows)?;
        folder.write_text(SUMMARY, &summary::text(&summary))?;
        if end != End::Interrupted {
            writer.write(FINAL, &clock, &liquid, &displacements)?;
            folder.remove(CHECKPOINT)?;
        }
        Ok(Some(summary))
    }

    /// What is known of a run before it starts. One beyond all patience or memory is refused unless `mode` takes it
    /// however long, and then warned of.
    fn account(
        &self,
        mode: Mode,
        by: &Provenance,
        warn: &dyn Fn(String),
    ) -> Result<Account, RunFailure> {
        let forecast = self.forecast()?;
        match forecast.excess() {
            Some(excess) if mode.however_long => warn(excess),
            Some(excess) => {
                return refused(format!("{excess}; --yes-really runs it all the same"));
            }
            None => {}
        }
        Ok(Account {
            expected_error: expected_error::of(&self.case, self.setup.scene.grid.cell_m),
            lumens: chords::told(&self.setup.scene),
            left_out: left_out(&self.case, &self.setup, &forecast.stages),
            provenance: summary::provenance(by),
        })
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
        let courant = continued(checkpoint.courant, clock.step, cfl);
        Ok((clock, courant, history))
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
        let history = History::create(folder, &self.setup.scene, self.case.output.penetration)?;
        let courant = continued(Vec::new(), 0, schemes::cfl(&self.case));
        Ok((Clock::default(), courant, history))
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
}

/// Leaves the summary of a run that became unstable.
fn failed(folder: &RunFolder, failure: RunFailure, account: Account) -> RunFailure {
    if let RunFailure::Unstable {
        said, step, time_s, ..
    } = &failure
    {
        let failed = Failed {
            end: "failed",
            verdict: Verdict::because(vec![said.clone()]),
            steps: *step,
            time_s: *time_s,
            account,
        };
        // That the run failed is worse than that its folder does not say why.
        let _ = folder.write_text(SUMMARY, &summary::text(&failed));
    }
    failure
}

//! The time loop: steps until an end condition, with rows, snapshots and checkpoints on the way.

use std::time::{Duration, Instant};

use physics::{Diagnostics, Failure, Scheme, Stop};

use crate::bond_measures::BondMeter;
use crate::checkpoint::{self, Checkpoint, Origin};
use crate::clock::Clock;
use crate::courant::Courant;
use crate::end_conditions::{End, EndConditions, PossibleEnd};
use crate::failure::RunFailure;
use crate::folder::RunFolder;
use crate::history::History;
use crate::resolve::Setup;
use crate::snapshot::SnapshotWriter;
use crate::summary;
use crate::verdict;

/// Wall time between checkpoints.
const CHECKPOINT_EVERY: Duration = Duration::from_secs(60);

/// All that the time loop of a run needs.
pub(crate) struct TimeLoop<'a> {
    pub(crate) setup: &'a Setup,
    pub(crate) folder: &'a RunFolder,
    /// Progress of the run.
    pub(crate) clock: Clock,
    /// Courant numbers and the steps from which they hold.
    pub(crate) courant: Vec<Courant>,
    pub(crate) history: History,
    pub(crate) writer: &'a SnapshotWriter<'a>,
    /// Number of snapshots over the nominal duration, 0 for none. With a press programme: over the clamp's travel, and one more at
    /// the end of each stage.
    pub(crate) snapshots: u32,
    /// Measures the bond for each row of the history, if the case asks for it.
    pub(crate) meter: Option<&'a BondMeter<'a>>,
    /// Identity of the run in its checkpoints.
    pub(crate) origin: Origin,
    /// Whether the user has asked to stop.
    pub(crate) interrupted: &'a dyn Fn() -> bool,
    /// Called after every step with the possible ends, and with time and pressure as text.
    pub(crate) progress: &'a mut dyn FnMut(&[PossibleEnd], String),
}

/// Result of the time loop.
pub(crate) struct Outcome {
    pub(crate) end: End,
    /// Progress at the end.
    pub(crate) clock: Clock,
    pub(crate) courant: Vec<Courant>,
    /// Wall time spent in steps by this process.
    pub(crate) stepping: Duration,
    /// Steps taken by this process.
    pub(crate) steps_here: u64,
    /// Diagnostics of the last state.
    pub(crate) diagnostics: Diagnostics,
}

impl TimeLoop<'_> {
    /// Runs `scheme` until an end condition.
    /// Errors: an unstable state or an output that cannot be written.
    pub(crate) fn run(mut self, scheme: &mut dyn Scheme) -> Result<Outcome, RunFailure> {
        let ends = EndConditions::new(self.setup);
        let (mut stepping, mut steps_here) = (Duration::ZERO, 0);
        let mut last_checkpoint = Instant::now();
        let end = loop {
            if let Some(end) = ends.reached(&self.clock, scheme) {
                break end;
            }
            let (travel_before_m, stages) = (self.clock.travel_m, stages_over(scheme));
            let begun = Instant::now();
            let report = scheme
                .advance(ends.limit(&self.clock))
                .and_then(|report| verdict::check_step(self.setup, &report).map(|()| report))
                .map_err(|failure| self.unstable(failure))?;
            stepping += begun.elapsed();
            steps_here += 1;
            self.clock.advance(report);
            let pressure = summary::pressure(report.pressure_top, 3);
            let state = format!("{}, {pressure}", summary::time(self.clock.time_s, 3));
            (self.progress)(&ends.possible_ends(&self.clock), state);
            self.write_due(scheme, travel_before_m, stages_over(scheme) > stages)?;
            let stop = (self.interrupted)();
            if stop || last_checkpoint.elapsed() >= CHECKPOINT_EVERY {
                self.write_checkpoint(scheme)?;
                last_checkpoint = Instant::now();
            }
            if stop {
                break End::Interrupted;
            }
        };
        let diagnostics = scheme.diagnostics();
        if end != End::Interrupted {
            if self.clock.row_missing {
                self.row(scheme, diagnostics)?;
            }
            // Must come before the final state, which marks the run as ended.
            self.history.sync()?;
        }
        Ok(Outcome {
            end,
            clock: self.clock,
            courant: self.courant,
            stepping,
            steps_here,
            diagnostics,
        })
    }

    fn unstable(&self, Failure(failure): Failure) -> RunFailure {
        let Clock { step, time_s, .. } = self.clock;
        RunFailure::Unstable {
            said: format!("{failure}; the run stopped after step {step} at {time_s:.4e} s"),
            step,
            time_s,
            checkpoint: checkpoint::where_last(self.folder),
        }
    }

    /// Writes the row and the snapshot that are due after a step; `travel_before_m` is the clamp travel before the step.
    fn write_due(
        &mut self,
        scheme: &dyn Scheme,
        travel_before_m: f64,
        stage_over: bool,
    ) -> Result<(), RunFailure> {
        if self.clock.time_s >= self.clock.next_history_s {
            self.row(scheme, scheme.diagnostics())?;
            // After a step longer than the interval, do not catch up with one row per step.
            let next = self.clock.next_history_s + self.setup.history_every_s;
            self.clock.next_history_s = next.max(self.clock.time_s);
        }
        let by_time = self.clock.time_s >= self.clock.next_snapshot_s;
        let by_travel = match self.setup.scene.stop {
            Stop::Closed { travel_m } if scheme.programme().is_some() && self.snapshots > 0 => {
                let part = |travel: f64| (f64::from(self.snapshots) * travel / travel_m).floor();
                stage_over || part(self.clock.travel_m) > part(travel_before_m)
            }
            _ => false,
        };
        if by_time || by_travel {
            self.check_state(&scheme.diagnostics())?;
            self.writer.write_numbered(&mut self.clock, scheme)?;
        }
        if by_time {
            self.clock.next_snapshot_s += self.snapshot_every_s();
        }
        Ok(())
    }

    /// Time between snapshots, s; infinite for none, and for a press programme.
    fn snapshot_every_s(&self) -> f64 {
        match self.snapshots {
            n if n > 0 && self.setup.scene.programme.is_empty() => {
                self.setup.nominal_duration_s / f64::from(n)
            }
            _ => f64::INFINITY,
        }
    }

    fn write_checkpoint(&self, scheme: &dyn Scheme) -> Result<(), RunFailure> {
        // An unsound state is not saved. It does not end the run here either: the result must not depend on the wall clock, by
        // which checkpoints are due.
        if self.check_state(&scheme.diagnostics()).is_err() {
            return Ok(());
        }
        let checkpoint = Checkpoint {
            clock: self.clock,
            courant: self.courant.clone(),
            history: self.history.sync()?,
            saved: scheme.saving(),
        };
        checkpoint::write(self.folder, &self.origin, checkpoint)
    }

    /// Checks the state before any of it is written.
    fn check_state(&self, diagnostics: &Diagnostics) -> Result<(), RunFailure> {
        verdict::check_state(self.setup, diagnostics, self.clock.last_step.lost)
            .map_err(|failure| self.unstable(failure))
    }

    fn row(&mut self, scheme: &dyn Scheme, diagnostics: Diagnostics) -> Result<(), RunFailure> {
        self.check_state(&diagnostics)?;
        self.clock.row_missing = false;
        let stage = scheme.programme().map(|run| run.last_stage() + 1);
        let lost = self.clock.last_step.lost;
        let bond = (self.meter.map(|meter| meter.measure_row(scheme, lost))).transpose()?;
        (self.history).row(self.setup, &self.clock, &diagnostics, stage, bond)
    }
}

/// Number of ended stages of the press programme.
fn stages_over(scheme: &dyn Scheme) -> usize {
    scheme.programme().map_or(0, |run| run.ended().count())
}

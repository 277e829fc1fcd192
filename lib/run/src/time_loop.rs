//! The time loop: steps until the end, and what is written on the way.

use std::time::{Duration, Instant};

use physics::{Diagnostics, Failure, Scheme, Stop};

use crate::bond_measures::Watch;
use crate::checkpoint::{self, Checkpoint, Origin};
use crate::clock::Clock;
use crate::courant::Courant;
use crate::ends::{Ahead, End, Ends};
use crate::failure::RunFailure;
use crate::folder::RunFolder;
use crate::history::History;
use crate::resolve::Setup;
use crate::snapshot::SnapshotWriter;
use crate::summary;
use crate::verdict;

/// Wall time between checkpoints.
const CHECKPOINT_EVERY: Duration = Duration::from_secs(60);

/// A run about to take steps.
pub(crate) struct TimeLoop<'a> {
    pub(crate) setup: &'a Setup,
    pub(crate) folder: &'a RunFolder,
    /// Where the run is.
    pub(crate) clock: Clock,
    /// Which part of the run was, and will be, taken at which Courant number.
    pub(crate) courant: Vec<Courant>,
    pub(crate) history: History,
    pub(crate) writer: &'a SnapshotWriter<'a>,
    /// Snapshots over the nominal duration; under a press programme over the way of the clamp, and one at the end of
    /// each stage. 0 for none.
    pub(crate) snapshots: u32,
    /// What each row of the history tells of the bond, if that is asked for.
    pub(crate) watch: Option<&'a Watch<'a>>,
    /// What checkpoints are of.
    pub(crate) origin: Origin,
    /// Whether the user asked to stop.
    pub(crate) interrupted: &'a dyn Fn() -> bool,
    /// Told after every step: the ends ahead, and time and pressure in words.
    pub(crate) progress: &'a mut dyn FnMut(&[Ahead], String),
}

/// What the loop did.
pub(crate) struct Outcome {
    pub(crate) end: End,
    /// Clock at the end.
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
    /// Runs `scheme` to its end.
    /// Errors: an unstable state or an output that cannot be written.
    pub(crate) fn run(mut self, scheme: &mut dyn Scheme) -> Result<Outcome, RunFailure> {
        let ends = Ends::of(self.setup);
        let (mut stepping, mut steps_here) = (Duration::ZERO, 0);
        let mut last_checkpoint = Instant::now();
        let end = loop {
            if let Some(end) = ends.reached(&self.clock, scheme) {
                break end;
            }
            let (way, stages) = (self.clock.travel_m, stages_over(scheme));
            let begun = Instant::now();
            let report = scheme
                .advance(ends.limit(&self.clock))
                .and_then(|report| verdict::step(self.setup, &report).map(|()| report))
                .map_err(|failure| self.unstable(failure))?;
            stepping += begun.elapsed();
            steps_here += 1;
            self.clock.took(report);
            let pressure = summary::pressure(report.pressure_top, 3);
            let state = format!("{}, {pressure}", summary::time(self.clock.time_s, 3));
            (self.progress)(&ends.ahead(&self.clock), state);
            self.write_due(scheme, way, stages_over(scheme) > stages)?;
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
            // Before the final state, which says that the run has ended.
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

    /// Writes row and snapshot where they are due after a step from `way` (m) of the clamp on, which may have ended a
    /// stage of a press programme.
    fn write_due(
        &mut self,
        scheme: &dyn Scheme,
        way: f64,
        stage_over: bool,
    ) -> Result<(), RunFailure> {
        if self.clock.time_s >= self.clock.next_history_s {
            self.row(scheme, scheme.diagnostics())?;
            // After a step longer than the interval, do not catch up with a burst of rows.
            let next = self.clock.next_history_s + self.setup.history_every_s;
            self.clock.next_history_s = next.max(self.clock.time_s);
        }
        let by_time = self.clock.time_s >= self.clock.next_snapshot_s;
        let of_way = match self.setup.scene.stop {
            Stop::Closed { travel_m } if scheme.programme().is_some() && self.snapshots > 0 => {
                let part = |way: f64| (f64::from(self.snapshots) * way / travel_m).floor();
                stage_over || part(self.clock.travel_m) > part(way)
            }
            _ => false,
        };
        if by_time || of_way {
            self.look(&scheme.diagnostics())?;
            self.writer.write_numbered(&mut self.clock, scheme)?;
        }
        if by_time {
            self.clock.next_snapshot_s += self.snapshot_every_s();
        }
        Ok(())
    }

    /// Time between snapshots, s; infinite for none, and under a press programme.
    fn snapshot_every_s(&self) -> f64 {
        match self.snapshots {
            n if n > 0 && self.setup.scene.programme.is_empty() => {
                self.setup.nominal_duration_s / f64::from(n)
            }
            _ => f64::INFINITY,
        }
    }

    fn write_checkpoint(&self, scheme: &dyn Scheme) -> Result<(), RunFailure> {
        // What is not fit is no checkpoint, but only rows and snapshots end a run for it: a run
        // must not depend on when the wall clock asks.
        if self.look(&scheme.diagnostics()).is_err() {
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

    /// Looks at the state before any of it is written.
    fn look(&self, diagnostics: &Diagnostics) -> Result<(), RunFailure> {
        verdict::state(self.setup, diagnostics, self.clock.last.lost)
            .map_err(|failure| self.unstable(failure))
    }

    fn row(&mut self, scheme: &dyn Scheme, diagnostics: Diagnostics) -> Result<(), RunFailure> {
        self.look(&diagnostics)?;
        self.clock.row_missing = false;
        let stage = scheme.programme().map(|run| run.last_stage() + 1);
        let lost = self.clock.last.lost;
        let moment = (self.watch.map(|watch| watch.look(scheme, lost))).transpose()?;
        (self.history).row(self.setup, &self.clock, &diagnostics, stage, moment)
    }
}

/// Stages of a press programme that are over.
fn stages_over(scheme: &dyn Scheme) -> usize {
    scheme.programme().map_or(0, |run| run.ended().count())
}

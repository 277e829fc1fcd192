//! The time loop: steps until the end, and what is written on the way.

use std::time::{Duration, Instant};

use physics::{Diagnostics, Scheme, StepReport, Stop};

use crate::bond_measures::Watch;
use crate::checkpoint::{self, Checkpoint, Origin};
use crate::clock::Clock;
use crate::courant::Courant;
use crate::ends::{Ahead, End, Ends};
use crate::failure::RunError;
use crate::folder::RunFolder;
use crate::history::{History, RowMore};
use crate::resolve::Setup;
use crate::snapshot::SnapshotWriter;
use crate::verdict;

/// Wall time between checkpoints.
const CHECKPOINT_EVERY: Duration = Duration::from_secs(60);

/// What the loop needs beside setup and scheme.
pub(crate) struct Controls<'a> {
    /// Time between rows of the history, s.
    pub history_every_s: f64,
    /// Time between snapshots, s; infinite for none.
    pub snapshot_every_s: f64,
    /// Snapshots over the way of the clamp and one at the end of each stage, under a press programme;
    /// 0 for none.
    pub snapshots_of_way: u32,
    /// What each row of the history tells of the bond, if that is asked for.
    pub watch: Option<&'a Watch<'a>>,
    /// Whether the user asked to stop.
    pub interrupted: &'a dyn Fn() -> bool,
    /// Told after every step: the ends ahead, time in s, last report.
    pub progress: &'a mut dyn FnMut(&[Ahead], f64, &StepReport),
    /// What checkpoints are of.
    pub origin: Origin,
    /// Which part of the run was, and will be, taken at which Courant number.
    pub courant: Vec<Courant>,
}

/// What the loop did.
pub(crate) struct Outcome {
    /// How it ended.
    pub end: End,
    /// Clock at the end.
    pub clock: Clock,
    /// Wall time spent in steps by this process.
    pub stepping: Duration,
    /// Steps taken by this process.
    pub steps_here: u64,
    /// Diagnostics of the last state.
    pub diagnostics: Diagnostics,
}

/// Runs `scheme` to its end, from `clock` on.
///
/// # Errors
/// An unstable state or an output that cannot be written.
pub(crate) fn run_to_its_end(
    setup: &Setup,
    scheme: &mut dyn Scheme,
    clock: Clock,
    history: &mut History,
    snapshots: &SnapshotWriter,
    folder: &RunFolder,
    controls: &mut Controls,
) -> Result<Outcome, RunError> {
    let mut state = Loop::new(setup, folder, clock);
    state.stages_over = scheme.programme().map_or(0, |run| run.ended().count());
    loop {
        if let Some(end) = state.ends.reached(&state.clock, scheme) {
            return state.finish(end, scheme, history, controls.watch);
        }
        let begun = Instant::now();
        let report = scheme
            .advance(state.ends.limit(&state.clock))
            .and_then(|report| verdict::step(setup, &report).map(|()| report))
            .map_err(|failure| RunError::Unstable {
                failure,
                step: state.clock.step,
                time_s: state.clock.time_s,
                checkpoint: checkpoint::where_last(folder),
            })?;
        state.stepping += begun.elapsed();
        let stage = scheme.programme().map(|run| run.ended().count());
        state.took(report, stage, controls.snapshots_of_way);
        (controls.progress)(&state.ends.ahead(&state.clock), state.clock.time_s, &report);
        state.write_due(scheme, history, snapshots, controls)?;
        let stop = (controls.interrupted)();
        if stop || state.last_checkpoint.elapsed() >= CHECKPOINT_EVERY {
            // What is not fit is no checkpoint, but only rows and snapshots end a run for it: a run
            // must not depend on when the wall clock asks.
            if state.look(&scheme.diagnostics()).is_ok() {
                let checkpoint = Checkpoint {
                    clock: state.clock,
                    courant: controls.courant.clone(),
                    history: history.sync()?,
                    saved: scheme.saving(),
                };
                checkpoint::write(folder, &controls.origin, checkpoint)?;
            }
            state.last_checkpoint = Instant::now();
        }
        if stop {
            return state.finish(End::Interrupted, scheme, history, controls.watch);
        }
    }
}

struct Loop<'a> {
    setup: &'a Setup,
    ends: Ends<'a>,
    folder: &'a RunFolder,
    clock: Clock,
    stepping: Duration,
    steps_here: u64,
    last_checkpoint: Instant,
    /// Stages of a press programme that were over before the last step.
    stages_over: usize,
    /// Whether the last step ended a stage or brought the clamp to where a snapshot is due.
    snapshot_of_way: bool,
}

impl<'a> Loop<'a> {
    fn new(setup: &'a Setup, folder: &'a RunFolder, clock: Clock) -> Self {
        Self {
            setup,
            ends: Ends::of(setup),
            folder,
            clock,
            stepping: Duration::ZERO,
            steps_here: 0,
            last_checkpoint: Instant::now(),
            stages_over: 0,
            snapshot_of_way: false,
        }
    }

    /// Takes in a step, after which `over` stages of a press programme are over.
    fn took(&mut self, report: StepReport, over: Option<usize>, snapshots: u32) {
        if let (Some(over), Stop::Closed { travel_m }) = (over, self.setup.scene.stop) {
            let part = |travel: f64| (f64::from(snapshots) * travel / travel_m).floor();
            let passed = part(report.travel_m) > part(self.clock.travel_m);
            self.snapshot_of_way = snapshots > 0 && (passed || over > self.stages_over);
            self.stages_over = over;
        }
        self.clock.step += 1;
        self.clock.time_s += report.dt_s;
        self.clock.travel_m = report.travel_m;
        self.steps_here += 1;
        self.clock.last = report;
        self.clock.row_missing = true;
    }

    fn write_due(
        &mut self,
        scheme: &dyn Scheme,
        history: &mut History,
        snapshots: &SnapshotWriter,
        controls: &Controls,
    ) -> Result<(), RunError> {
        if self.clock.time_s >= self.clock.next_history_s {
            self.row(scheme, scheme.diagnostics(), history, controls.watch)?;
            self.clock.next_history_s += controls.history_every_s;
            // After a step longer than the interval, do not catch up with a burst of rows.
            self.clock.next_history_s = self.clock.next_history_s.max(self.clock.time_s);
        }
        let by_time = self.clock.time_s >= self.clock.next_snapshot_s;
        if by_time || self.snapshot_of_way {
            self.look(&scheme.diagnostics())?;
            snapshots.write_numbered(&mut self.clock, scheme)?;
        }
        if by_time {
            self.clock.next_snapshot_s += controls.snapshot_every_s;
        }
        Ok(())
    }

    /// Looks at the state before any of it is written.
    fn look(&self, diagnostics: &Diagnostics) -> Result<(), RunError> {
        let lost = self.clock.last.lost;
        verdict::state(self.setup, diagnostics, lost).map_err(|failure| RunError::Unstable {
            failure,
            step: self.clock.step,
            time_s: self.clock.time_s,
            checkpoint: checkpoint::where_last(self.folder),
        })
    }

    fn row(
        &mut self,
        scheme: &dyn Scheme,
        diagnostics: Diagnostics,
        history: &mut History,
        watch: Option<&Watch>,
    ) -> Result<(), RunError> {
        let gap = self.setup.initial_gap_m.map(|g| g - self.clock.travel_m);
        self.look(&diagnostics)?;
        self.clock.row_missing = false;
        let Clock { step, time_s, .. } = self.clock;
        let cure = self.setup.scene.liquid.cure.as_ref();
        let more = RowMore {
            factor: cure.map(|cure| cure.factor(time_s)),
            water: diagnostics.water,
            stage: scheme.programme().map(|run| run.last_stage() + 1),
            moment: watch.map(|watch| watch.look(scheme)).transpose()?,
        };
        history.row(step, time_s, gap, &self.clock.last, &diagnostics, more)
    }

    fn finish(
        mut self,
        end: End,
        scheme: &dyn Scheme,
        history: &mut History,
        watch: Option<&Watch>,
    ) -> Result<Outcome, RunError> {
        let diagnostics = scheme.diagnostics();
        if end != End::Interrupted {
            if self.clock.row_missing {
                self.row(scheme, diagnostics, history, watch)?;
            }
            // Before the final state, which says that the run has ended.
            history.sync()?;
        }
        Ok(Outcome {
            end,
            clock: self.clock,
            stepping: self.stepping,
            steps_here: self.steps_here,
            diagnostics,
        })
    }
}

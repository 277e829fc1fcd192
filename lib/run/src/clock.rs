//! Progress of a run in time.

use physics::StepReport;

/// Progress of a run: time, clamp travel and output written.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Clock {
    /// Steps taken.
    pub(crate) step: u64,
    /// Time, s.
    pub(crate) time_s: f64,
    /// Clamp travel, m.
    pub(crate) travel_m: f64,
    /// Time of the next row of the history, s.
    pub(crate) next_history_s: f64,
    /// Time of the next snapshot, s.
    pub(crate) next_snapshot_s: f64,
    /// Snapshots written.
    pub(crate) snapshots: u32,
    /// Report of the last step.
    pub(crate) last_step: StepReport,
    /// Whether the last step has no row in the history yet.
    pub(crate) row_missing: bool,
}

impl Clock {
    /// Advances by the step of `report`.
    pub(crate) fn advance(&mut self, report: StepReport) {
        self.step += 1;
        self.time_s += report.dt_s;
        self.travel_m = report.travel_m;
        self.last_step = report;
        self.row_missing = true;
    }

    /// Refuses the clock of a damaged checkpoint; `header_s` is the time in the file's header.
    pub(crate) fn check(&self, header_s: f64) -> Result<(), String> {
        /// Largest step number that a double holds exactly.
        const MOST_STEPS: u64 = 1 << 53;
        let due = |t: f64| t >= 0.0; // infinite if nothing is due
        let sound = self.time_s == header_s
            && self.travel_m.is_finite()
            && due(self.next_history_s)
            && due(self.next_snapshot_s)
            && self.step <= MOST_STEPS;
        match sound {
            true => Ok(()),
            false => Err(format!("its clock is invalid: {self:?}")),
        }
    }
}

//! Where a run is in time.

use physics::StepReport;

/// Where a run is in time, and what it has written.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Clock {
    /// Steps taken.
    pub(crate) step: u64,
    /// Time, s.
    pub(crate) time_s: f64,
    /// Clamp travel, m.
    pub(crate) travel_m: f64,
    /// When the next row of the history is due, s.
    pub(crate) next_history_s: f64,
    /// When the next snapshot is due, s.
    pub(crate) next_snapshot_s: f64,
    /// Snapshots written.
    pub(crate) snapshots: u32,
    /// Report of the last step, which the end of a run quotes.
    pub(crate) last: StepReport,
    /// Whether that step has no row in the history.
    pub(crate) row_missing: bool,
}

impl Clock {
    /// Takes in a step.
    pub(crate) fn took(&mut self, report: StepReport) {
        self.step += 1;
        self.time_s += report.dt_s;
        self.travel_m = report.travel_m;
        self.last = report;
        self.row_missing = true;
    }

    /// Refuses what is no place in time; `header_s` is the time that the file's header says.
    pub(crate) fn check(&self, header_s: f64) -> Result<(), String> {
        /// Steps that a double counts one by one.
        const MOST_STEPS: u64 = 1 << 53;
        let due = |t: f64| t >= 0.0; // infinite where nothing is due
        let sound = self.time_s == header_s
            && self.travel_m.is_finite()
            && due(self.next_history_s)
            && due(self.next_snapshot_s)
            && self.step <= MOST_STEPS;
        match sound {
            true => Ok(()),
            false => Err(format!("its clock is not that of a run: {self:?}")),
        }
    }
}

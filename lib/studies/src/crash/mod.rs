//! The kill campaign: runs that are killed, stopped, or denied the disk at every call by which
//! they change their folder must, continued, end byte for byte as the run in one piece.

pub mod campaign;
pub mod chains;
pub mod faults;
pub mod full_disk;
mod place;
mod report;
pub mod together;

use crate::Result;
use crate::method::Scheme;
use crate::study::{Study, side_by_side};

/// What came of one series of trials.
pub struct Row {
    /// What was done.
    pub series: &'static str,
    /// Scheme of the run.
    scheme: &'static str,
    /// What went wrong at each point.
    fault: &'static str,
    trials: usize,
    /// Those that did not end as they must, each in a sentence.
    pub wrong: Vec<String>,
}

impl Row {
    /// Trials by a scheme, done side by side; those that fail are named in their sentences.
    fn new<T: Sync + std::fmt::Display>(
        series: &'static str,
        scheme: Scheme,
        fault: &'static str,
        trials: &[T],
        trial: impl Fn(&T) -> Result<()> + Sync + Send,
    ) -> Self {
        let done: Vec<Result<()>> = side_by_side(trials, trial);
        let done = trials.iter().zip(done);
        let wrong = done.filter_map(|(of, done)| Some(format!("{of}: {}", done.err()?)));
        Self {
            series,
            scheme: scheme.name(),
            fault,
            trials: trials.len(),
            wrong: wrong.collect(),
        }
    }

    /// A line for the terminal.
    pub fn line(&self) -> String {
        let (right, trials) = (self.trials - self.wrong.len(), self.trials);
        let first = (self.wrong.first()).map_or(String::new(), |said| format!("; first: {said}"));
        format!(
            "{:<44} {:<9} {:<12} {right} of {trials} as they must{first}",
            self.series, self.scheme, self.fault
        )
    }
}

/// Rounds of two runs into one folder.
const ROUNDS: usize = 100;
/// Runs of each scheme that are interrupted several times.
const CHAINS: u64 = 100;

/// The study, all of it whatever is asked for.
///
/// # Errors
/// What keeps the trials from being made.
pub fn run(study: &Study) -> Result<bool> {
    let tell = |row: &Row| println!("{}", row.line());
    let (mut rows, mut left_out) = (Vec::new(), Vec::new());
    for row in [together::at_once(ROUNDS)?, together::meanwhile(ROUNDS)?] {
        tell(&row);
        rows.push(row);
    }
    if full_disk::available() {
        rows.extend(full_disk::rows(1, tell)?);
    } else {
        left_out.push("the full disk, as `prlimit` is not installed");
    }
    if faults::available() {
        rows.extend(campaign::rows(1, tell)?);
        rows.extend(chains::rows(CHAINS, tell)?);
    } else {
        left_out.push("kills and failing calls, as `strace` is not installed or may not trace");
    }
    report::write(study, &rows, &left_out)?;
    Ok(left_out.is_empty() && rows.iter().all(|row| row.wrong.is_empty()))
}

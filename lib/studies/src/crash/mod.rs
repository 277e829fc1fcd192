//! The kill campaign: runs that are killed, stopped, or denied the disk at every call by which
//! they change their folder must, continued, end byte for byte as the run in one piece.

pub mod campaign;
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
    /// Those that were not correct, each in a sentence.
    pub wrong: Vec<String>,
}

impl Row {
    /// Trials by a scheme, done side by side and said on standard output; those that fail are named in
    /// their sentences.
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
        let wrong: Vec<String> = wrong.collect();
        let (scheme, trials) = (scheme.name(), trials.len());
        let right = trials - wrong.len();
        let first = (wrong.first()).map_or(String::new(), |said| format!("; first: {said}"));
        println!("{series:<44} {scheme:<9} {fault:<12} {right} of {trials} correct{first}");
        Self {
            series,
            scheme,
            fault,
            trials,
            wrong,
        }
    }
}

/// Rounds of two runs into one folder.
const ROUNDS: usize = 100;
/// Runs of each scheme that are interrupted several times.
const CHAINS: u64 = 100;

/// The study, all of it whatever is asked for.
pub fn run(study: &Study) -> Result<bool> {
    let mut rows = vec![together::at_once(ROUNDS)?, together::meanwhile(ROUNDS)?];
    let mut left_out = Vec::new();
    if full_disk::available() {
        rows.extend(full_disk::rows(1)?);
    } else {
        left_out.push("the full disk, because `prlimit` is not installed");
    }
    if faults::available() {
        rows.extend(campaign::rows(1)?);
        rows.extend(campaign::interrupted(CHAINS)?);
    } else {
        left_out.push("kills and failing calls, because `strace` is not installed or has no permission to trace");
    }
    report::write(study, &rows, &left_out)?;
    Ok(left_out.is_empty() && rows.iter().all(|row| row.wrong.is_empty()))
}

//! Failures of a run.

use std::io;
use std::path::Path;

/// Why a run could not start or failed; tools map it to an exit status.
#[derive(Debug, thiserror::Error)]
pub enum RunFailure {
    /// Wrong usage or case file (exit 2).
    #[error("{0}")]
    Usage(String),
    /// Unreadable or corrupt data (exit 3).
    #[error("{0}")]
    Data(String),
    /// The run failed (exit 1).
    #[error("{0}")]
    Run(String),
    /// The state is no longer sound (exit 1); the same run would fail again.
    #[error("{said}{checkpoint}")]
    Unstable {
        /// What went wrong, independent of how often the run was continued.
        said: String,
        /// Last step taken.
        step: u64,
        /// Time after that step, s.
        time_s: f64,
        /// Where the last good checkpoint is, as the end of the sentence.
        checkpoint: String,
    },
}

impl RunFailure {
    /// The failure to write `path`.
    pub(crate) fn write(path: &Path) -> impl Fn(io::Error) -> Self + '_ {
        move |error| RunFailure::Run(format!("cannot write {}: {error}", path.display()))
    }
}

impl From<particle_file::Error> for RunFailure {
    fn from(error: particle_file::Error) -> Self {
        Self::Data(error.to_string())
    }
}

/// Refuses a case with the sentence `said`.
pub(crate) fn refused<T>(said: impl Into<String>) -> Result<T, RunFailure> {
    Err(RunFailure::Usage(said.into()))
}

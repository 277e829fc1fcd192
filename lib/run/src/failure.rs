//! Why a run could not be made ready or did not end well.

use std::io;
use std::path::Path;

/// Why a run could not be made ready or did not end well; tools map it to exit status.
#[derive(Debug, thiserror::Error)]
pub enum RunFailure {
    /// Usage or case file (exit 2).
    #[error("{0}")]
    Usage(String),
    /// Unreadable or corrupt data (exit 3).
    #[error("{0}")]
    Data(String),
    /// The run failed (exit 1).
    #[error("{0}")]
    Run(String),
    /// The state is no longer sound (exit 1): the same run fails again.
    #[error("{said}{checkpoint}")]
    Unstable {
        /// What went wrong, the same however often the run was continued.
        said: String,
        /// Last step taken.
        step: u64,
        /// Its time, s.
        time_s: f64,
        /// Where the last good checkpoint is, as the end of the sentence.
        checkpoint: String,
    },
}

impl RunFailure {
    /// Of an output at `path` that could not be written.
    pub(crate) fn write(path: &Path) -> impl Fn(io::Error) -> Self + '_ {
        move |error| RunFailure::Run(format!("cannot write {}: {error}", path.display()))
    }
}

impl From<particle_file::Error> for RunFailure {
    fn from(error: particle_file::Error) -> Self {
        Self::Data(error.to_string())
    }
}

/// Refuses a case with a sentence.
pub(crate) fn refused<T>(said: impl Into<String>) -> Result<T, RunFailure> {
    Err(RunFailure::Usage(said.into()))
}

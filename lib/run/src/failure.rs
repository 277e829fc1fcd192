//! Why a run could not be made ready or did not end well.

use std::io;
use std::path::Path;

use physics::Failure;

use crate::case::CaseError;

/// Why a run stopped without an end.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// The state is no longer sound.
    #[error("{failure}; the run stopped after step {step} at {time_s:.4e} s{checkpoint}")]
    Unstable {
        /// What the scheme found.
        failure: Failure,
        /// Last step taken.
        step: u64,
        /// Its time, s.
        time_s: f64,
        /// Where the last good checkpoint is, as the end of the sentence.
        checkpoint: String,
    },
    /// An output could not be written.
    #[error("cannot write {path}: {error}")]
    Write {
        /// File or folder.
        path: String,
        /// The system's reason.
        error: io::Error,
    },
    /// A checkpoint cannot be used.
    #[error("{0}")]
    Checkpoint(String),
    /// A checkpoint is of another case or particle file.
    #[error("{0}")]
    AnotherCase(String),
}

impl RunError {
    pub(crate) fn write(path: &Path) -> impl Fn(io::Error) -> Self + '_ {
        move |error| RunError::Write {
            path: path.display().to_string(),
            error,
        }
    }
}

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
        /// Where the last good checkpoint is, as the end of the sentence.
        checkpoint: String,
    },
}

impl RunFailure {
    /// The sentence, the same however often a run was continued.
    pub(crate) fn said(&self) -> String {
        match self {
            RunFailure::Unstable { said, .. } => said.clone(),
            other => other.to_string(),
        }
    }
}

impl From<CaseError> for RunFailure {
    fn from(error: CaseError) -> Self {
        RunFailure::Usage(error.0)
    }
}

impl From<RunError> for RunFailure {
    fn from(error: RunError) -> Self {
        match error {
            RunError::Checkpoint(said) | RunError::AnotherCase(said) => RunFailure::Data(said),
            RunError::Unstable {
                failure,
                step,
                time_s,
                checkpoint,
            } => {
                let without = RunError::Unstable {
                    failure,
                    step,
                    time_s,
                    checkpoint: String::new(),
                };
                RunFailure::Unstable {
                    said: without.to_string(),
                    checkpoint,
                }
            }
            RunError::Write { .. } => RunFailure::Run(error.to_string()),
        }
    }
}

//! Runs started by a command-line tool: progress on the terminal, stop by signals, failures as exit statuses.

use std::path::Path;

use cli::{Failure, Progress};
use particle_file::Provenance;

use crate::{Mode, Request, RunFailure, Summary};

impl Request {
    /// As [`Request::execute`], with progress on the terminal. The run is recorded as one of `mpm-run` at `version`, which can
    /// then continue it.
    ///
    /// # Errors
    /// As [`Request::execute`].
    pub fn execute_on_terminal(
        self,
        folder: &Path,
        mode: Mode,
        version: &str,
    ) -> Result<Option<Summary>, RunFailure> {
        let by = Provenance::of_process("mpm-run", version, Vec::new());
        let mut progress = Progress::new(&folder.display().to_string());
        let ended = self.execute(
            folder,
            mode,
            by,
            &cli::interrupted,
            &mut |ends, state| progress.update(ends, || state),
            &|warning| cli::warn(warning),
        );
        progress.finish();
        ended
    }
}

impl From<RunFailure> for Failure {
    fn from(failure: RunFailure) -> Self {
        match failure {
            RunFailure::Usage(said) => Self::usage(said),
            RunFailure::Data(said) => Self::data(said),
            failed @ (RunFailure::Run(_) | RunFailure::Unstable { .. }) => Self::failed(failed),
        }
    }
}

//! The run folder: what of an earlier run is kept, continued or replaced.

use std::fs;
use std::path::Path;

use crate::checkpoint::{self, Checkpoint};
use crate::drive::RunError;
use crate::request::RunFailure;
use crate::snapshot::write_whole;

/// The case as run.
pub(crate) const RESOLVED: &str = "resolved.toml";

/// What a run was, did and cost.
pub(crate) const SUMMARY: &str = "summary.json";

/// How an existing run folder is treated.
#[derive(Clone, Copy, Debug)]
pub struct Mode {
    /// Continue from its checkpoint.
    pub resume: bool,
    /// Replace what belongs to another run.
    pub overwrite: bool,
}

/// Makes the run folder ready and finds the checkpoint to start from; none to start anew.
///
/// # Errors
/// A folder that holds something else, a checkpoint that cannot be used, a failed write.
pub(crate) fn start(
    folder: &Path,
    mode: Mode,
    identity: &str,
    text: &str,
) -> Result<Option<Checkpoint>, RunFailure> {
    if fs::metadata(folder).is_ok_and(|found| !found.is_dir()) {
        return Err(RunFailure::Usage(format!(
            "'{}' is a file; a run needs a folder",
            folder.display()
        )));
    }
    fs::create_dir_all(folder).map_err(RunError::write(folder))?;
    if mode.resume {
        match checkpoint::read(folder, identity) {
            Ok(Some(checkpoint)) => return Ok(Some(checkpoint)),
            Ok(None) => {}
            Err(error) if !mode.overwrite => return Err(error.into()),
            Err(_) => {}
        }
    }
    let holds = |name: &str| folder.join(name).exists();
    // A run killed before its first checkpoint has nothing to lose.
    let begun = || fs::read_to_string(folder.join(RESOLVED)).is_ok_and(|found| found == text);
    let again = mode.resume && !holds("final.mpts") && begun();
    if !mode.overwrite && !again && (holds("history.csv") || holds("final.mpts")) {
        return Err(RunFailure::Usage(if mode.resume {
            format!(
                "'{}' holds another run, or the same of another version; use --overwrite to replace it",
                folder.display()
            )
        } else {
            format!(
                "'{}' already holds a run; use --resume to continue it or --overwrite to replace it",
                folder.display()
            )
        }));
    }
    for name in [
        "final.mpts",
        SUMMARY,
        "checkpoint.mpts",
        "history.csv",
        RESOLVED,
    ] {
        remove(fs::remove_file(folder.join(name)), &folder.join(name))?;
    }
    remove(
        fs::remove_dir_all(folder.join("snapshots")),
        &folder.join("snapshots"),
    )?;
    write_text(&folder.join(RESOLVED), text)?;
    Ok(None)
}

/// Removes the summary of a run that goes on: it would be wrong if the run fails.
pub(crate) fn remove_summary(folder: &Path) -> Result<(), RunError> {
    let path = folder.join(SUMMARY);
    remove(fs::remove_file(&path), &path)
}

/// A file that is not there need not be removed.
fn remove(result: std::io::Result<()>, path: &Path) -> Result<(), RunError> {
    match result {
        Err(e) if e.kind() != std::io::ErrorKind::NotFound => Err(RunError::write(path)(e)),
        _ => Ok(()),
    }
}

/// Writes a text file whole or not at all.
pub(crate) fn write_text(path: &Path, text: &str) -> Result<(), RunError> {
    write_whole(path, |out| out.write_all(text.as_bytes()))
}

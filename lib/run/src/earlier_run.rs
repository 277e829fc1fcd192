//! Files of an earlier run in a run folder: kept, continued or replaced.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use particle_file::{Kind, ParticleFile, Provenance};
use same_file::is_same_file;

use crate::checkpoint::{self, Checkpoint, Origin};
use crate::clock::Clock;
use crate::courant::without_cfl;
use crate::failure::RunFailure;
use crate::files::is_there;
use crate::folder::{
    ASIDE, CHECKPOINT, FINAL, HISTORY, RESOLVED, RunFolder, SNAPSHOTS, SUMMARY, snapshot_name,
};
use crate::resolved;

/// How an existing run folder is treated.
#[derive(Clone, Copy, Debug, Default)]
pub struct Mode {
    /// Continue from its checkpoint.
    pub resume: bool,
    /// Replace what belongs to another run.
    pub overwrite: bool,
    /// Start although the forecast says that the run will not end.
    pub however_long: bool,
}

/// The checkpoint to go on from, if there is one that is wanted. Nothing is changed.
/// Errors: a checkpoint that cannot be used and may not be replaced.
pub(crate) fn checkpoint(
    folder: &RunFolder,
    mode: Mode,
    origin: &Origin,
    text: &str,
) -> Result<Option<Checkpoint>, RunFailure> {
    // A run with a final state has ended; a checkpoint beside it waits to be removed.
    if !mode.resume || is_there(&folder.place(FINAL)) {
        return Ok(None);
    }
    match checkpoint::read(folder.path(), origin, &|| {
        changed(folder, text, without_cfl)
    }) {
        Ok(Some(checkpoint)) => {
            prove_snapshots(folder, checkpoint.clock.snapshots, &origin.by)?;
            folder.check_writable(&replaced(folder, checkpoint.clock.snapshots)?)?;
            Ok(Some(checkpoint))
        }
        Ok(None) => Ok(None),
        Err(_) if mode.overwrite => Ok(None),
        Err(error) => Err(error),
    }
}

/// Starts anew, with the earlier run's files gone.
/// Errors: another run that may not be replaced, a file in the way that is not the tool's own, a failed write.
pub(crate) fn anew(
    folder: &RunFolder,
    mode: Mode,
    text: &str,
    by: &Provenance,
) -> Result<(), RunFailure> {
    let holds = |name: &str| is_there(&folder.place(name));
    // A run killed before its first checkpoint has nothing to lose.
    let begun = || fs::read_to_string(folder.place(RESOLVED)).is_ok_and(|found| found == text);
    let again = mode.resume && !holds(FINAL) && begun();
    let lost = [HISTORY, FINAL, CHECKPOINT].into_iter().any(holds);
    if lost && !mode.overwrite && !again {
        return Err(held_by_a_run(folder, mode.resume, text));
    }
    clear(folder, by)?;
    folder.write_text(RESOLVED, text)?;
    Ok(())
}

/// What of the part of the case that counts is not as it was when the folder's run began; nothing where that is not known.
fn changed(folder: &RunFolder, text: &str, part: fn(&str) -> String) -> String {
    let Ok(was) = fs::read_to_string(folder.place(RESOLVED)) else {
        return String::new();
    };
    let changed = resolved::differences([text, &was], part);
    match changed.is_empty() {
        true => String::new(),
        false => format!(" ({})", changed.join("; ")),
    }
}

fn held_by_a_run(folder: &RunFolder, resume: bool, text: &str) -> RunFailure {
    let name = folder.path().display();
    RunFailure::Usage(match (resume, changed(folder, text, str::to_owned)) {
        (false, _) => format!(
            "'{name}' already holds a run; use --resume to continue it or --overwrite to replace it"
        ),
        (true, same) if same.is_empty() => format!(
            "'{name}' holds another run, of another bond or version or of a case file in other words; use --overwrite to replace it"
        ),
        (true, changed) => {
            format!("'{name}' holds another run{changed}; use --overwrite to replace it")
        }
    })
}

/// Removes what a run left that goes on from `clock`, but not its history: snapshots of
/// a course that may not come again, and a summary that would be wrong if the run fails.
pub(crate) fn forget_what_came_after(
    folder: &RunFolder,
    clock: &Clock,
    text: &str,
) -> Result<(), RunFailure> {
    for name in snapshots(folder, clock.snapshots)? {
        folder.remove(&name)?;
    }
    folder.remove(SUMMARY)?;
    folder.write_text(RESOLVED, text)?;
    Ok(())
}

/// Removes the files of an earlier run, once all are known to be the tool's own; first those
/// that make it worth keeping, so that a kill does not leave a run that only looks whole.
fn clear(folder: &RunFolder, by: &Provenance) -> Result<(), RunFailure> {
    if is_there(&folder.place(FINAL)) {
        prove_state(folder, FINAL, by)?;
    }
    if is_there(&folder.place(CHECKPOINT)) {
        prove(folder, CHECKPOINT, |file| {
            file.header().kind == Kind::Checkpoint
        })?;
    }
    prove_snapshots(folder, 0, by)?;
    folder.check_writable(&replaced(folder, 0)?)?;
    for name in [FINAL, CHECKPOINT, SUMMARY, HISTORY] {
        folder.remove(name)?;
    }
    for name in snapshots(folder, 0)? {
        folder.remove(&name)?;
    }
    // One that holds other files stays.
    let _ = fs::remove_dir(folder.place(SNAPSHOTS));
    Ok(())
}

/// Removes what a kill after the final state left: its run has nothing to continue.
pub(crate) fn tidy(folder: &RunFolder, origin: &Origin) -> Result<(), RunFailure> {
    if checkpoint::read(folder.path(), origin, &String::new).is_ok_and(|found| found.is_some()) {
        folder.remove(CHECKPOINT)?;
    }
    Ok(())
}

/// Refuses a folder in which something else stands at a name of the run's, or one of `inputs`;
/// removes unfinished files that a killed run left.
pub(crate) fn make_room(folder: &RunFolder, inputs: &[PathBuf]) -> Result<(), RunFailure> {
    let snapshots_folder = folder.place(SNAPSHOTS);
    if fs::symlink_metadata(&snapshots_folder).is_ok_and(|found| !found.is_dir()) {
        return Err(in_the_way(
            &snapshots_folder,
            "not a folder of the run's own",
        ));
    }
    let asides = [ASIDE.to_owned(), format!("{SNAPSHOTS}/{ASIDE}")];
    for name in replaced(folder, 0)?.iter().chain(&asides) {
        let path = folder.place(name);
        let Ok(found) = fs::symlink_metadata(&path) else {
            continue;
        };
        if !found.is_file() {
            return Err(in_the_way(&path, "not a file of the run's own"));
        }
        if inputs.iter().any(|input| is_same(input, &path)) {
            return Err(in_the_way(&path, "read by this run"));
        }
    }
    for name in &asides {
        folder.remove(name)?;
    }
    Ok(())
}

/// Whether a path is another name of the regular file `input`; opening a pipe would wait for its writer.
fn is_same(input: &Path, path: &Path) -> bool {
    fs::metadata(input).is_ok_and(|found| found.is_file())
        && is_same_file(input, path).unwrap_or(false)
}

/// Names of the files that a run replaces which goes on with snapshot number `first`.
fn replaced(folder: &RunFolder, first: u32) -> Result<Vec<String>, RunFailure> {
    let names = [FINAL, CHECKPOINT, SUMMARY, HISTORY, RESOLVED].map(String::from);
    Ok([names.into(), snapshots(folder, first)?].concat())
}

/// Names in the run folder of the snapshots from number `first` on.
fn snapshots(folder: &RunFolder, first: u32) -> Result<Vec<String>, RunFailure> {
    let path = folder.place(SNAPSHOTS);
    let entries = match fs::read_dir(&path) {
        Err(e) if e.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
        entries => entries.map_err(RunFailure::write(&path))?,
    };
    let mut found = Vec::new();
    for entry in entries {
        let file = entry.map_err(RunFailure::write(&path))?.file_name();
        let digits = file.to_str().and_then(|name| name.strip_suffix(".mpts"));
        let Some(number) = digits.and_then(|digits| digits.parse().ok()) else {
            continue;
        };
        let name = snapshot_name(number);
        if number >= first && Path::new(&name).file_name() == Some(&file) {
            found.push(name);
        }
    }
    found.sort_unstable();
    Ok(found)
}

/// Fails unless the snapshots from number `first` on, which go, are states that this tool wrote.
fn prove_snapshots(folder: &RunFolder, first: u32, by: &Provenance) -> Result<(), RunFailure> {
    (snapshots(folder, first)?.iter()).try_for_each(|name| prove_state(folder, name, by))
}

/// Fails unless `name` is a state that this tool wrote.
fn prove_state(folder: &RunFolder, name: &str, by: &Provenance) -> Result<(), RunFailure> {
    prove(folder, name, |file| {
        let header = file.header();
        let writer = header.provenance.last();
        header.kind == Kind::State && writer.is_some_and(|last| last.tool == by.tool)
    })
}

/// Fails unless `name` is a sound particle file that `is_own`.
fn prove(
    folder: &RunFolder,
    name: &str,
    is_own: impl FnOnce(&ParticleFile) -> bool,
) -> Result<(), RunFailure> {
    let path = folder.place(name);
    if ParticleFile::open(&path).is_ok_and(|file| is_own(&file)) {
        Ok(())
    } else {
        Err(in_the_way(&path, "not a file that a run wrote"))
    }
}

fn in_the_way(path: &Path, what: &str) -> RunFailure {
    RunFailure::Usage(format!(
        "'{}' is {what} and stands where the run writes: move it away or name another run folder",
        path.display()
    ))
}

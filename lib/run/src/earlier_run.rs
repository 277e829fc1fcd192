//! Files of an earlier run in a run folder: keep, continue or replace them.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use particle_file::{Kind, ParticleFile, Provenance};
use same_file::is_same_file;

use crate::checkpoint::{self, Checkpoint, Origin};
use crate::clock::Clock;
use crate::courant::without_cfl;
use crate::failure::RunFailure;
use crate::files::is_taken;
use crate::folder::{
    CHECKPOINT, FINAL, HISTORY, RESOLVED, RunFolder, SNAPSHOTS, SUMMARY, TEMPORARY, snapshot_name,
};
use crate::resolved;

/// Treatment of an earlier run in the folder, and of a forecast that is too long.
#[derive(Clone, Copy, Debug, Default)]
pub struct Mode {
    /// Continue from the checkpoint.
    pub resume: bool,
    /// Replace the files of another run.
    pub overwrite: bool,
    /// Start even if the forecast exceeds the bounds of time or memory.
    pub however_long: bool,
}

/// The checkpoint to continue from; `None` if there is none or `mode` does not ask for it. Changes no file.
/// Errors: the checkpoint cannot be used and may not be replaced.
pub(crate) fn checkpoint(
    folder: &RunFolder,
    mode: Mode,
    origin: &Origin,
    text: &str,
) -> Result<Option<Checkpoint>, RunFailure> {
    // A run with a final state has ended; the checkpoint beside it is a leftover.
    if !mode.resume || is_taken(&folder.path_of(FINAL)) {
        return Ok(None);
    }
    match checkpoint::read(folder.path(), origin, &|| {
        differing_keys(folder, text, without_cfl)
    }) {
        Ok(Some(checkpoint)) => {
            check_own_snapshots(folder, checkpoint.clock.snapshots, &origin.by)?;
            folder.check_writable(&replaced_names(folder, checkpoint.clock.snapshots)?)?;
            Ok(Some(checkpoint))
        }
        Ok(None) => Ok(None),
        Err(_) if mode.overwrite => Ok(None),
        Err(error) => Err(error),
    }
}

/// Starts from the beginning: removes the earlier run's files and writes `resolved.toml`.
/// Errors: another run that may not be replaced, a file that a run did not write at one of its names, a failed write.
pub(crate) fn start_anew(
    folder: &RunFolder,
    mode: Mode,
    text: &str,
    by: &Provenance,
) -> Result<(), RunFailure> {
    let holds = |name: &str| is_taken(&folder.path_of(name));
    // The same run, killed before its first checkpoint, has nothing to lose.
    let begun = || fs::read_to_string(folder.path_of(RESOLVED)).is_ok_and(|found| found == text);
    let again = mode.resume && !holds(FINAL) && begun();
    let lost = [HISTORY, FINAL, CHECKPOINT].into_iter().any(holds);
    if lost && !mode.overwrite && !again {
        return Err(holds_a_run(folder, mode.resume, text));
    }
    remove_earlier_run(folder, by)?;
    folder.write_text(RESOLVED, text)?;
    Ok(())
}

/// The keys that differ from the case of the folder's run, in brackets; empty if that case is not known. `part` selects the
/// part of the case text to compare.
fn differing_keys(folder: &RunFolder, text: &str, part: fn(&str) -> String) -> String {
    let Ok(was) = fs::read_to_string(folder.path_of(RESOLVED)) else {
        return String::new();
    };
    let changed = resolved::differences([text, &was], part);
    match changed.is_empty() {
        true => String::new(),
        false => format!(" ({})", changed.join("; ")),
    }
}

fn holds_a_run(folder: &RunFolder, resume: bool, text: &str) -> RunFailure {
    let name = folder.path().display();
    RunFailure::Usage(
        match (resume, differing_keys(folder, text, str::to_owned)) {
            (false, _) => format!(
                "'{name}' already holds a run; use --resume to continue it or --overwrite to replace it"
            ),
            (true, same) if same.is_empty() => format!(
                "'{name}' holds another run: its bond file, version or wording of the case file differs; use --overwrite to replace it"
            ),
            (true, changed) => {
                format!("'{name}' holds another run{changed}; use --overwrite to replace it")
            }
        },
    )
}

/// Prepares a run that continues from `clock`: removes later snapshots, which need not come again, and the summary, which
/// would be wrong if the run fails. The history is cut elsewhere.
pub(crate) fn prepare_continuation(
    folder: &RunFolder,
    clock: &Clock,
    text: &str,
) -> Result<(), RunFailure> {
    for name in snapshot_names(folder, clock.snapshots)? {
        folder.remove(&name)?;
    }
    folder.remove(SUMMARY)?;
    folder.write_text(RESOLVED, text)?;
    Ok(())
}

/// Removes the files of an earlier run after checking that a run wrote all of them. The final state goes first, so that a
/// kill in between leaves no run that looks complete.
fn remove_earlier_run(folder: &RunFolder, by: &Provenance) -> Result<(), RunFailure> {
    if is_taken(&folder.path_of(FINAL)) {
        check_own_state(folder, FINAL, by)?;
    }
    if is_taken(&folder.path_of(CHECKPOINT)) {
        check_own(folder, CHECKPOINT, |file| {
            file.header().kind == Kind::Checkpoint
        })?;
    }
    check_own_snapshots(folder, 0, by)?;
    folder.check_writable(&replaced_names(folder, 0)?)?;
    for name in [FINAL, CHECKPOINT, SUMMARY, HISTORY] {
        folder.remove(name)?;
    }
    for name in snapshot_names(folder, 0)? {
        folder.remove(&name)?;
    }
    // A folder with other files in it stays.
    let _ = fs::remove_dir(folder.path_of(SNAPSHOTS));
    Ok(())
}

/// Removes the checkpoint that a kill after the final state left behind.
pub(crate) fn remove_leftover_checkpoint(
    folder: &RunFolder,
    origin: &Origin,
) -> Result<(), RunFailure> {
    if checkpoint::read(folder.path(), origin, &String::new).is_ok_and(|found| found.is_some()) {
        folder.remove(CHECKPOINT)?;
    }
    Ok(())
}

/// Refuses a folder in which a name of the run is taken by another kind of file or by one of `inputs`. Removes unfinished
/// files of a killed run.
pub(crate) fn make_room(folder: &RunFolder, inputs: &[PathBuf]) -> Result<(), RunFailure> {
    let snapshots_folder = folder.path_of(SNAPSHOTS);
    if fs::symlink_metadata(&snapshots_folder).is_ok_and(|found| !found.is_dir()) {
        return Err(in_the_way(
            &snapshots_folder,
            "not a folder of the run's own",
        ));
    }
    let asides = [TEMPORARY.to_owned(), format!("{SNAPSHOTS}/{TEMPORARY}")];
    for name in replaced_names(folder, 0)?.iter().chain(&asides) {
        let path = folder.path_of(name);
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

/// Whether `path` is another name of the regular file `input`. Pipes are left out: opening one would wait for its writer.
fn is_same(input: &Path, path: &Path) -> bool {
    fs::metadata(input).is_ok_and(|found| found.is_file())
        && is_same_file(input, path).unwrap_or(false)
}

/// Names of the files that a run replaces when its next snapshot is number `first`.
fn replaced_names(folder: &RunFolder, first: u32) -> Result<Vec<String>, RunFailure> {
    let names = [FINAL, CHECKPOINT, SUMMARY, HISTORY, RESOLVED].map(String::from);
    Ok([names.into(), snapshot_names(folder, first)?].concat())
}

/// Names of the snapshots from number `first` on.
fn snapshot_names(folder: &RunFolder, first: u32) -> Result<Vec<String>, RunFailure> {
    let path = folder.path_of(SNAPSHOTS);
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

/// Fails unless this tool wrote all snapshots from number `first` on.
fn check_own_snapshots(folder: &RunFolder, first: u32, by: &Provenance) -> Result<(), RunFailure> {
    (snapshot_names(folder, first)?.iter()).try_for_each(|name| check_own_state(folder, name, by))
}

/// Fails unless `name` is a state file written by this tool.
fn check_own_state(folder: &RunFolder, name: &str, by: &Provenance) -> Result<(), RunFailure> {
    check_own(folder, name, |file| {
        let header = file.header();
        let writer = header.provenance.last();
        header.kind == Kind::State && writer.is_some_and(|last| last.tool == by.tool)
    })
}

/// Fails unless `name` is a valid particle file for which `is_own` holds.
fn check_own(
    folder: &RunFolder,
    name: &str,
    is_own: impl FnOnce(&ParticleFile) -> bool,
) -> Result<(), RunFailure> {
    let path = folder.path_of(name);
    if ParticleFile::open(&path).is_ok_and(|file| is_own(&file)) {
        Ok(())
    } else {
        Err(in_the_way(&path, "not a file that a run wrote"))
    }
}

fn in_the_way(path: &Path, what: &str) -> RunFailure {
    RunFailure::Usage(format!(
        "'{}' is {what}, but the run writes to this name: move it away or name another run folder",
        path.display()
    ))
}

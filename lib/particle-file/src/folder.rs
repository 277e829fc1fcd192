//! Particle files in folders.

use std::fs;
use std::path::{Path, PathBuf};

use crate::{Error, Kind, ParticleFile};

/// Marks a folder as a run's.
pub const RUN_MARK: &str = "bondline-run.toml";

/// Attribute of a state: what identifies its run.
pub const IDENTITY: &str = "identity";

/// The particle files in a folder, by name; none where there is no such folder. Hidden ones are passed over.
pub fn in_folder(folder: &Path) -> Vec<PathBuf> {
    let list = fs::read_dir(folder).into_iter().flatten();
    let shown = |path: &Path| {
        let name = path.file_name().unwrap_or_default();
        !name.as_encoded_bytes().starts_with(b".")
            && path
                .extension()
                .is_some_and(|e| e.eq_ignore_ascii_case("mpts"))
    };
    let paths = list.filter_map(|entry| Some(entry.ok()?.path()));
    let mut found: Vec<PathBuf> = paths.filter(|path| shown(path)).collect();
    found.sort();
    found
}

/// The states in the folder of a run: its snapshots and the last.
pub fn states_of_run(folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let mut states = in_folder(&folder.join("snapshots"));
    states.extend(Some(folder.join("final.mpts")).filter(|path| path.is_file()));
    match states.is_empty() {
        false => Ok(states),
        true => Err(lacks(folder, "state (snapshots/*.mpts, final.mpts)")),
    }
}

/// The file `name` in the folder of a run.
pub fn file_of_run(folder: &Path, name: &str) -> Result<PathBuf, Error> {
    let path = folder.join(name);
    match path.exists() {
        true => Ok(path),
        false => Err(lacks(folder, name)),
    }
}

/// Of a folder given as a run's that has not `what` every run has.
fn lacks(folder: &Path, what: &str) -> Error {
    let why = match (folder.join(RUN_MARK).is_file(), folder.is_dir()) {
        (true, _) => format!("is the folder of a run that has written no {what} yet"),
        (_, true) => format!("is not a run folder of mpm-run: it has no {what}"),
        _ => "is not a run folder of mpm-run: there is no such folder".into(),
    };
    Error::new(folder.display().to_string(), why)
}

/// A run's states, opened, in order of their times, each once: the last snapshot may be the final state. Beside them there may be
/// what the run began with, at no time.
///
/// # Errors
/// A file that cannot be read; states of two runs, which may lie at the same times.
pub fn by_time(files: Vec<PathBuf>) -> Result<Vec<(PathBuf, ParticleFile)>, Error> {
    let opened = files.into_iter().map(|path| {
        let file = ParticleFile::open(&path)?;
        Ok((path, file))
    });
    let mut files = opened.collect::<Result<Vec<_>, Error>>()?;
    let mut states = files
        .iter()
        .filter(|(_, file)| file.header().kind == Kind::State);
    if let Some(first) = states.next()
        && let Some((path, _)) = states.find(|state| !same_run(state, first))
    {
        let what = format!(
            "is of another run than '{}': a series is of one run",
            first.0.display()
        );
        return Err(Error::misplaced(path.display().to_string(), what));
    }
    files.sort_by(|(_, a), (_, b)| a.header().time_s.total_cmp(&b.header().time_s));
    let is_state = |file: &ParticleFile| file.header().kind == Kind::State;
    files.dedup_by(|(_, a), (_, b)| {
        is_state(a) && is_state(b) && a.header().time_s == b.header().time_s
    });
    Ok(files)
}

/// Whether two states are of one run, by its folder or by what they say of it: a run that went on with another version or
/// Courant number says something else since.
fn same_run((a, one): &(PathBuf, ParticleFile), (b, other): &(PathBuf, ParticleFile)) -> bool {
    let folder = |path: &Path| {
        let path = fs::canonicalize(path).ok()?;
        let mut above = path.ancestors().skip(1).take(2).map(Path::to_owned);
        above.find(|folder| folder.join(RUN_MARK).is_file())
    };
    let run = |file: &ParticleFile| file.header().attribute(IDENTITY).map(str::to_owned);
    run(one) == run(other) || folder(a).is_some_and(|at| Some(at) == folder(b))
}

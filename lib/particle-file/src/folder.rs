//! Particle files in folders.

use std::fs;
use std::path::{Path, PathBuf};

use crate::{Error, ParticleFile};

/// Marks a folder as a run's.
pub const RUN_MARK: &str = "bondline-run.toml";

/// The particle files in a folder, by name; none where there is no such folder. Hidden ones are passed over.
pub fn in_folder(folder: &Path) -> Vec<PathBuf> {
    let list = fs::read_dir(folder).into_iter().flatten();
    let shown = |path: &Path| {
        let name = path.file_name().unwrap_or_default();
        !name.as_encoded_bytes().starts_with(b".") && path.extension().is_some_and(|e| e == "mpts")
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

/// Particle files in order of their times, one of each: the last snapshot may be the final state.
pub fn by_time(files: Vec<PathBuf>) -> Result<Vec<PathBuf>, Error> {
    let timed = files.into_iter().map(|path| {
        let time_s = ParticleFile::open(&path)?.header().time_s;
        Ok((time_s, path))
    });
    let mut timed = timed.collect::<Result<Vec<_>, Error>>()?;
    timed.sort_by(|a, b| a.0.total_cmp(&b.0));
    timed.dedup_by(|a, b| a.0 == b.0);
    Ok(timed.into_iter().map(|(_, path)| path).collect())
}

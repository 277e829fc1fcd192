//! The states of a series, in order of time.

use std::fs;
use std::path::{Path, PathBuf};

use cli::Failure;
use particle_file::ParticleFile;

use crate::Arguments;

/// The files to measure: as given or, of a series, the states of runs' folders and other files by time.
pub fn of(arguments: &Arguments) -> Result<Vec<PathBuf>, Failure> {
    if !arguments.series {
        return Ok(arguments.files.clone());
    }
    let mut states = Vec::new();
    for path in &arguments.files {
        match path.is_dir() {
            true => states.extend(of_run(path)?),
            false if path.as_os_str() == "-" => {
                return Err(Failure::usage(
                    "--series takes files, whose times are read first, and not standard input",
                ));
            }
            false => states.push(path.clone()),
        }
    }
    let mut timed = Vec::new();
    for path in states {
        let file = ParticleFile::open(&path).map_err(Failure::data)?;
        timed.push((file.header().time_s, path));
    }
    timed.sort_by(|a, b| a.0.total_cmp(&b.0));
    // The last snapshot may be the final state.
    timed.dedup_by(|a, b| a.0 == b.0);
    Ok(timed.into_iter().map(|(_, path)| path).collect())
}

/// The states in a run's folder.
fn of_run(folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let mut states = Vec::new();
    if let Ok(list) = fs::read_dir(folder.join("snapshots")) {
        let paths = list.filter_map(|entry| Some(entry.ok()?.path()));
        states.extend(paths.filter(|path| path.extension().is_some_and(|e| e == "mpts")));
    }
    states.sort();
    states.extend(Some(folder.join("final.mpts")).filter(|path| path.is_file()));
    if states.is_empty() {
        return Err(Failure::data(format!(
            "'{}' holds no state of a run: snapshots/*.mpts or final.mpts is needed",
            folder.display()
        )));
    }
    Ok(states)
}

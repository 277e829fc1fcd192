//! The files to measure: specimens of folders, and the states of a series in order of time.

use std::fs;
use std::path::{Path, PathBuf};

use cli::Failure;
use particle_file::ParticleFile;

use crate::arguments::Arguments;

/// The files to measure: as given, a folder of particle files by name; of a series, the states of runs' folders and other
/// files by time.
pub fn of(arguments: &Arguments) -> Result<Vec<PathBuf>, Failure> {
    if !arguments.series {
        let found = arguments.files.iter().map(|path| match in_folder(path) {
            files if files.is_empty() => vec![path.clone()],
            files => files,
        });
        return Ok(found.flatten().collect());
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
    let mut states = in_folder(&folder.join("snapshots"));
    states.extend(Some(folder.join("final.mpts")).filter(|path| path.is_file()));
    if states.is_empty() {
        return Err(Failure::data(format!(
            "'{}' holds no state of a run: snapshots/*.mpts or final.mpts is needed",
            folder.display()
        )));
    }
    Ok(states)
}

/// The particle files in a folder, by name; none where it holds slices of a stack, or is no folder.
fn in_folder(folder: &Path) -> Vec<PathBuf> {
    let list = fs::read_dir(folder).into_iter().flatten();
    let paths: Vec<PathBuf> = list.filter_map(|entry| Some(entry.ok()?.path())).collect();
    if paths.iter().any(|path| voxels::is_slice(path)) {
        return Vec::new();
    }
    let hidden = |path: &Path| (path.file_name()).is_some_and(|n| n.as_encoded_bytes()[0] == b'.');
    let mut found: Vec<_> = (paths.into_iter())
        .filter(|path| path.extension().is_some_and(|e| e == "mpts") && !hidden(path))
        .collect();
    found.sort();
    found
}

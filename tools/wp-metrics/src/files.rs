//! The files to measure: specimens of folders, and the states of a series in order of time.

use std::path::{Path, PathBuf};

use cli::Failure;
use particle_file::{RUN_MARK, by_time, file_of_run, in_folder, states_of_run};

use crate::arguments::Arguments;

/// The files to measure: as given, a folder of particle files by name; of a series, the states of runs' folders and other
/// files by time.
pub fn of(arguments: &Arguments) -> Result<Vec<PathBuf>, Failure> {
    if !arguments.series {
        let found = arguments.files.iter().map(|path| specimens(path));
        let found = found.collect::<Result<Vec<_>, _>>()?;
        return Ok(found.into_iter().flatten().collect());
    }
    let mut states = Vec::new();
    for path in &arguments.files {
        match path.is_dir() {
            true => states.extend(states_of_run(path).map_err(Failure::data)?),
            false if path.as_os_str() == "-" => {
                return Err(Failure::usage(
                    "--series takes files, not standard input: it reads their times first",
                ));
            }
            false => states.push(path.clone()),
        }
    }
    let states = by_time(states).map_err(|e| Failure::of_input(e.is_usage(), e))?;
    Ok(states.into_iter().map(|(path, _)| path).collect())
}

/// A file or a folder of slices itself, the last state of a run, or the particle files of a folder of those.
fn specimens(path: &Path) -> Result<Vec<PathBuf>, Failure> {
    if path.join(RUN_MARK).is_file() {
        return Ok(vec![
            file_of_run(path, "final.mpts").map_err(Failure::data)?,
        ]);
    }
    let files = in_folder(path);
    if files.is_empty() {
        return Ok(vec![path.to_owned()]);
    }
    match voxels::holds_slices(path) {
        // Slices may be pictures of the specimens, particle files what was made of the slices.
        true => Err(Failure::usage(format!(
            "'{0}' holds particle files and slices: name the particle files, as in '{0}'/*.mpts, or move them away from the slices",
            path.display()
        ))),
        false => Ok(files),
    }
}

//! Whether a file still belongs to the files that it was made from.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use particle_file::{Mapped, RUN_MARK};
use serde_json::Value;
use xxhash_rust::xxh3::xxh3_64;

use crate::Error;
use crate::run_end::small_text;

/// Inputs whose content is looked at: states, and tables made from them.
const KINDS: [&str; 2] = ["mpts", "csv"];
/// Most records one behind the other: a picture of a table of a state has two.
const DEEPEST: usize = 4;

/// Refuses a file if the record beside it names another content of an input than that has now, as after
/// `mpm-run --overwrite`, or if it lies in a run's folder and was made from a file of this name in another one.
/// An input that is no longer there, and a file without a record, are not known to differ.
///
/// # Errors
/// [`Error::Data`], naming the file, the input and the tool to run again.
pub fn check_origin(file: &Path) -> Result<(), Error> {
    follow(file, DEEPEST)
}

fn follow(file: &Path, deeper: usize) -> Result<(), Error> {
    let Some((tool, mut inputs)) = record(file).filter(|_| deeper > 0) else {
        return Ok(());
    };
    let looked_at = |kind: &str| KINDS.contains(&kind.to_lowercase().as_str());
    inputs.retain(|(path, _)| {
        path.extension()
            .and_then(OsStr::to_str)
            .is_some_and(looked_at)
    });
    let folder = file.parent().unwrap_or(Path::new(""));
    let of_run = folder.join(RUN_MARK).is_file();
    for (input, hash) in &inputs {
        let name = input.file_name().unwrap_or_default();
        // Two runs in one record have states of one name: the other may be the one that lies here.
        let others = || (inputs.iter()).filter(|(i, _)| i != input && i.file_name() == Some(name));
        let beside = [folder.join(name), folder.join("snapshots").join(name)];
        let beside = (beside.into_iter().filter(|path| path.is_file()))
            .filter(|path| !others().any(|(_, hash)| has(path, hash)));
        let mut places: Vec<PathBuf> = beside.collect();
        if places.is_empty() || !of_run {
            let given = [input.clone(), folder.join(input)];
            places.extend(given.into_iter().filter(|path| path.is_file()));
        }
        match places.iter().find(|path| has(path, hash)) {
            Some(same) => follow(same, deeper - 1)?,
            None => {
                if let Some(other) = places.first() {
                    return Err(Error::Data(format!(
                        "'{}' does not belong to the present '{}': run {tool} again",
                        file.display(),
                        other.display()
                    )));
                }
            }
        }
    }
    Ok(())
}

fn has(path: &Path, hash: &str) -> bool {
    let bytes = Mapped::open(path, |_| true);
    bytes.is_ok_and(|bytes| hash == format!("{:016x}", xxh3_64(&bytes)))
}

/// The tool that wrote a file, and its inputs with their hashes, by the record beside it.
pub fn record(file: &Path) -> Option<(String, Vec<(PathBuf, String)>)> {
    let mut record = file.to_owned().into_os_string();
    record.push(".provenance.json");
    let record: Value = serde_json::from_str(&small_text(record.as_ref()).ok()?).ok()?;
    let inputs = record.get("inputs")?.as_array()?.iter();
    let inputs = inputs.filter_map(|input| {
        Some((
            input["path"].as_str()?.into(),
            input["xxh3"].as_str()?.to_owned(),
        ))
    });
    let tool = record["tool"].as_str().unwrap_or("its tool").to_owned();
    Some((tool, inputs.collect()))
}

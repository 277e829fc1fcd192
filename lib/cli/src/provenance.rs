//! The record beside an output: what made it of what.

use std::fs::{self, File};
use std::io::{self, BufReader, Read};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use xxhash_rust::xxh3::Xxh3Default;

use crate::Failure;

/// What no record comes near: a hundred thousand inputs take some 20 MB.
const LONGEST: u64 = 1 << 28;

/// What made an output: tool, version, command line and the hash of each input.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Record {
    /// Name of the tool.
    pub tool: String,
    /// Version of the tool.
    pub version: String,
    /// The command line as given.
    pub command: Vec<String>,
    /// The files read.
    pub inputs: Vec<InputRecord>,
}

/// One input file of a [`Record`].
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct InputRecord {
    /// Path as given on the command line.
    pub path: String,
    /// XXH3-64 of the content, hexadecimal.
    pub xxh3: String,
}

impl Record {
    /// The record of this process; `tool` and `version` from the tool's own
    /// `CARGO_PKG_NAME` and `CARGO_PKG_VERSION`.
    pub fn new(tool: &str, version: &str, inputs: Vec<InputRecord>) -> Self {
        let words = std::env::args_os().map(|word| word.to_string_lossy().into_owned());
        Self {
            tool: tool.into(),
            version: version.into(),
            command: words.collect(),
            inputs,
        }
    }

    /// The record as indented JSON with a final newline.
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).unwrap_or_default() + "\n"
    }
}

/// Ending of the name of a record, after that of its file.
pub(crate) const ENDING: &str = ".provenance.json";

/// Where the record of the file at `path` goes.
pub(crate) fn beside(path: &Path) -> PathBuf {
    let mut beside = path.to_owned().into_os_string();
    beside.push(ENDING);
    beside.into()
}

/// Refuses to replace what stands at `path` unless it is a record that may be written.
pub(crate) fn may_replace(path: &Path) -> Result<(), Failure> {
    let free = matches!(fs::metadata(path), Err(e) if e.kind() == io::ErrorKind::NotFound);
    if free || is_record(path) {
        let named = format_args!("'{}'", path.display());
        return machine::replaced_permissions(path)
            .map(|_| ())
            .map_err(|e| Failure::write(named, &e));
    }
    Err(Failure::usage(format!(
        "'{}' is not a provenance record and would be replaced by one: give another file name",
        path.display()
    )))
}

fn is_record(path: &Path) -> bool {
    // Opening a pipe would wait for its other end.
    let regular = fs::metadata(path).is_ok_and(|m| m.is_file() && m.len() <= LONGEST);
    let read = || serde_json::from_reader::<_, Record>(BufReader::new(File::open(path).ok()?)).ok();
    regular && read().is_some()
}

impl InputRecord {
    /// Hashes the file at `path`, which the user named so; one that cannot be read is exit 3.
    pub fn of_file(path: &Path, name: String) -> Result<Self, Failure> {
        let hash = File::open(path).and_then(hash_reader);
        let hash = hash.map_err(|e| Failure::data(format!("cannot read '{name}': {e}")))?;
        Ok(Self::new(name, hash))
    }

    /// A record from a hash computed while the input was read anyway.
    pub fn new(path: String, hash: u64) -> Self {
        Self {
            path,
            xxh3: format!("{hash:016x}"),
        }
    }
}

/// XXH3-64 of all that `reader` gives.
pub fn hash_reader(reader: impl Read) -> io::Result<u64> {
    let mut hasher = Xxh3Default::new();
    io::copy(&mut BufReader::with_capacity(1 << 20, reader), &mut hasher)?;
    Ok(hasher.digest())
}

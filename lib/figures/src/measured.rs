//! Whether a table is of the state that is there now.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use particle_file::ParticleFile;
use serde_json::Value;

use crate::{Error, view};

/// Of a record beside a table.
const MOST_BYTES: u64 = 1 << 20;

/// Refuses a table in which `named` was measured if the record beside the table has another content of it than `state`
/// has now: a run that was made again. Of tables without a record that is not known.
///
/// # Errors
/// [`Error::Data`] for a table of another content.
pub(crate) fn check(table: &Path, named: &str, state: &Path) -> Result<(), Error> {
    let Some(hash) = recorded(table, named).filter(|_| state.is_file()) else {
        return Ok(());
    };
    let now = ParticleFile::open(state)
        .map_err(view::data)?
        .content_hash();
    match hash == format!("{now:016x}") {
        true => Ok(()),
        false => Err(Error::Data(format!(
            "'{}' is not of '{}' as it is now: run wp-metrics again",
            table.display(),
            state.display()
        ))),
    }
}

/// The hash of the file `named` by the record of a table.
fn recorded(table: &Path, named: &str) -> Option<String> {
    let mut record = table.to_owned().into_os_string();
    record.push(".provenance.json");
    let mut text = Vec::new();
    let file = File::open(record).ok()?;
    file.take(MOST_BYTES).read_to_end(&mut text).ok()?;
    let record: Value = serde_json::from_slice(&text).ok()?;
    let inputs = record.get("inputs")?.as_array()?;
    let of = |key: &str, input: &Value| input.get(key)?.as_str().map(str::to_owned);
    let input = (inputs.iter()).find(|input| of("path", input).as_deref() == Some(named))?;
    of("xxh3", input)
}

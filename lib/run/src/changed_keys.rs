//! `--set`: changes keys of a case from the command line.

use std::path::Path;

use crate::case::{Case, case_text};
use crate::failure::RunFailure;

/// The case file at `path` with `changes` (`key=value`) applied, checked to be a valid case. Comments are dropped and keys
/// are sorted.
///
/// # Errors
/// [`RunFailure::Usage`]: the file cannot be read, or is no valid case before or after the changes.
pub fn changed_case(path: &Path, changes: &[String]) -> Result<String, RunFailure> {
    let text = with_changes(&case_text(path)?, path, changes)?;
    Case::parse(&text, path)?;
    let plain = toml::from_str::<toml::Table>(&text).ok();
    let plain = plain.and_then(|table| toml::to_string(&table).ok());
    Ok(plain.unwrap_or(text))
}

/// The value below `place` at a dotted path, such as `clamp.stage.0.speed`.
pub fn value_at<'a>(place: &'a toml::Value, path: &str) -> Option<&'a toml::Value> {
    path.split('.').try_fold(place, |place, name| {
        let index = || place.get(name.parse::<usize>().ok()?);
        place.get(name).or_else(index)
    })
}

/// The case text with `changes` applied; the text itself when there are none, so that errors
/// keep the user's own line numbers.
pub(crate) fn with_changes(
    original: &str,
    path: &Path,
    changes: &[String],
) -> Result<String, RunFailure> {
    if changes.is_empty() {
        return Ok(original.to_owned());
    }
    Case::parse(original, path)?;
    let mut root = toml::from_str::<toml::Table>(original)
        .map(toml::Value::Table)
        .map_err(|e| RunFailure::Usage(e.message().into()))?;
    for change in changes {
        let refuse = |why: &str| RunFailure::Usage(format!("--set {change}: {why}"));
        let (key, value) = change
            .split_once('=')
            .ok_or_else(|| refuse("KEY=VALUE is needed"))?;
        // A bare word is taken as a string: --set grid.shape=linear.
        let value = match toml::from_str::<toml::Table>(&format!("v = {value}")) {
            Ok(mut table) => table.remove("v").unwrap_or_else(|| value.into()),
            Err(_) => value.into(),
        };
        let mut path: Vec<&str> = key.split('.').map(str::trim).collect();
        let last = path
            .pop()
            .filter(|k| !k.is_empty())
            .ok_or_else(|| refuse("the key is empty"))?;
        let mut place = &mut root;
        for part in path {
            place = child_mut(place, part).map_err(|why| refuse(&why))?;
        }
        match (place, last.parse::<usize>()) {
            (toml::Value::Array(list), Ok(i)) if i < list.len() => list[i] = value,
            (toml::Value::Table(table), Err(_)) => {
                table.insert(last.to_owned(), value);
            }
            _ => return Err(refuse(&format!("there is no '{last}' to set"))),
        }
    }
    let text = toml::to_string(&root).map_err(|e| RunFailure::Usage(e.to_string()))?;
    // The user never saw this text, so the message names the changes instead of a line.
    match toml::from_str::<Case>(&text) {
        Ok(_) => Ok(text),
        Err(error) => Err(RunFailure::Usage(format!(
            "--set {}: {}",
            changes.join(" --set "),
            error.message().replace('\n', " ")
        ))),
    }
}

/// The value at `part` of `place`: a key of a table, which is created if absent, or an index of an array.
fn child_mut<'a>(place: &'a mut toml::Value, part: &str) -> Result<&'a mut toml::Value, String> {
    match place {
        // No key is a number: an index here means that the array is missing.
        toml::Value::Table(table) if part.parse::<usize>().is_err() => Ok(table
            .entry(part)
            .or_insert_with(|| toml::Table::new().into())),
        toml::Value::Array(list) => {
            let length = list.len();
            let index = part.parse::<usize>().ok();
            index.and_then(|i| list.get_mut(i)).ok_or_else(|| {
                format!("'{part}' is not an index of an array of {length} (counted from 0)")
            })
        }
        _ => Err(format!("the case has no entry '{part}' there to change")),
    }
}

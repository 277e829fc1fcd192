//! `resolved.toml`: the case as run, every key that was left out with the value that held instead.
//! As a case file it makes the same run again.

use std::fmt::Write;

use crate::case::Case;
use crate::case::keys::{Absent, Key, TABLES, Table};
use crate::courant::without_cfl;
use crate::resolve::Setup;

const OPENING: &str = "\
# The case of this run, with the defaults that held: as a case file it makes the same run again.
# What the keys are: mpm-run --reference
";

/// What stands behind a value that was not given.
const DEFAULT: &str = " # default";
/// Differing keys that are named.
const TOLD: usize = 3;

/// The text of the file, for a case of this `text`.
pub(crate) fn text(text: &str, case: &Case, setup: &Setup) -> String {
    let given = text.parse::<toml::Table>().unwrap_or_default();
    let given = toml::Value::Table(given);
    let mut out = String::from(OPENING);
    for table in TABLES {
        let none = toml::Value::Table(toml::Table::new());
        let places = match found(&given, table.path) {
            Some(toml::Value::Array(list)) => list.iter().collect(),
            Some(place) => vec![place],
            None if table.always => vec![&none],
            None => Vec::new(),
        };
        if places.is_empty() {
            out.push_str(&format!("\n# {}: not given\n", heading(table)));
        }
        for place in places {
            // Writing to a string cannot fail.
            let _ = write_table(&mut out, table, place, case, setup);
        }
    }
    out
}

/// The first keys by which the case of one such text differs from that of another, with both values: so that a run that is not
/// continued can say why. Defaults do not count, of which some follow from the bond, nor the key that may change; a list of tables
/// counts as one key. None where a text is no case.
pub(crate) fn differences(is: &str, was: &str) -> Vec<String> {
    let (Some(is), Some(was)) = (given(is), given(was)) else {
        return Vec::new();
    };
    let paths = TABLES.iter().flat_map(|table| match table.repeated {
        true => vec![table.path.to_owned()],
        false => (table.keys.iter())
            .map(|key| format!("{}.{}", table.path, key.name))
            .collect(),
    });
    let value = |of: Option<&toml::Value>| of.map_or("not given".to_owned(), ToString::to_string);
    paths
        .filter_map(|path| {
            let [is, was] = [found(&is, &path), found(&was, &path)];
            (is != was).then(|| format!("{path} is {}, was {}", value(is), value(was)))
        })
        .take(TOLD)
        .collect()
}

/// What is given in such a text and may not change.
fn given(text: &str) -> Option<toml::Value> {
    let lines = text.lines().filter(|line| !line.ends_with(DEFAULT));
    let text = without_cfl(&lines.collect::<Vec<_>>().join("\n"));
    text.parse().ok().map(toml::Value::Table)
}

fn heading(table: &Table) -> String {
    match table.repeated {
        true => format!("[[{}]]", table.path),
        false => format!("[{}]", table.path),
    }
}

/// The value below `place` at a dotted path.
fn found<'a>(place: &'a toml::Value, path: &str) -> Option<&'a toml::Value> {
    path.split('.')
        .try_fold(place, |place, name| place.get(name))
}

fn write_table(
    out: &mut String,
    table: &Table,
    place: &toml::Value,
    case: &Case,
    setup: &Setup,
) -> std::fmt::Result {
    writeln!(out, "\n{}", heading(table))?;
    for Key { name, absent, .. } in table.keys {
        if let Some(value) = found(place, name) {
            writeln!(out, "{name} = {value}")?;
            continue;
        }
        match absent {
            Absent::Value(value) => writeln!(out, "{name} = {value}{DEFAULT}")?,
            Absent::Of(_, value) => match value(case, setup) {
                Some(value) => writeln!(out, "{name} = {value}{DEFAULT}")?,
                None => writeln!(out, "# {name}: not used")?,
            },
            Absent::Needed(when) => writeln!(out, "# {name}: not given, needed {}", plain(when))?,
            Absent::Nothing(words) => writeln!(out, "# {name}: {}", plain(words))?,
        }
    }
    Ok(())
}

/// Words without their Markdown.
fn plain(words: &str) -> String {
    words.replace('`', "")
}

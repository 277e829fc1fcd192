//! `resolved.toml`: the case as run, every key that was left out with the value that held instead.
//! As a case file it makes the same run again.

use std::fmt::Write;

use crate::case::Case;
use crate::case::keys::{Absent, Key, TABLES, Table};
use crate::resolve::Setup;

const OPENING: &str = "\
# The case of this run, with the defaults that held: as a case file it makes the same run again.
# What the keys are: mpm-run --reference
";

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
            Absent::Value(value) => writeln!(out, "{name} = {value} # default")?,
            Absent::Of(_, value) => match value(case, setup) {
                Some(value) => writeln!(out, "{name} = {value} # default")?,
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

//! The case file: a user's TOML, before it is resolved to SI.
//!
//! Unknown keys, missing units and values out of range are refused with line and column.

mod adhesive;
mod reference;
mod schema;
mod value;

use std::io::Read;
use std::path::Path;

use particle_file::{limits, open};

pub(crate) use adhesive::{Adhesive, CureTable, WaterTable};
pub use reference::REFERENCE;
pub(crate) use reference::{ReferenceTable, tables};
pub(crate) use schema::{
    AirTable, BodyTable, BoxCorners, Case, ClampTable, ContactTable, MaterialName, SchemeName,
    StageTable,
};
pub(crate) use value::{BodyVelocity, EdgeLength, StopRule};

use crate::failure::RunFailure;

/// The text of a case file; `-` is standard input.
/// Errors: exit 2 if it cannot be read, is too long, or is no text.
pub(crate) fn case_text(path: &Path) -> Result<String, RunFailure> {
    let refused = |why: String| {
        RunFailure::Usage(format!(
            "cannot read the case file '{}': {why}",
            path.display()
        ))
    };
    let mut bytes = Vec::new();
    open(path)
        .and_then(|file| file.take(limits::CASE + 1).read_to_end(&mut bytes))
        .map_err(|e| refused(e.to_string()))?;
    if bytes.len() as u64 > limits::CASE {
        let why = format!("it is longer than the {} bytes accepted", limits::CASE);
        return Err(refused(why));
    }
    String::from_utf8(bytes).map_err(|_| refused("it is not TOML text".into()))
}

impl Case {
    /// Parses the text of a case file; `path` is for messages.
    /// Errors: no TOML, unknown or missing keys, values without unit or out of range.
    pub(crate) fn parse(text: &str, path: &Path) -> Result<Self, RunFailure> {
        toml::from_str(text).map_err(|error| {
            let place = error.span().map_or(String::new(), |span| {
                let before = &text[..span.start.min(text.len())];
                let line = before.matches('\n').count() + 1;
                let column = before.chars().rev().take_while(|&c| c != '\n').count() + 1;
                format!(":{line}:{column}")
            });
            let message = error.message().replace('\n', " ");
            RunFailure::Usage(format!("{}{place}: {message}", path.display()))
        })
    }
}

//! The case file: what a user writes, as TOML, before it is resolved to SI.
//!
//! Unknown keys, missing units and values out of range are refused with line and column.

mod adhesive;
mod page;
mod schema;
mod value;

use std::fs::File;
use std::io::Read;
use std::path::Path;

use particle_file::limits;

pub(crate) use adhesive::{Adhesive, CureTable, WaterTable};
pub use page::REFERENCE;
pub(crate) use page::{Table, tables};
pub(crate) use schema::{
    AirTable, Body, BoxCorners, Case, ClampTable, Contact, MaterialName, SchemeName, StageTable,
};
pub(crate) use value::{BodyVelocity, EdgeLength, StopRule};

use crate::failure::RunFailure;

/// The text of a case file.
/// Errors: exit 2 when it cannot be read, is longer than a case can be, or is no text.
pub(crate) fn case_text(path: &Path) -> Result<String, RunFailure> {
    let refused = |why: String| {
        RunFailure::Usage(format!(
            "cannot read the case file '{}': {why}",
            path.display()
        ))
    };
    let mut bytes = Vec::new();
    File::open(path)
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
    /// Errors: Not TOML, unknown or missing keys, values without unit or out of range.
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

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = r#"
[grid]
cell = "2.9 um"
[adhesive]
density = "1.2 g/cm3"
bulk_modulus = "1 GPa"
viscosity = "1300 cP"
[contact]
law = "partial-slip"
influence_length = "0.01 cell"
[clamp]
closing_speed = "1 m/s"
max_pressure = "2.5 MPa"
stop = "closed"
[integrator]
scheme = "explicit"
velocity_update = "xpic"
order = 5
"#;

    #[test]
    fn the_example_parses_and_refusals_have_line_column_and_what_is_accepted() {
        let case = Case::parse(GOOD, Path::new("case.toml")).unwrap();
        assert!((case.grid.cell.si(1.0) - 2.9e-6).abs() < 1e-18);
        assert_eq!(case.integrator.order, Some(5));
        for (from, to, place, words) in [
            ("\"1300 cP\"", "1300", "7:13: ", "'1300' has no unit"),
            ("\"1300 cP\"", "1.3", "7:13: ", "'1.3' has no unit"),
            ("\"2.9 um\"", "\"-2.9 um\"", "3:8: ", "greater than zero"),
            (
                "\"2.9 um\"",
                "2.9",
                "3:8: ",
                "2.9 is not accepted: a length",
            ),
            ("\"closed\"", "\"later\"", "14:8: ", "ms, us"),
            ("\"closed\"", "\"later\"", "14:8: ", "or \"closed\""),
            (
                "\"xpic\"",
                "\"xpicc\"",
                "17:19: ",
                "'xpicc' is not accepted: \"flip\", \"pic\", \"xpic\", \"fmpm\" or \"apic\" is needed",
            ),
        ] {
            assert!(GOOD.contains(from));
            let refused = Case::parse(&GOOD.replace(from, to), Path::new("case.toml"));
            let said = refused.unwrap_err().to_string();
            assert!(said.starts_with(&format!("case.toml:{place}")), "{said}");
            assert!(said.contains(words), "{said}");
        }
    }
}

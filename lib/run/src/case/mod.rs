//! The case file: what a user writes, as TOML, before it is resolved to SI.
//!
//! Unknown keys, missing units and values out of range are refused with line and column.

mod air;
mod cure;
pub(crate) mod keys;
mod press;
mod reference;
mod rheology;
mod schema;
mod value;
mod water;

use std::path::Path;

pub use air::AirTable;
pub use cure::CureTable;
pub use press::StageTable;
pub use reference::reference;
pub use schema::{
    Adhesive, Axes, Body, BoxCorners, Case, ClampTable, Contact, Grid, Integrator, MaterialName,
    OutputTable, PidGains, SchemeName,
};
pub use value::{BodyVelocity, CellEdge, CellLength, Positive, StopRule};
pub use water::WaterTable;

/// Why a case cannot be run; one sentence with file, line and column where known.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{0}")]
pub struct CaseError(pub String);

impl Case {
    /// Parses the text of a case file; `path` is for messages.
    ///
    /// # Errors
    /// Not TOML, unknown or missing keys, values without unit or out of range.
    pub fn parse(text: &str, path: &Path) -> Result<Self, CaseError> {
        toml::from_str(text).map_err(|error| {
            let place = error.span().map_or(String::new(), |span| {
                let before = &text[..span.start.min(text.len())];
                let line = before.matches('\n').count() + 1;
                let column = before.chars().rev().take_while(|&c| c != '\n').count() + 1;
                format!(":{line}:{column}")
            });
            let message = error.message().replace('\n', " ");
            CaseError(format!("{}{place}: {message}", path.display()))
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

    fn refusal(from: &str, to: &str) -> String {
        assert!(GOOD.contains(from));
        Case::parse(&GOOD.replace(from, to), Path::new("case.toml"))
            .unwrap_err()
            .0
    }

    #[test]
    fn the_example_parses() {
        let case = Case::parse(GOOD, Path::new("case.toml")).unwrap();
        assert!((case.grid.cell.si(None).unwrap() - 2.9e-6).abs() < 1e-18);
        assert_eq!(case.integrator.order, Some(5));
    }

    #[test]
    fn refusals_have_line_column_and_what_is_accepted() {
        let said = refusal("closing_speed", "closing_sped");
        assert!(
            said.starts_with("case.toml:12:1:") && said.contains("closing_speed"),
            "{said}"
        );
        let said = refusal("\"1300 cP\"", "\"1300\"");
        assert!(
            said.contains("case.toml:7:13") && said.contains("Pa s"),
            "{said}"
        );
        let said = refusal("\"1300 cP\"", "1300");
        assert!(said.contains("unit"), "{said}");
        let said = refusal("\"2.9 um\"", "\"-2.9 um\"");
        assert!(said.contains("greater than zero"), "{said}");
        let said = refusal("\"xpic\"", "\"xpicc\"");
        let wanted =
            "'xpicc' is not accepted: \"flip\", \"pic\", \"xpic\", \"fmpm\" or \"apic\" is needed";
        assert!(
            said.starts_with("case.toml:17:19: ") && said.ends_with(wanted),
            "{said}"
        );
        let said = refusal("stop = \"closed\"", "stop = \"later\"");
        assert!(said.contains("closed") && said.contains("ms"), "{said}");
    }
}

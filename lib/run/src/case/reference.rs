//! The reference of case files as text: docs/case-file.md, which a test holds to what is printed.

use std::fmt::Write;

use units::{
    Acceleration, Angle, Density, Dimension, Length, Pressure, ShearRate, Speed, SurfaceTension,
    Time, Viscosity,
};

use super::keys::{Absent, Key, TABLES, Table};

const OPENING: &str = "\
# Case files: every table and key

What `mpm-run CASE.toml` accepts, as `mpm-run --reference` prints it. A case file is TOML; a key that is not
listed here is refused with its line and column. `--set clamp.max_pressure=\"1 MPa\"` changes one for a run, `--explain` prints
what follows from all of them, and the run folder's `resolved.toml` holds each with the value that was used.
`pipelines/cases` has the paper's cases. Every number has bounds beyond which a run is refused or not called
sound: [verdicts](verdicts.md). What the schemes make of the keys: [methods](methods.md).

A quantity is a text of a number and a unit, `\"1300 cP\"`:
";

/// The reference as Markdown.
pub fn reference() -> String {
    let mut out = format!("{OPENING}\n| quantity | units |\n|---|---|\n");
    out.push_str(&unit_rows());
    out.push_str(
        "\nWhere \"cells\" are accepted, a multiple of `grid.cell` is meant: `\"0.01 cell\"`.\n",
    );
    for table in TABLES {
        // Writing to a string cannot fail.
        let _ = write_table(&mut out, table);
    }
    out
}

fn unit_rows() -> String {
    fn row<D: Dimension>() -> String {
        // Micro sign and Greek mu, which look alike, are both accepted and told once.
        let names = D::UNITS
            .iter()
            .filter(|(name, _)| !name.starts_with('\u{3bc}'));
        let names = names.map(|(name, _)| format!("`{name}`"));
        let names = names.collect::<Vec<_>>().join(", ");
        format!("| {} | {names} |\n", super::keys::quantity::<D>())
    }
    [
        row::<Length>,
        row::<Time>,
        row::<Speed>,
        row::<Acceleration>,
        row::<Pressure>,
        row::<Density>,
        row::<Viscosity>,
        row::<ShearRate>,
        row::<SurfaceTension>,
        row::<Angle>,
    ]
    .map(|row| row())
    .concat()
}

fn write_table(out: &mut String, table: &Table) -> std::fmt::Result {
    let (open, close) = match table.repeated {
        true => ("[[", "]]"),
        false => ("[", "]"),
    };
    writeln!(
        out,
        "\n## `{open}{}{close}`\n\n{}\n",
        table.path, table.about
    )?;
    writeln!(
        out,
        "| key | value | default | what it is, when to change it |"
    )?;
    writeln!(out, "|---|---|---|---|")?;
    for Key {
        name,
        form,
        absent,
        text,
    } in table.keys
    {
        let default = match absent {
            Absent::Needed("always") => "needed".to_owned(),
            Absent::Needed(when) => format!("needed {when}"),
            Absent::Value(value) => format!("`{value}`"),
            Absent::Of(words, _) | Absent::Nothing(words) => (*words).to_owned(),
        };
        writeln!(out, "| `{name}` | {} | {default} | {text} |", form())?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_document_is_what_is_printed() {
        let document = include_str!("../../../../docs/case-file.md");
        assert!(
            document == reference(),
            "renew it: mpm-run --reference > docs/case-file.md"
        );
    }
}

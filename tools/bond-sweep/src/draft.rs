//! A row of the table understood: its case, its bond and its changes.

use std::path::{Path, PathBuf};
use std::slice::from_ref;

use cli::Failure;
use particle_file::{Kind as FileKind, ParticleFile};
use run::{Request, RunFailure, changed_case};
use serde::{Deserialize, Serialize};

use crate::specimen::{self, Recipe};
use crate::table::{ColumnKind, Table};

/// What a run needs beside its case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Job {
    /// The bond file, seen from the folder of the sweep.
    pub bond: PathBuf,
    /// Hash of its content, where it is the user's own.
    pub content: Option<String>,
}

/// A column and what it changes, `key=value`.
type Change = (usize, String);

/// A row of which every cell is accepted for itself.
#[derive(Debug)]
pub struct Draft {
    /// The case file.
    pub case: PathBuf,
    /// What its run needs.
    pub job: Job,
    /// How its specimen is made, where it is a synthetic one.
    pub recipe: Option<Recipe>,
    changes: Vec<Change>,
    /// The case with its changes, plain: one that is given its own values is no other run.
    pub text: String,
}

impl Draft {
    /// Reads the row counted from 0; `case` is that of rows that name none. A refusal names row and column.
    pub fn of_row(table: &Table, row: usize, case: &Path) -> Result<Self, Failure> {
        let case = case_of(table, row, case);
        let (job, recipe) = bond_of(table, row)?;
        let changes: Vec<Change> = (table.given(row))
            .filter(|(_, kind, _)| **kind == ColumnKind::Key)
            .map(|(i, _, cell)| (i, format!("{}={cell}", table.columns[i].0)))
            .collect();
        let parsed = |changes: &[Change]| changed_case(&case, &texts(changes));
        match parsed(&changes) {
            Ok(text) => Ok(Self {
                text,
                case,
                job,
                recipe,
                changes,
            }),
            Err(refused) => Err(blamed(table, row, &changes, refused, parsed)),
        }
    }

    /// Resolves its run with its bond file, as `mpm-run` does before it starts. A refusal names the row and, where a
    /// single cell is at fault, its column.
    pub fn resolve(
        &self,
        table: &Table,
        row: usize,
        bond: &Path,
        however_long: bool,
    ) -> Result<(), Failure> {
        let resolved = |changes: &[Change]| {
            let request = Request::read(&self.case, Some(bond), &texts(changes))?;
            match request.excess()?.filter(|_| !however_long) {
                Some(excess) => Err(RunFailure::Usage(format!(
                    "{excess}; --yes-really plans it anyway"
                ))),
                None => Ok(()),
            }
        };
        resolved(&self.changes)
            .map_err(|refused| blamed(table, row, &self.changes, refused, resolved))
    }
}

fn texts(changes: &[Change]) -> Vec<String> {
    changes.iter().map(|(_, text)| text.clone()).collect()
}

/// The refusal of a row, at the cell that it is about.
fn blamed<T>(
    table: &Table,
    row: usize,
    changes: &[Change],
    refused: RunFailure,
    accepts: impl Fn(&[Change]) -> Result<T, RunFailure>,
) -> Failure {
    let RunFailure::Usage(refused) = refused else {
        return refused.into();
    };
    let Some(change) = blame(changes, |changes| accepts(changes).is_ok()) else {
        return table.wrong_row(row, refused);
    };
    // Alone it is refused in fewer words.
    let whole = match accepts(from_ref(change)) {
        Err(RunFailure::Usage(said)) => said,
        _ => refused,
    };
    let (column, text) = change;
    let said = whole.strip_prefix(&format!("--set {text}: "));
    table.wrong_cell(row, *column, said.unwrap_or(&whole))
}

/// The change that keeps a row from being accepted: the one that is refused alone, or without which the rest is
/// accepted. None where it is no single one, or the case itself.
fn blame(changes: &[Change], accepts: impl Fn(&[Change]) -> bool) -> Option<&Change> {
    let alone = || {
        let refused = |change: &&Change| !accepts(from_ref(*change));
        accepts(&[]).then(|| changes.iter().find(refused)).flatten()
    };
    let needless = |change: &&Change| {
        let rest = changes.iter().filter(|other| other != change);
        accepts(&rest.cloned().collect::<Vec<_>>())
    };
    alone().or_else(|| changes.iter().find(needless))
}

/// The case file of a row: a name without an ending stands beside that of the other rows.
fn case_of(table: &Table, row: usize, default: &Path) -> PathBuf {
    match table.cell(row, &ColumnKind::Case) {
        None => default.to_owned(),
        Some((_, name)) if name.ends_with(".toml") => table.beside(name),
        Some((_, name)) => default.with_file_name(format!("{name}.toml")),
    }
}

/// The bond of a row, and the recipe of a synthetic one.
fn bond_of(table: &Table, row: usize) -> Result<(Job, Option<Recipe>), Failure> {
    let specimen: Vec<(usize, &'static str, &str)> = (table.given(row))
        .filter_map(|(i, kind, cell)| match kind {
            ColumnKind::Specimen(option) => Some((i, *option, cell)),
            _ => None,
        })
        .collect();
    if let Some((column, cell)) = table.cell(row, &ColumnKind::Particles) {
        if let Some((i, ..)) = specimen.first() {
            let what = "the row has a bond file in column particles as well as a synthetic specimen; leave one of them empty";
            return Err(table.wrong_cell(row, *i, what));
        }
        let path = table.beside(cell);
        let wrong = |what: String| table.wrong_cell(row, column, what);
        let file = ParticleFile::open(&path).map_err(|e| wrong(e.to_string()))?;
        if file.header().kind != FileKind::Bond {
            return Err(wrong(format!(
                "'{}' holds a {}; a bond file as build-bondline writes is needed",
                path.display(),
                file.header().kind
            )));
        }
        let job = Job {
            content: Some(specimen::content(&path)?),
            bond: std::fs::canonicalize(&path).map_err(|e| wrong(e.to_string()))?,
        };
        return Ok((job, None));
    }
    let mut changes = Vec::new();
    for (column, option, cell) in specimen {
        specimen::check(option, cell).map_err(|why| table.wrong_cell(row, column, why))?;
        changes.push((option, cell));
    }
    let recipe = Recipe::quick_but(&changes);
    let job = Job {
        bond: recipe.bond(),
        content: None,
    };
    Ok((job, Some(recipe)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_change_refused_alone_or_in_company_is_found() {
        let changes: Vec<_> = [(3, "a"), (5, "b"), (7, "c")]
            .map(|(i, what)| (i, what.to_owned()))
            .to_vec();
        let has = |given: &[Change], what: &str| given.iter().any(|c| c.1 == what);
        let found = |accepts: &dyn Fn(&[Change]) -> bool| blame(&changes, accepts).map(|c| c.0);
        assert_eq!(found(&|given| !has(given, "b")), Some(5));
        // Each is accepted alone, two of them together are not.
        assert_eq!(
            found(&|given| !(has(given, "a") && has(given, "c"))),
            Some(3)
        );
        // A case that needs a change is not refused for it.
        assert_eq!(found(&|given| has(given, "a") && !has(given, "c")), Some(7));
        assert_eq!(found(&|_| false), None);
    }
}

//! The plan of a sweep: from a table, checked cell by cell, to a folder that holds all that its
//! runs need.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use cli::{Failure, Output};
use serde::{Deserialize, Serialize};
use xxhash_rust::xxh3::xxh3_64;

use crate::draft::{Draft, Job};
use crate::inputs;
use crate::specimen::Recipe;
use crate::table::Table;

/// The version whose runs a plan is of: others would give other numbers under the same names.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

pub const PLAN: &str = "plan.json";
/// The runs, one a line: what engines start.
const RUNS: &str = "runs.txt";

/// What a folder of a sweep says of it.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    version: String,
    /// Whether runs of any length are started.
    pub however_long: bool,
    /// Columns of the inputs, with their units.
    pub inputs: Vec<String>,
    /// The rows of the table.
    pub rows: Vec<Row>,
    /// The runs by their names; rows that say the same share one.
    pub runs: BTreeMap<String, Job>,
}

/// A row of the table.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Row {
    /// The run that it asks for.
    pub run: String,
    /// Its cells below [`Plan::inputs`].
    pub inputs: Vec<String>,
}

impl Plan {
    /// The plan in `folder`: exit 2 without one, or with one of another version; exit 3 with one that is damaged.
    pub fn read(folder: &Path) -> Result<Self, Failure> {
        let place = folder.join(PLAN);
        let text = fs::read_to_string(&place).map_err(|e| {
            Failure::usage(format!(
                "cannot read '{}': {e}; bond-sweep plan makes it",
                place.display()
            ))
        })?;
        let plan: Self = serde_json::from_str(&text).map_err(|e| {
            Failure::data(format!("'{}' is not a sweep plan: {e}", place.display()))
        })?;
        match plan.version == VERSION {
            true => Ok(plan),
            false => Err(Failure::usage(format!(
                "'{}' is of version {} and this is {VERSION}: plan again",
                place.display(),
                plan.version
            ))),
        }
    }

    /// The run of this name.
    pub fn job(&self, run: &str) -> Result<&Job, Failure> {
        self.runs.get(run).ok_or_else(|| {
            Failure::usage(format!(
                "there is no run '{run}' in this sweep: {RUNS} lists its runs"
            ))
        })
    }

    /// Writes what is not there yet; the plan first, which says whose the folder is.
    fn write(&self, folder: &Path, cases: &BTreeMap<String, &str>) -> Result<(), Failure> {
        make_folder(folder)?;
        let text = serde_json::to_string_pretty(self).unwrap_or_default() + "\n";
        keep(&folder.join(PLAN), &text)?;
        for (run, case) in cases {
            make_folder(&run_folder(folder, run))?;
            keep(&case_of(folder, run), case)?;
        }
        let names: String = self.runs.keys().map(|run| format!("{run}\n")).collect();
        keep(&folder.join(RUNS), &names)
    }
}

/// The folder of a run, which is the run folder of `mpm-run` too.
pub fn run_folder(folder: &Path, run: &str) -> PathBuf {
    folder.join("runs").join(run)
}

/// The case of a run, with the changes of its row.
pub fn case_of(folder: &Path, run: &str) -> PathBuf {
    run_folder(folder, run).join("case.toml")
}

/// Plans the sweep of `table` in `folder`; runs of an earlier plan there stay and are used again. Refused are cells, with
/// row and column, and a folder that is not a sweep's (exit 2).
pub fn make(path: &Path, case: &Path, folder: &Path, however_long: bool) -> Result<(), Failure> {
    let table = Table::read(path)?;
    let drafts = (0..table.rows.len())
        .map(|row| Draft::of_row(&table, row, case))
        .collect::<Result<Vec<_>, _>>()?;
    let written = [PLAN, RUNS].map(|name| Output::File(folder.join(name)));
    let read = drafts.iter().map(|draft| draft.case.as_path());
    // Nothing is read from a folder that is not there yet.
    if folder.is_dir() {
        cli::keep_apart(read.chain([path]), &written)?;
    }
    refuse_foreign(folder)?;
    let made = make_specimens(&table, &drafts, folder)?;
    let (inputs, cells) = inputs::columns(&table, &drafts);
    let mut plan = Plan {
        version: VERSION.into(),
        however_long,
        inputs,
        rows: Vec::new(),
        runs: BTreeMap::new(),
    };
    let mut cases = BTreeMap::new();
    for (row, (draft, inputs)) in drafts.iter().zip(cells).enumerate() {
        let run = name(draft);
        if !plan.runs.contains_key(&run) {
            draft.resolve(&table, row, &folder.join(&draft.job.bond), however_long)?;
            cases.insert(run.clone(), draft.text.as_str());
            plan.runs.insert(run.clone(), draft.job.clone());
        }
        plan.rows.push(Row { run, inputs });
    }
    plan.write(folder, &cases)?;
    cli::note(format_args!(
        "{}: {} rows, {} runs in {}, {made} synthetic specimens",
        folder.display(),
        plan.rows.len(),
        plan.runs.len(),
        folder.join(RUNS).display()
    ));
    Ok(())
}

/// What tells a run from all others: version, case as run, bond.
fn name(draft: &Draft) -> String {
    let recipe = draft.recipe.as_ref().map(Recipe::identity);
    let bond = recipe.or(draft.job.content.clone()).unwrap_or_default();
    let identity = format!("{VERSION}\n{bond}\n{}", draft.text);
    format!("{:016x}", xxh3_64(identity.as_bytes()))
}

/// Makes the specimens that are not there yet; how many the sweep has.
fn make_specimens(table: &Table, drafts: &[Draft], folder: &Path) -> Result<usize, Failure> {
    let mut made = BTreeSet::new();
    for (row, draft) in drafts.iter().enumerate() {
        if let Some(recipe) = draft.recipe.as_ref().filter(|recipe| made.insert(*recipe)) {
            cli::detail(format_args!("specimen of row {}", row + 1));
            let made = recipe.make(folder);
            made.map_err(|why| table.wrong_row(row, format_args!("its specimen: {why}")))?;
        }
    }
    Ok(made.len())
}

/// Refuses a folder in which other files stand at a sweep's names.
fn refuse_foreign(folder: &Path) -> Result<(), Failure> {
    let is_there = |name: &str| fs::symlink_metadata(folder.join(name)).is_ok();
    let own = || serde_json::from_str::<Plan>(&fs::read_to_string(folder.join(PLAN)).ok()?).ok();
    let foreign = match is_there(PLAN) {
        true => own().is_none().then_some(PLAN),
        false => is_there(RUNS).then_some(RUNS),
    };
    match foreign {
        None => Ok(()),
        Some(name) => Err(Failure::usage(format!(
            "'{}' does not belong to a sweep and would be replaced: name another folder",
            folder.join(name).display()
        ))),
    }
}

fn make_folder(place: &Path) -> Result<(), Failure> {
    fs::create_dir_all(place).map_err(|e| Failure::write(format!("'{}'", place.display()), &e))
}

/// Writes `text` where it does not stand already, so that what was made of it stays newer.
fn keep(place: &Path, text: &str) -> Result<(), Failure> {
    if fs::read_to_string(place).is_ok_and(|found| found == text) {
        return Ok(());
    }
    Output::File(place.to_owned()).write(|out| out.write_all(text.as_bytes()))
}

//! The plan of a sweep: from a table, checked cell by cell, to a folder that holds all that its
//! runs need.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Component, Path, PathBuf};

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
    /// The table that it was made of, seen from the folder; none of standard input.
    #[serde(default)]
    table: Option<PathBuf>,
    /// The case files, seen from the folder.
    #[serde(default)]
    cases: BTreeSet<PathBuf>,
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

    /// The files that it was made of, and its own.
    pub fn sources(&self, folder: &Path) -> Vec<PathBuf> {
        let bonds = self.runs.values().map(|job| &job.bond);
        let files = self.table.iter().chain(&self.cases).chain(bonds);
        let all = files.map(|file| folder.join(file));
        all.chain([folder.join(PLAN)]).collect()
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
        let text = serde_json::to_string_pretty(self);
        let text = text.map_err(|e| Failure::usage(format!("a bond file cannot be named: {e}")))?;
        keep(&folder.join(PLAN), &(text + "\n"))?;
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
/// row and column, and a folder that is not a sweep's, or that of another table (exit 2).
pub fn make(path: &Path, case: &Path, folder: &Path, however_long: bool) -> Result<(), Failure> {
    let table = Table::read(path)?;
    let drafts = (0..table.rows.len())
        .map(|row| Draft::of_row(&table, row, case))
        .collect::<Result<Vec<_>, _>>()?;
    let read = drafts.iter().map(|draft| draft.case.as_path());
    (read.chain([path])).try_for_each(|read| refuse_own(folder, read))?;
    refuse_foreign(folder, path)?;
    let made = make_specimens(&table, &drafts, folder)?;
    let (inputs, cells) = inputs::columns(&table, &drafts);
    let mut plan = Plan {
        version: VERSION.into(),
        table: None,
        cases: BTreeSet::new(),
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
    make_folder(folder)?;
    plan.table = seen_from(folder, path);
    let read = drafts.iter().map(|draft| draft.case.as_path());
    plan.cases = read.filter_map(|case| seen_from(folder, case)).collect();
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
            made.map_err(|(status, why)| {
                table.failed_row(row, status, format_args!("its specimen: {why}"))
            })?;
        }
    }
    Ok(made.len())
}

/// Refuses a table or a case that is a file of the sweep itself.
fn refuse_own(folder: &Path, read: &Path) -> Result<(), Failure> {
    let is_inside = || {
        let inside = fs::canonicalize(read).ok()?;
        let inside = inside.strip_prefix(fs::canonicalize(folder).ok()?).ok()?;
        let of_run = inside.starts_with("runs") && inside.ends_with("case.toml");
        Some(of_run || [PLAN, RUNS].iter().any(|name| inside == Path::new(name)))
    };
    match is_inside() {
        None | Some(false) => Ok(()),
        Some(true) => Err(Failure::usage(format!(
            "'{}' is an input and would be replaced by a file of the sweep: name another folder",
            read.display()
        ))),
    }
}

/// Refuses a folder in which other files stand at a sweep's names, or that holds the sweep of a table other than `path`.
fn refuse_foreign(folder: &Path, path: &Path) -> Result<(), Failure> {
    let is_there = |name: &str| fs::symlink_metadata(folder.join(name)).is_ok();
    let own = || serde_json::from_str::<Plan>(&fs::read_to_string(folder.join(PLAN)).ok()?).ok();
    let own = own();
    let foreign = match is_there(PLAN) {
        true => own.is_none().then_some(PLAN),
        false => is_there(RUNS).then_some(RUNS),
    };
    if let Some(name) = foreign {
        return Err(Failure::usage(format!(
            "'{}' does not belong to a sweep and would be replaced: name another folder",
            folder.join(name).display()
        )));
    }
    let other = own.and_then(|plan| fs::canonicalize(folder.join(plan.table?)).ok());
    let ours = fs::canonicalize(path).ok().filter(|ours| ours.is_file());
    match other.zip(ours) {
        Some((other, ours)) if other != ours => Err(Failure::usage(format!(
            "'{}' holds the sweep of '{}': name another folder, or give '{}' another name",
            folder.display(),
            other.display(),
            path.display()
        ))),
        _ => Ok(()),
    }
}

/// A file as seen from a folder, both of which are there; none where its name is no text, or it is no regular file.
fn seen_from(folder: &Path, file: &Path) -> Option<PathBuf> {
    let [folder, file] = [folder, file].map(|path| fs::canonicalize(path).ok());
    let (folder, file) = (folder?, file.filter(|file| file.is_file())?);
    let shared = (folder.iter().zip(&file)).take_while(|(a, b)| a == b);
    let shared = shared.count();
    let up = (folder.iter().skip(shared)).map(|_| Component::ParentDir.as_os_str());
    let seen: PathBuf = up.chain(file.iter().skip(shared)).collect();
    seen.to_str().is_some().then_some(seen)
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

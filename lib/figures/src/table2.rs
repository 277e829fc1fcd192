//! Table 2 of the paper.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use crate::known::{SIDES, pressure_limit};
use crate::run_end::case_beside;
use crate::table::Table;
use crate::{Error, Known, RunEnd};

/// One state for [`Table2`]: the CSV that `wp-metrics` wrote for it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Case {
    /// Adhesive, e.g. `pf`.
    pub adhesive: String,
    /// What the state is: [`Case::EXPERIMENT`] or the name of a run.
    pub name: String,
    /// The CSV.
    pub path: PathBuf,
}

impl Case {
    /// Name of what is no run.
    pub const EXPERIMENT: &str = "experiment";
}

/// Weighted penetration of the experiment and the runs, as Table 2 of the paper, with its error, the slab that has
/// not penetrated and what is to be said against a run.
#[derive(Clone, Debug)]
pub struct Table2 {
    pub(crate) rows: Vec<Row>,
    /// Whether the paper's numbers, which are another specimen's, stand below ours.
    pub(crate) paper: bool,
}

/// One line of [`Table2`]; all penetrations in um.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Row {
    pub(crate) adhesive: String,
    pub(crate) case: String,
    /// Reference plane as `wp-metrics` states it.
    reference: String,
    /// What was measured, as [`Known::read`] has it.
    pub(crate) known: [Known; 6],
    /// Weighted penetration t / sqrt(12) of the unpenetrated slab of the same volume.
    pub(crate) slab: f64,
    pub(crate) paper: Option<&'static Paper>,
    /// How the run ended.
    pub(crate) end: Option<RunEnd>,
    /// Pressure limit of its press, MPa; NaN where that is not known.
    pub(crate) limit: f64,
}

/// A line of the paper's Table 2: its adhesive; its case, and names that a case of ours goes by when it is
/// the same, in lower case; WP of bottom, top and in total, um.
#[derive(Debug, PartialEq)]
pub(crate) struct Paper(&'static str, [&'static str; 3], [f64; 3]);

/// What `wp-metrics` measures from.
const REFERENCES: [&str; 4] = ["mid", "adherend", "plane", "fit"];

const EXPERIMENT: [&str; 3] = ["Experimental", "experiment", "experimental"];
const XPIC: [&str; 3] = ["XPIC(5)", "xpic", "xpic(5)"];
const FLIP: [&str; 3] = ["FLIP", "flip", "flip partial-slip"];
const FRICTIONLESS: [&str; 3] = ["Frictionless", "frictionless", "flip frictionless"];

/// Table 2 of Hammerquist and Nairn.
static PAPER: [Paper; 8] = [
    Paper("PVA-PF", EXPERIMENT, [24.69, 25.96, 25.3]),
    Paper("PVA-PF", XPIC, [25.21, 23.32, 24.35]),
    Paper("PVA-PF", FLIP, [25.18, 23.3, 24.32]),
    Paper("PVA-PF", FRICTIONLESS, [25.24, 23.3, 24.35]),
    Paper("PF", EXPERIMENT, [68.57, 31.62, 56.41]),
    Paper("PF", XPIC, [27.98, 27.3, 27.7]),
    Paper("PF", FLIP, [27.97, 27.42, 27.74]),
    Paper("PF", FRICTIONLESS, [26.57, 26.6, 26.58]),
];

/// Of the table as CSV.
const COLUMNS: &str = "adhesive,case,reference,bottom_wp_um,top_wp_um,total_wp_um,slab_wp_um,\
    paper_case,paper_bottom_wp_um,paper_top_wp_um,paper_total_wp_um,note,\
    bottom_wp_extrapolated_um,top_wp_extrapolated_um,total_wp_extrapolated_um,\
    bottom_wp_error_um,top_wp_error_um,total_wp_error_um,end,sound,gap_um,mark,\
    total_wp_before_release_um";
const NOTE: &str = "paper: the paper's own specimen, not this one";
/// The state that a run ends with.
const FINAL: &str = "final.mpts";
/// What the numbers are, in the table for reading.
pub const ERRORS: &str = "with \u{b1}: extrapolated to zero cell size (first order); the error is the difference between two cell \
    sizes, but for a side at least the mean of both sides and for the total at least sqrt(bottom^2 + top^2)/2";

impl Table2 {
    /// Reads the cases, sorted by adhesive in the order of first mention. A case named as in
    /// the paper gets the paper's numbers beside it.
    ///
    /// # Errors
    /// [`Error::Data`] for an unreadable file, a missing column or side, several states in
    /// one file, or a state of a run that was made again since.
    pub fn read(cases: &[Case]) -> Result<Self, Error> {
        let mut sorted: Vec<&Case> = cases.iter().collect();
        sorted.sort_by_key(|case| cases.iter().position(|c| c.adhesive == case.adhesive));
        let rows = sorted.into_iter().map(Row::read);
        Ok(Self {
            rows: rows.collect::<Result<_, _>>()?,
            paper: false,
        })
    }

    /// The same with the paper's numbers below ours.
    pub fn with_paper(self, paper: bool) -> Self {
        Self { paper, ..self }
    }

    /// The table as CSV.
    ///
    /// # Errors
    /// The failed write.
    pub fn write_csv(&self, out: impl Write) -> io::Result<()> {
        let mut writer = csv::Writer::from_writer(out);
        writer.write_record(COLUMNS.split(','))?;
        for row in &self.rows {
            let wp = || row.known[..3].iter();
            let (paper, end) = (row.paper, row.end.as_ref());
            let paper_wp = paper.map_or([f64::NAN; 3], |paper| paper.2);
            let names = [&row.adhesive, &row.case, &row.reference];
            let mut record: Vec<String> = names.into_iter().cloned().collect();
            record.extend(wp().map(|known| number(known.as_run)));
            record.push(number(row.slab));
            record.push(paper.map_or("", |paper| paper.1[0]).into());
            record.extend(paper_wp.map(number));
            record.push(paper.map_or("", |_| NOTE).into());
            record.extend(wp().map(|known| number(known.extrapolated)));
            record.extend(wp().map(|known| number(known.error)));
            record.push(end.map_or(String::new(), |e| e.end.clone()));
            record.push(end.map_or(String::new(), |e| e.sound.to_string()));
            record.push(end.map_or(String::new(), |e| number(1e6 * e.gap_m)));
            record.push(row.mark());
            let held = end.and_then(|e| e.held_wp_um);
            record.push(held.map_or(String::new(), number));
            writer.write_record(record)?;
        }
        writer.flush()
    }

    /// The table for reading, with a heading, and what is to be said against runs.
    pub fn to_text(&self) -> String {
        let wide = self.widest();
        let heads = SIDES.map(|side| format!("{side:>15}")).concat();
        let mut text = format!(
            "Weighted penetration (um)\n{:<9} {:<wide$}{heads}{:>8}\n",
            "adhesive", "case", "slab"
        );
        for row in &self.rows {
            let numbers = |known: &Known| format!("{:>15}", known.told(2).join(" +- "));
            let numbers: String = row.known[..3].iter().map(numbers).collect();
            let (adhesive, case, slab, mark) = (&row.adhesive, &row.case, row.slab, row.mark());
            text += &format!("{adhesive:<9} {case:<wide$}{numbers}{slab:>8.2}  {mark}");
            text.truncate(text.trim_end().len());
            text.push('\n');
            if let Some(paper) = self.paper_of(row) {
                let numbers = paper.map(|wp| format!("{wp:>15.2}")).concat();
                text += &format!("{:<9} {:<wide$}{numbers}\n", "", "  paper");
            }
        }
        text += "slab: the unpenetrated slab of the same volume, t/sqrt(12)\n";
        if self.has_errors() {
            text += &format!("{}\n", ERRORS.replace('\u{b1}', "+-"));
        }
        if self.paper {
            text += "paper: Hammerquist and Nairn, Table 2; another specimen\n";
        }
        for row in &self.rows {
            let ends = row.end.iter();
            for told in ends.flat_map(|end| end.advice().into_iter().chain(end.released())) {
                text += &format!("{} {}: {told}\n", row.adhesive, row.case);
            }
        }
        text
    }

    /// Characters of the column of cases.
    pub(crate) fn widest(&self) -> usize {
        let longest = self.rows.iter().map(|row| row.case.chars().count());
        longest.max().unwrap_or(0).max(16) + 1
    }

    /// Whether a row has an error.
    pub(crate) fn has_errors(&self) -> bool {
        self.rows.iter().any(Row::has_error)
    }

    /// The paper's numbers of a row, where they are to be shown.
    pub(crate) fn paper_of(&self, row: &Row) -> Option<[f64; 3]> {
        row.paper.filter(|_| self.paper).map(|paper| paper.2)
    }
}

impl Row {
    fn read(source: &Case) -> Result<Self, Error> {
        let table = Table::read(&source.path)?;
        let files = table.texts("file")?;
        if files.iter().any(|file| *file != files[0]) {
            return Err(Error::Data(format!(
                "'{}' holds several states: the CSV of one final state is needed",
                table.name()
            )));
        }
        let (sides, references) = (table.texts("side")?, table.texts("reference")?);
        let slabs = table.numbers("slab_wp_um")?;
        let mut total = 0;
        for side in SIDES {
            let row = sides.iter().position(|s| *s == side);
            let missing = || Error::Data(format!("'{}' has no row with side {side}", table.name()));
            total = row.ok_or_else(missing)?;
        }
        table.numbers_but("wp_um", |row| row != total)?;
        // It goes into our own table, which people open in a spreadsheet.
        if !REFERENCES.contains(&references[total]) {
            return Err(Error::Data(format!(
                "'{}' has the reference '{}', which is none of {}",
                table.name(),
                references[total],
                REFERENCES.join(", ")
            )));
        }
        let name = source.name.to_lowercase();
        let same = |Paper(adhesive, [_, names @ ..], _): &&Paper| {
            adhesive.eq_ignore_ascii_case(&source.adhesive) && names.contains(&name.as_str())
        };
        let (end, limit) = end(&source.path, files[0])?.unzip();
        Ok(Self {
            adhesive: source.adhesive.clone(),
            case: source.name.clone(),
            reference: references[total].into(),
            known: Known::read(&table)?,
            slab: slabs[total],
            paper: PAPER.iter().find(same),
            end,
            limit: limit.unwrap_or(f64::NAN),
        })
    }

    pub(crate) fn has_error(&self) -> bool {
        self.known[2].has_error()
    }

    /// What is to be said against its run, in a few words.
    pub(crate) fn mark(&self) -> String {
        let mark = self.end.as_ref().and_then(RunEnd::mark);
        mark.unwrap_or_default()
    }
}

/// How the run ended whose last state is `named`, measured in `table`, and its pressure limit: either lies in its folder.
fn end(table: &Path, named: &str) -> Result<Option<(RunEnd, f64)>, Error> {
    let state = Path::new(named);
    if state.file_name() != Some(FINAL.as_ref()) {
        return Ok(None);
    }
    for place in [table, state] {
        if let Some(end) = RunEnd::beside(place)? {
            return Ok(Some((end, pressure_limit(&case_beside(place)))));
        }
    }
    Ok(None)
}

/// A cell of a number.
pub(crate) fn number(value: f64) -> String {
    match value.is_finite() {
        true => format!("{value:.4}"),
        false => String::new(),
    }
}

//! Table 2 of the paper.

use std::io::{self, Write};

use std::path::PathBuf;

use crate::Error;
use crate::table::Table;

/// One state for [`Table2`]: the CSV that `wp-metrics` wrote for it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Case {
    /// Adhesive, e.g. `pf`.
    pub adhesive: String,
    /// What the state is: `experiment` or the name of a run.
    pub name: String,
    /// The CSV.
    pub path: PathBuf,
}

/// Weighted penetration of the experiment and the runs, as Table 2 of the paper, with the
/// slab that has not penetrated and the paper's own numbers, which are another specimen's.
#[derive(Clone, Debug)]
pub struct Table2 {
    pub(crate) rows: Vec<Row>,
}

/// One line of [`Table2`]; all penetrations in um.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Row {
    pub(crate) adhesive: String,
    pub(crate) case: String,
    /// Reference plane as `wp-metrics` states it.
    reference: String,
    /// Bottom, top, total.
    pub(crate) wp: [f64; 3],
    /// Weighted penetration t / sqrt(12) of the unpenetrated slab of the same volume.
    pub(crate) slab: f64,
    pub(crate) paper: Option<&'static Paper>,
}

/// A line of the paper's Table 2, um.
#[derive(Debug, PartialEq)]
pub(crate) struct Paper {
    adhesive: &'static str,
    case: &'static str,
    /// Names that a case of ours goes by when it is the same, in lower case.
    aliases: [&'static str; 2],
    /// Bottom, top, total.
    wp: [f64; 3],
}

/// What `wp-metrics` measures from.
const REFERENCES: [&str; 4] = ["mid", "adherend", "plane", "fit"];
pub(crate) const SIDES: [&str; 3] = ["bottom", "top", "total"];

const fn paper(
    adhesive: &'static str,
    case: &'static str,
    aliases: [&'static str; 2],
    wp: [f64; 3],
) -> Paper {
    Paper {
        adhesive,
        case,
        aliases,
        wp,
    }
}

const EXPERIMENT: [&str; 2] = ["experiment", "experimental"];
const XPIC: [&str; 2] = ["xpic", "xpic(5)"];
const FLIP: [&str; 2] = ["flip", "flip partial-slip"];
const FRICTIONLESS: [&str; 2] = ["frictionless", "flip frictionless"];

/// Table 2 of Hammerquist and Nairn.
static PAPER: [Paper; 8] = [
    paper("PVA-PF", "Experimental", EXPERIMENT, [24.69, 25.96, 25.3]),
    paper("PVA-PF", "XPIC(5)", XPIC, [25.21, 23.32, 24.35]),
    paper("PVA-PF", "FLIP", FLIP, [25.18, 23.3, 24.32]),
    paper("PVA-PF", "Frictionless", FRICTIONLESS, [25.24, 23.3, 24.35]),
    paper("PF", "Experimental", EXPERIMENT, [68.57, 31.62, 56.41]),
    paper("PF", "XPIC(5)", XPIC, [27.98, 27.3, 27.7]),
    paper("PF", "FLIP", FLIP, [27.97, 27.42, 27.74]),
    paper("PF", "Frictionless", FRICTIONLESS, [26.57, 26.6, 26.58]),
];

const NOTE: &str = "paper: the paper's specimen, not this one";

impl Table2 {
    /// Reads the cases, sorted by adhesive in the order of first mention. A case named as in
    /// the paper gets the paper's numbers beside it.
    ///
    /// # Errors
    /// [`Error::Data`] for an unreadable file, a missing column or side, or several states in
    /// one file.
    pub fn read(cases: &[Case]) -> Result<Self, Error> {
        let mut sorted: Vec<&Case> = cases.iter().collect();
        sorted.sort_by_key(|case| cases.iter().position(|c| c.adhesive == case.adhesive));
        let rows = sorted
            .into_iter()
            .map(Row::read)
            .collect::<Result<_, _>>()?;
        Ok(Self { rows })
    }

    /// The table as CSV.
    ///
    /// # Errors
    /// The failed write.
    pub fn write_csv(&self, out: impl Write) -> io::Result<()> {
        let mut writer = csv::Writer::from_writer(out);
        writer.write_record([
            "adhesive",
            "case",
            "reference",
            "bottom_wp_um",
            "top_wp_um",
            "total_wp_um",
            "slab_wp_um",
            "paper_case",
            "paper_bottom_wp_um",
            "paper_top_wp_um",
            "paper_total_wp_um",
            "note",
        ])?;
        for row in &self.rows {
            let number = |wp: f64| {
                if wp.is_finite() {
                    format!("{wp:.4}")
                } else {
                    String::new()
                }
            };
            let mut record = vec![
                row.adhesive.clone(),
                row.case.clone(),
                row.reference.clone(),
            ];
            record.extend(row.wp.map(number));
            record.push(number(row.slab));
            record.push(row.paper.map_or("", |paper| paper.case).into());
            record.extend(row.paper_wp().map(number));
            record.push(row.paper.map_or("", |_| NOTE).into());
            writer.write_record(record)?;
        }
        writer.flush()
    }

    /// The table for reading, with a heading.
    pub fn to_text(&self) -> String {
        let longest = self.rows.iter().map(|row| row.case.chars().count());
        let wide = longest.max().unwrap_or(0).max(16) + 1;
        let mut text = format!(
            "{:<w$}this specimen                   paper (another specimen)\n\
             adhesive  {:<wide$}  bottom     top   total    slab   bottom     top   total\n",
            "Weighted penetration (um)",
            "case",
            w = wide + 16
        );
        for row in &self.rows {
            let number = |wp: f64| {
                if wp.is_finite() {
                    format!("{wp:8.2}")
                } else {
                    format!("{:>8}", "-")
                }
            };
            let ours: String = row.wp.into_iter().chain([row.slab]).map(number).collect();
            let paper: String = row.paper_wp().map(number).concat();
            text += &format!("{:<9} {:<wide$}{ours} {paper}\n", row.adhesive, row.case);
        }
        text + "slab: the unpenetrated slab of the same volume, t/sqrt(12)\n"
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
        let (wps, slabs) = (table.numbers("wp_um")?, table.numbers("slab_wp_um")?);
        let row_of = |side: &str| {
            sides.iter().position(|s| *s == side).ok_or_else(|| {
                Error::Data(format!("'{}' has no row with side {side}", table.name()))
            })
        };
        let mut wp = [f64::NAN; 3];
        for (value, side) in wp.iter_mut().zip(SIDES) {
            *value = wps[row_of(side)?];
        }
        let total = row_of("total")?;
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
        let same = |paper: &&Paper| {
            paper.adhesive.eq_ignore_ascii_case(&source.adhesive)
                && paper.aliases.contains(&name.as_str())
        };
        Ok(Self {
            adhesive: source.adhesive.clone(),
            case: source.name.clone(),
            reference: references[total].into(),
            wp,
            slab: slabs[total],
            paper: PAPER.iter().find(same),
        })
    }

    pub(crate) fn paper_wp(&self) -> [f64; 3] {
        self.paper.map_or([f64::NAN; 3], |paper| paper.wp)
    }
}

//! Table 2 with errors: implicit runs carried on to cells of no size, and how far the others are from them.

use std::io::{self, Write};

use crate::table::Table;
use crate::table2::SIDES;
use crate::{Case, Error};

/// WP, EP and pressure of the runs whose tables hold what a finer run says of their error
/// (`wp-metrics --finer`), and the difference of all other runs from those.
#[derive(Clone, Debug)]
pub struct CellErrors {
    rows: Vec<Row>,
}

/// One quantity of one run.
#[derive(Clone, Debug)]
struct Row {
    adhesive: String,
    case: String,
    /// Place in [`QUANTITIES`].
    quantity: usize,
    /// In the cells of its case.
    as_run: f64,
    /// Carried on to cells of no size; NaN where no finer run was given.
    extrapolated: f64,
    /// Of `extrapolated`.
    error: f64,
}

/// A number of a run and how to find it.
struct Quantity {
    name: &'static str,
    side: &'static str,
    unit: &'static str,
    /// Column of `wp-metrics`; its extrapolation and error are named after it.
    column: [&'static str; 3],
    /// Value in `unit` over that in the column.
    factor: f64,
    decimals: usize,
}

const WP: [&str; 3] = ["wp_um", "wp_extrapolated_um", "wp_error_um"];
const EP: [&str; 3] = ["ep_um", "ep_extrapolated_um", "ep_error_um"];
const PRESSURE: [&str; 3] = [
    "pressure_pa",
    "pressure_extrapolated_pa",
    "pressure_error_pa",
];

const fn depth(name: &'static str, side: usize, column: [&'static str; 3]) -> Quantity {
    Quantity {
        name,
        side: SIDES[side],
        unit: "um",
        column,
        factor: 1.0,
        decimals: 2,
    }
}

/// What is printed of each run, in its order. The total EP is the volume of liquid, which no cell changes.
const QUANTITIES: [Quantity; 6] = [
    depth("WP", 0, WP),
    depth("WP", 1, WP),
    depth("WP", 2, WP),
    depth("EP", 0, EP),
    depth("EP", 1, EP),
    Quantity {
        name: "pressure",
        side: SIDES[2],
        unit: "MPa",
        column: PRESSURE,
        factor: 1e-6,
        decimals: 3,
    },
];

/// The first that Table 2 does not have.
const BESIDE_TABLE2: usize = 3;

impl CellErrors {
    /// Reads the runs among `cases`; `None` where none has an error.
    ///
    /// # Errors
    /// [`Error::Data`] for an unreadable file or a value that is not a number.
    pub fn read(cases: &[Case]) -> Result<Option<Self>, Error> {
        let mut rows = Vec::new();
        for case in cases {
            let table = Table::read(&case.path)?;
            let sides = table.texts("side")?;
            for (quantity, q) in QUANTITIES.iter().enumerate() {
                let Some(at) = sides.iter().position(|side| *side == q.side) else {
                    continue;
                };
                let number = |column: &str| match table.has(column) {
                    true => table.numbers(column).map(|n| q.factor * n[at]),
                    false => Ok(f64::NAN),
                };
                rows.push(Row {
                    adhesive: case.adhesive.clone(),
                    case: case.name.clone(),
                    quantity,
                    as_run: number(q.column[0])?,
                    extrapolated: number(q.column[1])?,
                    error: number(q.column[2])?,
                });
            }
        }
        rows.sort_by_key(|row| cases.iter().position(|c| c.adhesive == row.adhesive));
        let any = rows.iter().any(|row| row.extrapolated.is_finite());
        Ok(any.then_some(Self { rows }))
    }

    /// The run that `row` is held against: `implicit-NAME` where there is one with an error,
    /// else `implicit`.
    fn reference(&self, row: &Row) -> Option<&Row> {
        let named = |name: &str| {
            self.rows.iter().find(|other| {
                (&other.adhesive, other.quantity) == (&row.adhesive, row.quantity)
                    && other.case == name
                    && other.extrapolated.is_finite()
            })
        };
        match row.extrapolated.is_finite() {
            true => None,
            false => named(&format!("implicit-{}", row.case)).or_else(|| named("implicit")),
        }
    }

    /// `adhesive,case,quantity,side,unit,as_run,extrapolated,error,reference,difference`: a row
    /// for each number. `difference` is that of `as_run` from the reference's extrapolated
    /// number, whose error is then in `error`.
    ///
    /// # Errors
    /// The failed write.
    pub fn write_csv(&self, out: impl Write) -> io::Result<()> {
        let mut writer = csv::Writer::from_writer(out);
        writer.write_record([
            "adhesive",
            "case",
            "quantity",
            "side",
            "unit",
            "as_run",
            "extrapolated",
            "error",
            "reference",
            "difference",
        ])?;
        let number = |value: f64| match value.is_finite() {
            true => format!("{value:.4}"),
            false => String::new(),
        };
        for row in &self.rows {
            let q = &QUANTITIES[row.quantity];
            let reference = self.reference(row);
            let error = reference.map_or(row.error, |r| r.error);
            let difference = reference.map_or(f64::NAN, |r| row.as_run - r.extrapolated);
            writer.write_record([
                row.adhesive.clone(),
                row.case.clone(),
                q.name.to_lowercase(),
                q.side.into(),
                q.unit.into(),
                number(row.as_run),
                number(row.extrapolated),
                number(error),
                reference.map_or(String::new(), |r| r.case.clone()),
                number(difference),
            ])?;
        }
        writer.flush()
    }

    /// EP and pressure for reading, with a heading; WP stands in Table 2.
    pub fn to_text(&self) -> String {
        let longest = self.rows.iter().map(|row| row.case.chars().count());
        let wide = longest.max().unwrap_or(0).max(16) + 1;
        let mut text = String::from(
            "With errors: implicit runs carried on to cells of no size by first order +- the difference of the two sizes;\n\
             other runs: difference from those.\n",
        );
        text += &format!("{:<9} {:<wide$}", "adhesive", "case");
        for q in &QUANTITIES[BESIDE_TABLE2..] {
            let side = if q.unit == "um" { q.side } else { "end" };
            text += &format!("{:>19}", format!("{} {side} ({})", q.name, q.unit));
        }
        for of_run in self
            .rows
            .chunk_by(|a, b| (&a.adhesive, &a.case) == (&b.adhesive, &b.case))
        {
            text += &format!("\n{:<9} {:<wide$}", of_run[0].adhesive, of_run[0].case);
            for row in of_run.iter().filter(|row| row.quantity >= BESIDE_TABLE2) {
                text += &format!("{:>19}", self.cell(row));
            }
        }
        text + "\n"
    }

    fn cell(&self, row: &Row) -> String {
        let places = QUANTITIES[row.quantity].decimals;
        match self.reference(row) {
            Some(r) if row.as_run.is_finite() => {
                format!("{:+.places$}", row.as_run - r.extrapolated)
            }
            None if row.extrapolated.is_finite() => {
                format!("{:.places$} +- {:.places$}", row.extrapolated, row.error)
            }
            _ => "-".into(),
        }
    }
}

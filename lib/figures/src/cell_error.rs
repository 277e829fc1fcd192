//! Table 2 with errors: implicit runs carried on to cells of no size, and how far the others are from them.

use std::io::{self, Write};

use crate::Case;
use crate::known::{Known, QUANTITIES, Quantity, signed};
use crate::table2::{Row, Table2, number};

/// The first of the quantities that Table 2 does not have.
const BESIDE_TABLE2: usize = 3;
/// Note on pressures at the end of a run.
pub const AT_THE_END: &str =
    "at the end of the last step; runs that left different gaps are not compared";

impl Table2 {
    /// Whether a finer run says something of the error of a run.
    pub fn has_cell_errors(&self) -> bool {
        let mut known = self.runs().flat_map(|run| run.known);
        known.any(Known::has_error)
    }

    fn runs(&self) -> impl Iterator<Item = &Row> {
        self.rows.iter().filter(|row| row.case != Case::EXPERIMENT)
    }

    /// The run that a quantity of `row` is held against where it has no error of its own: `implicit-NAME`
    /// where there is one with an error, else `implicit`. A pressure is compared only with that of a run that left the same gap.
    fn reference(&self, row: &Row, quantity: usize) -> Option<(&Row, Known)> {
        let named = |name: &str| {
            let mut others = self.runs().filter(|run| run.adhesive == row.adhesive);
            let other = others.find(|run| run.case == name && run.known[quantity].has_error())?;
            Some((other, other.known[quantity]))
        };
        let apart = |other: &Row| {
            let ends = row.end.as_ref().zip(other.end.as_ref());
            QUANTITIES[quantity].unit == "MPa"
                && ends.is_some_and(|(end, other)| end.is_apart(other))
        };
        let best = || named(&format!("implicit-{}", row.case)).or_else(|| named("implicit"));
        match row.known[quantity].has_error() {
            true => None,
            false => best().filter(|(other, _)| !apart(other)),
        }
    }

    /// `adhesive,case,quantity,side,unit,as_run,extrapolated,error,reference,difference`: a row
    /// for each number of a run. `difference` is that of `as_run` from the reference's extrapolated
    /// number, whose error is then in `error`.
    ///
    /// # Errors
    /// The failed write.
    pub fn write_cell_errors(&self, out: impl Write) -> io::Result<()> {
        let mut writer = csv::Writer::from_writer(out);
        let header =
            "adhesive,case,quantity,side,unit,as_run,extrapolated,error,reference,difference";
        writer.write_record(header.split(','))?;
        for row in self.runs() {
            for (i, (q, known)) in QUANTITIES.iter().zip(row.known).enumerate() {
                let (case, best) = self.reference(row, i).unzip();
                let difference = best.map_or(f64::NAN, |best| known.as_run - best.extrapolated);
                writer.write_record([
                    row.adhesive.as_str(),
                    &row.case,
                    &q.name.to_lowercase(),
                    q.side,
                    q.unit,
                    &number(known.as_run),
                    &number(known.extrapolated),
                    &number(best.unwrap_or(known).error),
                    case.map_or("", |row| &row.case),
                    &number(difference),
                ])?;
            }
        }
        writer.flush()
    }

    /// EP and pressure of runs for reading, with a heading; WP stands in [`Table2::to_text`].
    pub fn cell_errors_to_text(&self) -> String {
        let wide = self.widest();
        let mut text = String::from(
            "With errors: implicit runs, extrapolated to zero cell size (first order) +- the difference between two cell sizes;\n\
             other runs: difference from these.\n",
        );
        text += &format!("{:<9} {:<wide$}", "adhesive", "case");
        for q in &QUANTITIES[BESIDE_TABLE2..] {
            let side = if q.unit == "um" { q.side } else { "end" };
            text += &format!("{:>19}", format!("{} {side} ({})", q.name, q.unit));
        }
        for row in self.runs() {
            text += &format!("\n{:<9} {:<wide$}", row.adhesive, row.case);
            for i in BESIDE_TABLE2..QUANTITIES.len() {
                text += &format!("{:>19}", self.cell(row, i));
            }
        }
        text + &format!("\npressure end: {AT_THE_END}\n")
    }

    fn cell(&self, row: &Row, quantity: usize) -> String {
        let Quantity { unit, decimals, .. } = QUANTITIES[quantity];
        let known = row.known[quantity];
        match self.reference(row, quantity) {
            Some((_, best)) if known.as_run.is_finite() => {
                signed(known.as_run - best.extrapolated, decimals)
            }
            None if known.has_error() && unit == "MPa" => {
                known.told_pressure(decimals, " +- ", row.limit)
            }
            None if known.has_error() => known.told(decimals).join(" +- "),
            _ => "-".into(),
        }
    }
}

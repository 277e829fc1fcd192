//! How deep adhesive has gone on each side over time, from the CSV of `wp-metrics --series`.

use crate::closing::time_unit;
use crate::table::Table;
use crate::{Error, Labelled, Mark, Plot};

/// Longest over shortest time from which their logarithms are drawn: a press takes from microseconds to
/// minutes, more decades than a logarithmic axis shows.
const LONG: f64 = 100.0;

/// WP and the depth of 95 % of the adhesive, a line for each side of one run or for the whole of each of
/// several, and a dot where a bond line is no longer filled.
///
/// # Errors
/// [`Error::Data`] for an unreadable file, a missing column or side, or one without numbers.
pub fn penetrations(runs: &[Labelled]) -> Result<Plot, Error> {
    let tables = runs.iter().map(|run| Table::read(&run.path));
    let tables = tables.collect::<Result<Vec<_>, _>>()?;
    let mut times = Vec::new();
    for table in &tables {
        times.extend(table.data("time_s")?.into_iter().filter(|t| *t > 0.0));
    }
    let (first, last) = (times.iter()).fold((f64::INFINITY, 0.0_f64), |(first, last), &t| {
        (first.min(t), last.max(t))
    });
    let (unit, name) = time_unit(last);
    let long = last > LONG * first;
    let title = match long {
        true => format!("log10 of time ({name})"),
        false => format!("time ({name})"),
    };
    let place = |time: f64| match long {
        true => (time / unit).log10(),
        false => time / unit,
    };
    let mut plot = Plot::new("Penetration", &title, "depth (µm)");
    for (run, table) in runs.iter().zip(&tables) {
        let (own, sides) = match runs.len() {
            1 => (String::new(), &["bottom", "top"][..]),
            _ => (format!("{}: ", run.label), &["total"][..]),
        };
        for &side in sides {
            for (column, what) in [("wp_um", "WP"), ("p95_depth_um", "95 %")] {
                let points = course(table, side, column, place)?;
                plot = plot.with(&format!("{own}{what}, {side}"), Mark::LineAndDots, points);
            }
        }
        let states = table.texts("bond_line")?;
        if let Some(row) = states.iter().position(|state| *state != "filled") {
            let at = [place(table.data("time_s")?[row]), 0.0];
            plot = plot.with(&format!("{own}{}", states[row]), Mark::Dots, vec![at]);
        }
    }
    Ok(plot)
}

/// A column of one side over the `place` of its time (s); what is at no time has no logarithm.
fn course(
    table: &Table,
    side: &str,
    column: &str,
    place: impl Fn(f64) -> f64,
) -> Result<Vec<[f64; 2]>, Error> {
    let (sides, times, values) = (
        table.texts("side")?,
        table.data("time_s")?,
        table.data(column)?,
    );
    let rows = (0..sides.len()).filter(|&row| sides[row] == side && times[row] > 0.0);
    let points: Vec<[f64; 2]> = rows.map(|row| [place(times[row]), values[row]]).collect();
    if points.is_empty() {
        return Err(Error::Data(format!(
            "'{}' has no row of the side {side} after the start, as wp-metrics --series writes them",
            table.name()
        )));
    }
    Ok(points)
}

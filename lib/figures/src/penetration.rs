//! How deep adhesive has gone, how much wood it wets and how full the open lumens are, from the tables of
//! `wp-metrics --series` or the histories of runs.

use crate::axes::extent;
use crate::closing::time_unit;
use crate::table::Table;
use crate::{Error, Labelled, Mark, Plot};

/// Longest over shortest time from which time is drawn by its decades: a press takes from microseconds to
/// minutes.
pub(crate) const LONG: f64 = 100.0;
/// Most times of one profile that are drawn.
const MOST_TIMES: usize = 5;

/// Quantities: column, unit, and what they are called before a side.
const WETTED: [&str; 3] = ["wetted_area", "um2", ""];
const WP: [&str; 3] = ["wp", "um", "WP, "];
const DEEPEST: [&str; 3] = ["p95_depth", "um", "95 %, "];

/// What of penetration a figure shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, strum::EnumString, strum::VariantNames)]
#[strum(serialize_all = "lowercase")]
pub enum Shown {
    /// WP and the depth of 95 % of the adhesive over time.
    Depth,
    /// The area of wood that adhesive wets over time.
    Wetted,
    /// The filled share of the open lumens against depth, from profiles of `wp-metrics --profile`.
    Filled,
}

/// A line for each side of one run or for the whole of each of several, and a dot where a bond line is no
/// longer filled.
///
/// # Errors
/// [`Error::Data`] for an unreadable file, a missing column or side, or one without numbers.
pub fn penetrations(runs: &[Labelled], shown: Shown) -> Result<Plot, Error> {
    let tables = runs.iter().map(|run| Table::read(&run.path));
    let tables = tables.collect::<Result<Vec<_>, _>>()?;
    let (title, axis, quantities): (_, _, &[_]) = match shown {
        Shown::Filled => return filled(runs, &tables),
        Shown::Wetted => ("Wetted area", "wood wetted (µm²)", &[WETTED]),
        Shown::Depth => ("Penetration", "depth (µm)", &[WP, DEEPEST]),
    };
    let mut times = Vec::new();
    for table in &tables {
        times.extend(table.numbers("time_s")?.into_iter().filter(|t| *t > 0.0));
    }
    let (first, last) = extent(times.into_iter());
    let (unit, name) = time_unit(last);
    let mut plot = Plot::new(&titled(title, runs), &format!("time ({name})"), axis);
    if last > LONG * first {
        plot = plot.logarithmic([true, false]);
    }
    for (run, table) in runs.iter().zip(&tables) {
        let (own, sides) = match runs.len() {
            1 => (String::new(), &["bottom", "top"][..]),
            _ => (format!("{}: ", run.label), &["total"][..]),
        };
        for &side in sides {
            for [quantity, of, what] in quantities {
                let points = course(table, side, quantity, of, unit)?;
                plot = plot.with(&format!("{own}{what}{side}"), Mark::LineAndDots, points);
            }
        }
        let states = table.texts("bond_line")?;
        if let Some(row) = states.iter().position(|state| *state != "filled") {
            let at = [table.numbers("time_s")?[row] / unit, 0.0];
            plot = plot.with(&format!("{own}{}", states[row]), Mark::Dots, vec![at]);
        }
    }
    Ok(plot)
}

/// A title, with the label of a single run, which no line has.
fn titled(title: &str, runs: &[Labelled]) -> String {
    match runs {
        [run] => format!("{title}, {}", run.label),
        _ => title.into(),
    }
}

/// A quantity of one side over time, in `unit` (s).
fn course(
    table: &Table,
    side: &str,
    quantity: &str,
    of: &str,
    unit: f64,
) -> Result<Vec<[f64; 2]>, Error> {
    let times = table.numbers("time_s")?;
    // A side without adhesive has no depth.
    let of_one = |side: &str| quantity != WETTED[0] && side != "total";
    // A series has a row for each side, a history a column.
    let (sides, values) = match table.has("side") {
        true => {
            let (sides, column) = (table.texts("side")?, format!("{quantity}_{of}"));
            let values = table.numbers_but(&column, |row| of_one(sides[row]))?;
            (sides, values)
        }
        false => {
            let column = |side: &str| format!("{quantity}_{side}_{of}");
            let values = of_history(table, side, column, of_one(side))?;
            (vec![side; times.len()], values)
        }
    };
    let rows = (0..sides.len()).filter(|&row| sides[row] == side);
    let points: Vec<[f64; 2]> = rows.map(|row| [times[row] / unit, values[row]]).collect();
    if !points.iter().any(|point| point[0] > 0.0) {
        return Err(Error::Data(format!(
            "'{}' has no row of the side {side} after the start, as wp-metrics --series writes them",
            table.name()
        )));
    }
    Ok(points)
}

/// What each row of a history has in the column of a side.
fn of_history(
    table: &Table,
    side: &str,
    column: impl Fn(&str) -> String,
    may_lack: bool,
) -> Result<Vec<f64>, Error> {
    if !table.has(&column("bottom")) {
        return Err(Error::Request(format!(
            "'{}' has no penetration: a history has it if the case has [output] penetration = true, and \
             wp-metrics --series tells it of the snapshots of any run",
            table.name()
        )));
    }
    if side == "total" && !table.has(&column(side)) {
        let [bottom, top] = [
            table.numbers(&column("bottom"))?,
            table.numbers(&column("top"))?,
        ];
        return Ok(bottom.iter().zip(&top).map(|(b, t)| b + t).collect());
    }
    table.numbers_but(&column(side), |_| may_lack)
}

/// The filled share of open lumens against depth: of one run at some of its times, of several at their last.
fn filled(runs: &[Labelled], tables: &[Table]) -> Result<Plot, Error> {
    let depth = "depth from the middle of the bond line (µm), bottom negative";
    let title = titled("Filled share of the open lumens", runs);
    let mut plot = Plot::new(&title, depth, "filled share");
    for (run, table) in runs.iter().zip(tables) {
        let depths = table.numbers("depth_um")?;
        let shares = table.numbers_but("filled_open_fraction", |_| true)?;
        let times = match table.has("time_s") {
            true => table.numbers("time_s")?,
            false => vec![0.0; depths.len()],
        };
        let mut told = times.clone();
        told.dedup();
        let last = told.len() - 1;
        let count = if runs.len() > 1 {
            1
        } else {
            MOST_TIMES.min(told.len())
        };
        for i in 0..count {
            // The last in any case, the others evenly among the rest.
            let time = told[last - (count - 1 - i) * last / (count - 1).max(1)];
            let rows = (0..depths.len()).filter(|&row| times[row] == time);
            // A layer without open lumens breaks the line and does not widen the axis, nor does one a little over full.
            let place = |row: usize| match shares[row].is_finite() {
                true => [depths[row], shares[row].min(1.0)],
                false => [f64::NAN; 2],
            };
            let (unit, name) = time_unit(time);
            let label = match (runs.len(), table.has("time_s")) {
                (1, true) => format!("{:.3} {name}", time / unit),
                _ => run.label.clone(),
            };
            plot = plot.with(&label, Mark::Line, rows.map(place).collect());
        }
    }
    Ok(plot)
}

//! The error to expect of a run, quoted from the measured table of `make tradeoff`
//! (docs/results/tradeoff.md).

use std::fmt::Write;

use physics::Choice;

use crate::case::{Case, SchemeName};

/// Written by `make tradeoff`; not to be edited.
const TABLE: &str = include_str!("expected_error.csv");

/// Width of the lumens that the study measured and the paper's wood has (section 2.3), m.
const LUMEN_M: f64 = 17.4e-6;

/// One row of the table.
#[derive(Clone, Debug, PartialEq)]
struct Measured {
    /// Scheme, update, order, shape, pressure, projection.
    key: [String; 6],
    cells: f64,
    /// Relative errors: piston force, channel flux, pressure and WP of a small bond line.
    errors: [Option<f64>; 4],
}

/// The lines of `--explain` about a case.
pub(crate) fn text(case: &Case) -> String {
    let cells = LUMEN_M / case.grid.cell.si();
    let mut out = String::from("\nerror to expect (measured, docs/results/tradeoff.md)\n");
    // Writing to a string cannot fail.
    let _ = writeln!(out, "  lumens             {cells:.1} cells across 17.4 um");
    let _ = match nearest(&key(case), cells) {
        Some(row) => quote(&mut out, case, &row),
        None => writeln!(
            out,
            "  pressure, flow     not measured with this update, shape and options"
        ),
    };
    out
}

fn quote(out: &mut String, case: &Case, row: &Measured) -> std::fmt::Result {
    let percent = |error: f64| match 100.0 * error {
        p if p < 10.0 => format!("{p:.1} %"),
        p => format!("{p:.0} %"),
    };
    let [slit, channel, pressure, wp] = row.errors;
    let mut line = |name: &str, errors: &[(Option<f64>, &str)]| {
        let measured = errors.iter().filter_map(|&(error, place)| {
            let error = percent(error?);
            Some(format!("about {error} ({place})"))
        });
        let measured: Vec<String> = measured.collect();
        if measured.is_empty() {
            return Ok(());
        }
        writeln!(out, "  {name:<18} {}", measured.join(", "))
    };
    let (press, bond) = ("piston into slit", "a small bond line");
    line("clamp pressure", &[(slit, press), (pressure, bond)])?;
    line("flow in lumens", &[(channel, "plane channel")])?;
    line("WP", &[(wp, bond)])?;
    writeln!(
        out,
        "  measured with      {} cells across the lumen, walls off the nodes among them",
        row.cells
    )?;
    writeln!(
        out,
        "                     slit against finite elements; bond line against finer runs of the implicit scheme, no independent reference"
    )?;
    let mut other = Vec::new();
    if case
        .contact
        .as_ref()
        .is_some_and(|c| c.separation.is_some())
    {
        other.push("contact separation");
    }
    if case.grid.points_per_direction != 2 {
        other.push("points per direction");
    }
    if case.integrator.cfl.is_some_and(|c| (c - 0.5).abs() > 1e-9) {
        other.push("Courant number");
    }
    if !other.is_empty() {
        writeln!(
            out,
            "                     and the default {}",
            other.join(", ")
        )?;
    }
    Ok(())
}

/// What of a case selects rows.
fn key(case: &Case) -> [String; 6] {
    let table = &case.integrator;
    if table.scheme == SchemeName::Implicit {
        return [table.scheme.name(), "", "", "", "", ""].map(str::to_owned);
    }
    let projection = match table.density_projection {
        Some(_) => "yes",
        None => "no",
    };
    let order = table.order.map_or(String::new(), |m| m.to_string());
    let [scheme, update, shape, pressure, projection] = [
        table.scheme.name(),
        table.velocity_update.unwrap_or_default().name(),
        case.grid.shape.unwrap_or_default().name(),
        table.pressure.unwrap_or_default().name(),
        projection,
    ]
    .map(str::to_owned);
    [scheme, update, order, shape, pressure, projection]
}

/// The row of this key whose cells are nearest, by ratio.
fn nearest(key: &[String; 6], cells: f64) -> Option<Measured> {
    let far = |row: &Measured| (row.cells / cells).ln().abs();
    rows()
        .filter(|row| row.key == *key && row.errors.iter().any(Option::is_some))
        .min_by(|a, b| far(a).total_cmp(&far(b)))
}

fn rows() -> impl Iterator<Item = Measured> {
    TABLE.lines().skip(1).filter_map(|line| {
        let words: Vec<&str> = line.split(',').collect();
        let key: [&str; 6] = words.get(..6)?.try_into().ok()?;
        let error = |i: usize| words.get(i)?.parse::<f64>().ok();
        Some(Measured {
            key: key.map(str::to_owned),
            cells: words.get(6)?.parse().ok()?,
            errors: [7, 8, 9, 10].map(error),
        })
    })
}

#[cfg(test)]
mod tests {
    use mpm::{PressureFrom, ShapeFunction, VelocityUpdate};

    use super::*;

    fn key(words: [&str; 6]) -> [String; 6] {
        words.map(str::to_owned)
    }

    #[test]
    fn every_line_of_the_table_is_a_row_with_the_slit_measured_or_failed() {
        assert_eq!(rows().count(), TABLE.lines().count() - 1);
        assert!(rows().any(|row| row.errors[0].is_some()));
        for Measured { key, .. } in rows().filter(|row| row.key[0] == SchemeName::Explicit.name()) {
            VelocityUpdate::named(&key[1]).unwrap();
            ShapeFunction::named(&key[3]).unwrap();
            PressureFrom::named(&key[4]).unwrap();
        }
    }

    #[test]
    fn the_schemes_of_the_six_runs_and_the_implicit_one_are_there() {
        for words in [
            ["explicit", "flip", "", "gimp", "point", "no"],
            ["explicit", "xpic", "5", "gimp", "point", "no"],
            ["implicit", "", "", "", "", ""],
        ] {
            let row = nearest(&key(words), 6.4).unwrap();
            assert_eq!(row.cells, 6.0, "{words:?}");
            assert!(row.errors.iter().all(Option::is_some), "{words:?}");
            assert!(nearest(&key(words), 40.0).unwrap().cells > 6.0);
        }
        assert_eq!(
            nearest(&key(["explicit", "xpic", "19", "", "", ""]), 6.0),
            None
        );
    }
}

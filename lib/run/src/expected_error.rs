//! Expected error of a run, from the table measured by `make tradeoff` (docs/results/tradeoff.md).

use physics::Choice;

use crate::case::{Case, SchemeName};
use crate::forecast::line;
use crate::schemes;

/// Written by `make tradeoff`; not to be edited.
const TABLE: &str = include_str!("expected_error.csv");

/// `out/quick/errors.csv` of `make` (docs/results/README.md, error by cell size); not to be edited.
const CELL_ERRORS: &str = include_str!("cell_error.csv");
/// Cells across a lumen in the coarser runs of that table, whose cells are two voxels wide.
const COARSER_CELLS: f64 = 6.0;

/// Lumen width in the study and in the paper's wood (section 2.3), m.
const LUMEN_M: f64 = 17.4e-6;

/// One row of the table.
#[derive(Clone, Debug, PartialEq)]
struct Measured {
    /// Scheme, velocity update, order, shape function, pressure, density projection.
    key: [&'static str; 6],
    cells: f64,
    /// Relative errors: piston force, channel flux, pressure and WP of a small bond line.
    errors: [Option<f64>; 4],
}

/// Measured errors for a case's scheme and options, at the cell size nearest to its own.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct ExpectedError {
    /// Cells of the case across a lumen 17.4 um wide.
    pub cells_per_lumen: f64,
    /// Cells across that lumen in the measurement; `None` if these options were not measured.
    pub measured_with_cells: Option<f64>,
    /// The errors.
    pub errors: Vec<QuantityError>,
    /// Settings in which the case differs from the measurement, which used the defaults.
    pub not_as_measured: Vec<&'static str>,
}

/// Measured error of one quantity in one scene.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct QuantityError {
    /// Name of the quantity.
    pub quantity: &'static str,
    /// Scene of the measurement.
    pub scene: &'static str,
    /// Relative error.
    pub relative: f64,
}

/// Relative error of the implicit scheme's pressure in the step in which the first of two lumens is full, against short steps
/// (`cargo test -p implicit --test scheme a_lumen_that_fills`).
const FILLING_STEP_ERROR: f64 = 0.67;

/// The expected error of `case` with cells of `cell_m` (m).
pub(crate) fn expect(case: &Case, cell_m: f64) -> ExpectedError {
    let cells = LUMEN_M / cell_m;
    let row = nearest(&key(case), cells);
    let (press, bond) = ("piston into slit", "a small bond line");
    let [slit, channel, pressure, wp] = row.as_ref().map_or([None; 4], |row| row.errors);
    let two_sizes = row.as_ref().and_then(worst_of_two_sizes);
    let measured = [
        ("clamp pressure", press, slit),
        ("clamp pressure", bond, pressure),
        (
            "clamp pressure",
            "the step in which the first of two lumens is full",
            two_sizes.map(|_| FILLING_STEP_ERROR),
        ),
        ("flow in lumens", "plane channel", channel),
        ("WP", bond, wp),
        (
            "WP",
            "from two cell sizes, worst bond of the quick specimens",
            two_sizes,
        ),
    ];
    let error = |(quantity, scene, relative): (_, _, Option<f64>)| {
        relative.map(|relative| QuantityError {
            quantity,
            scene,
            relative,
        })
    };
    let separation = case.contact.as_ref().and_then(|c| c.separation);
    let cfl = schemes::cfl(case) - schemes::default_cfl(case);
    let others = [
        ("contact separation", separation.is_some()),
        ("points per direction", case.grid.points_per_direction != 2),
        ("Courant number", cfl.abs() > 1e-9),
    ];
    let other = |(name, differs)| if differs { Some(name) } else { None };
    ExpectedError {
        cells_per_lumen: cells,
        measured_with_cells: row.as_ref().map(|row| row.cells),
        errors: measured.into_iter().filter_map(error).collect(),
        not_as_measured: others.into_iter().filter_map(other).collect(),
    }
}

/// The lines of `--explain` on the expected error of `case` with cells of `cell_m` (m).
pub(crate) fn text(case: &Case, cell_m: f64) -> String {
    let expected = expect(case, cell_m);
    let across = expected.cells_per_lumen;
    let mut out = "\nexpected error (measured, docs/results/tradeoff.md)\n".to_owned();
    out += &line("lumen of 17.4 um", format!("{across:.1} cells across"));
    let Some(cells) = expected.measured_with_cells else {
        let not = "not measured with this update, shape and options";
        return out + &line("pressure, flow", not);
    };
    for errors in expected.errors.chunk_by(|a, b| a.quantity == b.quantity) {
        let measured = errors.iter().map(|error| {
            let percent = 100.0 * error.relative;
            let digits = usize::from(percent < 10.0);
            format!("about {percent:.digits$} % ({})", error.scene)
        });
        out += &line(errors[0].quantity, measured.collect::<Vec<_>>().join(", "));
    }
    let walls = format!("{cells} cells across that lumen, some of its walls between nodes");
    out += &line("measured with", walls);
    let against =
        "a slit, against finite elements; a bond line, against finer runs of the implicit scheme";
    out += &line("measured in", against);
    match expected.not_as_measured.join(", ") {
        none if none.is_empty() => out,
        other => out + &line("", format!("with the default {other}, unlike this case")),
    }
}

/// The options of a case by which rows of the table are selected.
fn key(case: &Case) -> [String; 6] {
    let table = &case.integrator;
    let scheme = table.scheme.name();
    let key = match table.scheme {
        SchemeName::Implicit => [scheme, "", "", "", "", ""],
        SchemeName::Explicit => [
            scheme,
            table.velocity_update.unwrap_or_default().name(),
            &table.order.map_or(String::new(), |order| order.to_string()),
            case.grid.shape.unwrap_or_default().name(),
            table.pressure.unwrap_or_default().name(),
            match table.density_projection {
                Some(_) => "yes",
                None => "no",
            },
        ],
    };
    key.map(str::to_owned)
}

/// The measured row with this key whose number of cells is nearest, by ratio.
fn nearest(key: &[impl AsRef<str>; 6], cells: f64) -> Option<Measured> {
    let far = |row: &Measured| (row.cells / cells).ln().abs();
    rows()
        .filter(|row| {
            row.key == key.each_ref().map(AsRef::as_ref) && row.errors.iter().any(Option::is_some)
        })
        .min_by(|a, b| far(a).total_cmp(&far(b)))
}

/// Largest relative error of a total WP from runs with two cell sizes, if `row` has the coarser cells of these runs.
fn worst_of_two_sizes(row: &Measured) -> Option<f64> {
    let is_coarser = row.key[0] == SchemeName::Implicit.name() && row.cells == COARSER_CELLS;
    let errors = CELL_ERRORS
        .lines()
        .filter(|_| is_coarser)
        .filter_map(|line| {
            let [_, _, "wp", "total", _, _, extrapolated, error, ..] =
                line.split(',').collect::<Vec<_>>()[..]
            else {
                return None;
            };
            Some(error.parse::<f64>().ok()? / extrapolated.parse::<f64>().ok()?)
        });
    errors.reduce(f64::max)
}

fn rows() -> impl Iterator<Item = Measured> {
    TABLE.lines().skip(1).filter_map(|line| {
        let words: Vec<&str> = line.split(',').collect();
        let key: [&str; 6] = words.get(..6)?.try_into().ok()?;
        let error = |i: usize| words.get(i)?.parse::<f64>().ok();
        Some(Measured {
            key,
            cells: words.get(6)?.parse().ok()?,
            errors: [7, 8, 9, 10].map(error),
        })
    })
}

#[cfg(test)]
mod tests {
    use mpm::{PressureFrom, ShapeFunction, VelocityUpdate};

    use super::*;

    #[test]
    fn every_line_of_the_table_is_a_row_with_the_slit_measured_or_failed() {
        assert_eq!(rows().count(), TABLE.lines().count() - 1);
        assert!(rows().any(|row| row.errors[0].is_some()));
        for Measured { key, .. } in rows().filter(|row| row.key[0] == SchemeName::Explicit.name()) {
            VelocityUpdate::named(key[1]).unwrap();
            ShapeFunction::named(key[3]).unwrap();
            PressureFrom::named(key[4]).unwrap();
        }
    }

    #[test]
    fn the_schemes_of_the_six_runs_and_the_implicit_one_are_there() {
        for words in [
            ["explicit", "flip", "", "gimp", "point", "no"],
            ["explicit", "xpic", "5", "gimp", "point", "no"],
            ["implicit", "", "", "", "", ""],
        ] {
            let row = nearest(&words, 6.4).unwrap();
            assert_eq!(row.cells, 6.0, "{words:?}");
            assert!(row.errors.iter().all(Option::is_some), "{words:?}");
            // PF, frictionless: 0.1024 of 7.1275 um.
            let worst = (words[0] == "implicit").then_some(0.1024 / 7.1275);
            assert_eq!(worst_of_two_sizes(&row), worst);
            assert!(nearest(&words, 40.0).unwrap().cells > 6.0);
        }
        assert_eq!(nearest(&["explicit", "xpic", "19", "", "", ""], 6.0), None);
    }
}

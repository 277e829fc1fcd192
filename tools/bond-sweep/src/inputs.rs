//! The inputs of a sweep as columns of numbers, with their units in the header.

use units::unit;

use crate::draft::Draft;
use crate::specimen::{QUICK, Recipe};
use crate::table::{ColumnKind, Table};

/// Significant digits of a number that was converted: what rounding adds lies behind them.
const DIGITS: usize = 12;

/// The header and the cells of each row; where a cell of the table is empty, what the run takes.
pub fn columns(table: &Table, drafts: &[Draft]) -> (Vec<String>, Vec<Vec<String>>) {
    let case = |draft: &Draft| Some(toml::Value::Table(toml::from_str(&draft.text).ok()?));
    let cases: Vec<_> = drafts.iter().map(case).collect();
    let mut header = Vec::new();
    let mut rows = vec![Vec::new(); drafts.len()];
    for (i, (name, kind)) in table.columns.iter().enumerate() {
        let taken = |row: usize, draft: &Draft| match (table.rows[row][i].as_str(), kind) {
            ("", ColumnKind::Case) => {
                let stem = draft.case.file_stem().unwrap_or_default();
                stem.to_string_lossy().into_owned()
            }
            (_, ColumnKind::Specimen(option)) => (draft.recipe.as_ref())
                .and_then(|recipe| of_recipe(recipe, option))
                .unwrap_or_default(),
            (_, ColumnKind::Key) => (cases[row].as_ref())
                .and_then(|case| of_case(case, name))
                .unwrap_or_default(),
            (given, _) => given.to_owned(),
        };
        let cells = drafts.iter().enumerate().map(|(row, d)| taken(row, d));
        let (name, cells) = with_unit(name, cells.collect());
        header.push(name);
        for (row, cell) in rows.iter_mut().zip(cells) {
            row.push(cell);
        }
    }
    (header, rows)
}

fn of_recipe(recipe: &Recipe, option: &str) -> Option<String> {
    let place = QUICK.iter().position(|(name, _)| *name == option)?;
    Some(recipe.0[place].clone())
}

/// The value at a key such as `clamp.pid.kp`.
fn of_case(case: &toml::Value, key: &str) -> Option<String> {
    Some(match run::value_at(case, key)? {
        toml::Value::String(text) => text.clone(),
        other => other.to_string(),
    })
}

/// Puts the unit of the first cell into the header where all cells are of its dimension, and
/// converts the others to it.
fn with_unit(name: &str, cells: Vec<String>) -> (String, Vec<String>) {
    let quantities: Option<Vec<_>> = (cells.iter().filter(|cell| !cell.is_empty()))
        .map(|cell| quantity(cell))
        .collect();
    let Some(&[(_, first, dimension, factor), ..]) = quantities.as_deref() else {
        return (name.into(), cells);
    };
    let alike = |cells: &[(&str, &str, &str, f64)]| cells.iter().all(|q| q.2 == dimension);
    if !alike(&quantities.unwrap_or_default()) {
        return (name.into(), cells);
    }
    let number = |cell: &String| match quantity(cell) {
        Some((number, unit, ..)) if unit == first => number.to_owned(),
        Some((number, _, _, own)) => {
            let value = number.parse::<f64>().unwrap_or(f64::NAN) * own / factor;
            let rounded = format!("{value:.*e}", DIGITS - 1).parse::<f64>();
            rounded.unwrap_or(value).to_string()
        }
        None => String::new(),
    };
    let numbers = cells.iter().map(number).collect();
    (format!("{name}_{}", first.replace(' ', "_")), numbers)
}

/// Number, unit, what it measures, and the unit in SI; multiples of the cell and of the
/// voxel are measures of their own.
fn quantity(cell: &str) -> Option<(&str, &str, &'static str, f64)> {
    // The shortest unit, so that an exponent is none.
    let split = (1..cell.len())
        .rev()
        .filter(|&at| cell.is_char_boundary(at));
    let mut parts = split.map(|at| (cell[..at].trim_end(), cell[at..].trim_start()));
    parts.find_map(|(number, symbol)| {
        number.parse::<f64>().ok().filter(|n| n.is_finite())?;
        let (dimension, factor) = match symbol {
            "cell" => ("cells", 1.0),
            "voxel" | "voxels" => ("voxels", 1.0),
            symbol => unit(symbol)?,
        };
        Some((number, symbol, dimension, factor))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_go_into_the_header_and_numbers_stay_as_written() {
        for (cells, name, numbers) in [
            ("1300 cP, 1.3 Pa s, ", "a.b_cP", "1300, 1300, "),
            ("1e-3 m, 2 um", "a.b_m", "1e-3, 0.000002"),
            ("2.5MPa, 25 bar", "a.b_MPa", "2.5, 2.5"),
            ("1.3 Pa s", "a.b_Pa_s", "1.3"),
            ("0.01 cell, 0.02 cell", "a.b_cell", "0.01, 0.02"),
            ("2 voxels, 1 voxel", "a.b_voxels", "2, 1"),
            ("0.25, 1", "a.b", "0.25, 1"),
            ("closed, 0.08 ms", "a.b", "closed, 0.08 ms"),
            ("0.01 cell, 2 um", "a.b", "0.01 cell, 2 um"),
            ("40x96x40", "a.b", "40x96x40"),
            ("", "a.b", ""),
        ] {
            let cells = cells.split(", ").map(str::to_owned).collect();
            let (header, found) = with_unit("a.b", cells);
            assert_eq!(
                (header.as_str(), found.join(", ").as_str()),
                (name, numbers)
            );
        }
    }

    #[test]
    fn a_key_is_found_in_tables_and_lists() {
        let case = "[a]\nb = { c = 0.5 }\nd = [1, \"2 um\"]\n"
            .parse()
            .map(toml::Value::Table);
        let case = case.unwrap();
        assert_eq!(of_case(&case, "a.b.c").as_deref(), Some("0.5"));
        assert_eq!(of_case(&case, "a.d.1").as_deref(), Some("2 um"));
        assert_eq!(of_case(&case, "a.d.2"), None);
        assert_eq!(of_case(&case, "e"), None);
    }
}

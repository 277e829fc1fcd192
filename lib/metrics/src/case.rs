//! The case of a run without the keys that depend on the size of its cells, to compare runs.

use toml::{Table, Value};
use units::{Length, Quantity};

/// End of a line with a default value in `resolved.toml`.
const DEFAULT: &str = "# default";
/// Keys that depend on the size of the cells.
const OF_CELLS: [(&str, &[&str]); 2] = [
    ("grid", &["cell", "shape", "points_per_direction", "domain"]),
    ("integrator", &["cfl", "tolerance"]),
];

/// The case of a run from the text of its `resolved.toml`, with lengths in metres and without `[output]` and keys that depend
/// on the size of the cells, `cell_m` (m). A time limit is kept only if it was given and `limited`. `None` if the text is no TOML.
pub fn case_without_cells(resolved: &str, cell_m: f64, limited: bool) -> Option<Table> {
    let limit = |line: &&str| line.starts_with("time_limit") && line.ends_with(DEFAULT);
    let lines = resolved.lines().filter(|line| !limit(line));
    let mut case: Table = lines.collect::<Vec<_>>().join("\n").parse().ok()?;
    case.remove("output");
    let limit = (!limited).then_some(("clamp", &["time_limit"][..]));
    for (table, keys) in OF_CELLS.into_iter().chain(limit) {
        if let Some(table) = case.get_mut(table).and_then(Value::as_table_mut) {
            table.retain(|key, _| !keys.contains(&key));
        }
    }
    case.iter_mut()
        .for_each(|(_, value)| in_metres(value, cell_m));
    Some(case)
}

/// Converts lengths to metres with five digits; further digits are rounding.
fn in_metres(value: &mut Value, cell_m: f64) {
    match value {
        Value::String(text) => {
            let cells = text.trim().strip_suffix("cell");
            let cells = cells.and_then(|cells| cells.trim().parse::<f64>().ok());
            let length = || text.parse::<Quantity<Length>>().ok().map(Quantity::si);
            if let Some(metres) = cells.map(|cells| cells * cell_m).or_else(length) {
                *text = format!("{metres:.4e} m");
            }
        }
        Value::Array(list) => list.iter_mut().for_each(|value| in_metres(value, cell_m)),
        Value::Table(table) => {
            (table.iter_mut()).for_each(|(_, value)| in_metres(value, cell_m));
        }
        _ => {}
    }
}

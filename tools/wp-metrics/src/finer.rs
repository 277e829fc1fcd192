//! Error of a state's numbers by the same run in smaller cells.

use std::fs;
use std::path::{Path, PathBuf};

use cli::Failure;
use metrics::table::PenetrationRows;
use metrics::{
    Datum, LEAST_RATIO, State, case_without_cells, cell_error, extrapolated, penetration,
};
use toml::Table;

use crate::arguments::Arguments;
use crate::input::Input;

/// What `mpm-run` calls the pressure on the body that the clamp drives, Pa.
pub const PRESSURE: &str = "pressure_pa";

/// Adds what the same run in smaller cells says of the error of `rows`.
pub fn carry_on(
    rows: &mut PenetrationRows,
    input: &Input,
    finer: &Input,
    arguments: &Arguments,
) -> Result<(), Failure> {
    let cells = [input.noted("cell_m")?, finer.noted("cell_m")?];
    let ratio = cells[0] / cells[1];
    // A hair for the rounding of lengths written as text.
    if ratio.is_nan() || ratio < LEAST_RATIO * (1.0 - 1e-6) {
        return Err(Failure::usage(format!(
            "'{}' has cells of {:.4} um and '{}' of {:.4} um: --finer needs cells at least {LEAST_RATIO} times smaller",
            input.name,
            1e6 * cells[0],
            finer.name,
            1e6 * cells[1]
        )));
    }
    let (state, fine) = (
        input.state(arguments.normal)?,
        finer.state(arguments.normal)?,
    );
    if !same_bond(&state, &fine) {
        return Err(Failure::usage(format!(
            "'{}' and '{}' are of different bonds: --finer needs the same run with smaller cells",
            input.name, finer.name
        )));
    }
    if let Some(table) = other_table([&input.name, &finer.name], cells) {
        return Err(Failure::usage(format!(
            "the cases of '{}' and '{}' differ in [{table}]: --finer needs the same run with smaller cells",
            input.name, finer.name
        )));
    }
    let times = [input.time_s(), finer.time_s()];
    if (times[0] - times[1]).abs() > 1e-6 * times[0] && !closed_alike(&state, &fine) {
        return Err(Failure::usage(format!(
            "'{}' is of {:.4e} s and '{}' of {:.4e} s, and their clamps have different travels: --finer needs the same state of the same run with smaller cells",
            input.name, times[0], finer.name, times[1]
        )));
    }
    let datum = Datum::find(arguments.reference, &fine).map_err(|e| finer.failure(&e))?;
    let sides = cell_error(&rows.sides, &penetration(&fine, &datum), ratio);
    let pressure = extrapolated(input.noted(PRESSURE)?, finer.noted(PRESSURE)?, ratio);
    rows.cell_error = Some((sides, pressure));
    Ok(())
}

/// A table in which the cases of two runs differ by more than cells of these edges (m), where both lie with their states.
fn other_table(states: [&str; 2], cells: [f64; 2]) -> Option<String> {
    let case = |side: usize| -> Option<Table> {
        let mut texts = cases(Path::new(states[side])).map(fs::read_to_string);
        case_without_cells(&texts.find_map(Result::ok)?, cells[side], false)
    };
    let (run, finer) = (case(0)?, case(1)?);
    let mut tables = run.keys().chain(finer.keys());
    tables.find(|key| run.get(*key) != finer.get(*key)).cloned()
}

/// Where the case of a state may lie.
pub fn cases(state: &Path) -> impl Iterator<Item = PathBuf> {
    let folders = state.ancestors().skip(1).take(2);
    folders.map(|folder| folder.join("resolved.toml"))
}

/// Whether two states have the same wood, wherever it is now.
fn same_bond<'a>(a: &State<'a>, b: &State<'a>) -> bool {
    let wood = |state| State::wood_blocks(state).map(|w| (w.bits, w.voxel_m));
    wood(a).eq(wood(b))
}

/// Whether the wood of two states lies in the same places, to a thousandth of a voxel.
fn closed_alike(a: &State, b: &State) -> bool {
    let pairs = a.wood_blocks().zip(b.wood_blocks());
    let mut ways =
        pairs.flat_map(|(a, b)| (0..3).map(move |i| (a.origin_m[i] - b.origin_m[i]).abs()));
    ways.all(|way| way <= 1e-3 * a.voxel_m)
}

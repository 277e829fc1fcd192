//! Results of a run, as cells of a row.

use std::fs;
use std::path::Path;

use cli::{Failure, Output};
use metrics::{Datum, Penetration, Reference, State, penetration};
use particle_file::ParticleFile;
use serde_json::Value;

/// The columns of a result. All numbers are of the run's end; penetration is measured from midway
/// between the adherends, as by `wp-metrics`; `entered_share` and `mean_depth_um` of both sides below the surfaces.
pub const COLUMNS: [&str; 17] = [
    "status",
    "said",
    "end",
    "wp_bottom_um",
    "wp_top_um",
    "wp_um",
    "slab_wp_um",
    "ep_um",
    "max_depth_um",
    "volume_um3",
    "pressure_pa",
    "gap_um",
    "time_s",
    "steps",
    "entered_share",
    "mean_depth_um",
    "gap_share",
];

/// The file of a run that holds its row. It is the sign that the run need not be started again.
pub const FILE: &str = "row.csv";

/// The row of the run in `folder` that ended `sound` or otherwise, for the reason `said`. Of a run that is not sound only
/// the reason is a cell: a number that cannot be relied on is none. A final state or a summary that cannot be read is refused.
pub fn of_run(folder: &Path, status: &str, said: &str) -> Result<Vec<String>, Failure> {
    let numbers = match status {
        "sound" => numbers(folder)?,
        _ => [const { String::new() }; COLUMNS.len() - 2],
    };
    let mut cells = vec![status.to_owned(), cli::cell(said).into_owned()];
    cells.extend(numbers);
    Ok(cells)
}

fn numbers(folder: &Path) -> Result<[String; COLUMNS.len() - 2], Failure> {
    let place = folder.join("final.mpts");
    let file = ParticleFile::open(&place).map_err(Failure::data)?;
    let wrong = |e: metrics::Error| Failure::data(format!("'{}': {e}", place.display()));
    let state = State::of_file(&file).map_err(wrong)?;
    let datum = Datum::find(Reference::Mid, &state).map_err(wrong)?;
    let sides = penetration(&state, &datum);
    let [bottom, top, total] = &sides;
    let summary = folder.join("summary.json");
    let missing =
        |what: &str| Failure::data(format!("'{}' does not say {what}", summary.display()));
    let said = |key: &str| field(&summary, key).ok_or_else(|| missing(key));
    let si = |key: &str| said(key)?.as_f64().ok_or_else(|| missing(key));
    let um = |metres: f64| format!("{:.6}", 1e6 * metres);
    let wp = |side: &Penetration| um(side.wp_m);
    Ok([
        said("end")?.as_str().unwrap_or_default().to_owned(),
        wp(bottom),
        wp(top),
        wp(total),
        um(total.slab_wp_m),
        um(total.ep_m),
        um(total.max_depth_m),
        format!("{:.4}", 1e18 * total.volume_m3),
        format!("{:.6e}", si("final_pressure_pa")?),
        um(si("gap_m")?),
        format!("{:.9e}", si("time_s")?),
        said("steps")?.to_string(),
        format!("{:.6}", total.entered_share),
        um(total.mean_depth_m),
        format!("{:.6}", si("gap_m")? / (si("gap_m")? + si("travel_m")?)),
    ])
}

/// A field of a JSON file.
pub fn field(path: &Path, key: &str) -> Option<Value> {
    let text = fs::read_to_string(path).ok()?;
    let mut whole: Value = serde_json::from_str(&text).ok()?;
    whole.get_mut(key).map(Value::take)
}

/// Writes the row of a run.
pub fn write(place: &Path, cells: &[String]) -> Result<(), Failure> {
    let mut table = csv::Writer::from_writer(Vec::new());
    let whole = (table.write_record(COLUMNS)).and_then(|()| table.write_record(cells));
    let text = text(table, whole)?;
    Output::File(place.to_owned()).write(|out| out.write_all(&text))
}

/// The text of a table that was written into memory.
pub fn text(table: csv::Writer<Vec<u8>>, written: csv::Result<()>) -> Result<Vec<u8>, Failure> {
    let whole = written.map_err(|e| e.to_string());
    let text = whole.and_then(|()| table.into_inner().map_err(|e| e.to_string()));
    text.map_err(|e| Failure::failed(format!("cannot write a table: {e}")))
}

/// The row of a run; none where it has not ended. A file that is no row is damaged (exit 3).
pub fn read(place: &Path) -> Result<Option<csv::StringRecord>, Failure> {
    let broken = |why: &dyn std::fmt::Display| {
        Failure::data(format!("'{}' is not a sweep row: {why}", place.display()))
    };
    let text = match fs::read(place) {
        Err(e) if e.kind() == std::io::ErrorKind::NotFound => return Ok(None),
        read => read.map_err(|e| broken(&e))?,
    };
    let mut table = csv::Reader::from_reader(text.as_slice());
    let header = table.headers().map_err(|e| broken(&e))?;
    if header != COLUMNS.as_slice() {
        return Err(broken(&"its columns are different"));
    }
    match table.records().next() {
        Some(row) => row.map(Some).map_err(|e| broken(&e)),
        None => Err(broken(&"it is empty")),
    }
}

//! The results of a sweep as one table.

use std::path::{Path, PathBuf};

use cli::{Failure, InputRecord, Output, Record, Status};
use csv::StringRecord;

use crate::plan::{self, Plan, VERSION};
use crate::row;

/// Most rows that a message names.
const NAMED: usize = 8;

/// Writes the table of the sweep in `folder`: row, inputs, results. Neither time nor place of the
/// runs is in it, so that the same sweep gives the same bytes; what they cost goes to `cost`. Exit 75 where a row has no
/// result yet; exit 3 for a damaged one.
pub fn collect(folder: &Path, output: &Output, cost: Option<&Output>) -> Result<(), Failure> {
    let plan = Plan::read(folder)?;
    let place = folder.join(plan::PLAN);
    let record = Record::new(
        env!("CARGO_PKG_NAME"),
        VERSION,
        vec![InputRecord::of_file(&place, place.display().to_string())?],
    );
    let read = plan.sources(folder);
    let read = read.iter().map(PathBuf::as_path);
    cli::keep_apart_with_records(read, [output].into_iter().chain(cost))?;
    let mut rows = Vec::new();
    let mut missing = Vec::new();
    for (i, planned) in plan.rows.iter().enumerate() {
        let found = row::read(&plan::run_folder(folder, &planned.run).join(row::FILE))?;
        match found {
            Some(found) => rows.push(found),
            None => missing.push(i + 1),
        }
    }
    if !missing.is_empty() {
        return Err(Failure::new(
            Status::Resumable,
            format!(
                "{}: {} of {} rows have no result yet: {}",
                folder.display(),
                missing.len(),
                plan.rows.len(),
                named(&missing)
            ),
        ));
    }
    let text = results(&plan, &rows)?;
    output.write_with_record(&record, |out| out.write_all(&text))?;
    if let Some(cost) = cost {
        let text = costs(&plan, folder)?;
        cost.write_with_record(&record, |out| out.write_all(&text))?;
    }
    report(&rows);
    Ok(())
}

/// `row`, the inputs, the results.
fn results(plan: &Plan, rows: &[StringRecord]) -> Result<Vec<u8>, Failure> {
    let mut table = csv::Writer::from_writer(Vec::new());
    let header = ["row"]
        .into_iter()
        .chain(plan.inputs.iter().map(String::as_str));
    let mut whole = table.write_record(header.chain(row::COLUMNS));
    for (i, (planned, found)) in plan.rows.iter().zip(rows).enumerate() {
        let number = (i + 1).to_string();
        let inputs = planned.inputs.iter().map(|cell| cli::cell(cell));
        let cells = [number.into()].into_iter().chain(inputs);
        let cells = cells.chain(found.iter().map(Into::into));
        whole = whole.and_then(|()| table.write_record(cells.map(|cell| cell.into_owned())));
    }
    row::text(table, whole)
}

/// `row,run,steps,cpu_s,stepping_wall_s,threads,peak_memory_bytes` of the process that ended each
/// run; empty for runs that failed.
fn costs(plan: &Plan, folder: &Path) -> Result<Vec<u8>, Failure> {
    let keys = [
        "steps",
        "cpu_s",
        "stepping_wall_s",
        "threads",
        "peak_memory_bytes",
    ];
    let mut table = csv::Writer::from_writer(Vec::new());
    let mut whole = table.write_record(["row", "run"].into_iter().chain(keys));
    for (i, planned) in plan.rows.iter().enumerate() {
        let summary = plan::run_folder(folder, &planned.run).join("summary.json");
        let cells = keys.map(|key| {
            let value = row::field(&summary, key).filter(|v| !v.is_null());
            value.map_or(String::new(), |v| v.to_string())
        });
        let own = [(i + 1).to_string(), planned.run.clone()];
        whole = whole.and_then(|()| table.write_record(own.into_iter().chain(cells)));
    }
    row::text(table, whole)
}

/// Says which rows have no numbers.
fn report(rows: &[StringRecord]) {
    let failed = (1..)
        .zip(rows)
        .filter(|(_, row)| row.get(0) != Some("sound"));
    let failed: Vec<usize> = failed.map(|(i, _)| i).collect();
    if !failed.is_empty() {
        cli::warn(format_args!(
            "{} of {} rows failed or are not sound, and have the reason instead of numbers: {}",
            failed.len(),
            rows.len(),
            named(&failed)
        ));
    }
}

fn named(rows: &[usize]) -> String {
    let named: Vec<String> = rows.iter().take(NAMED).map(ToString::to_string).collect();
    let more = if rows.len() > NAMED { " ..." } else { "" };
    format!("row {}{more}", named.join(", "))
}

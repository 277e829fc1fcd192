//! `crash.csv` and `crash.md`.

use std::fmt::Write;

use super::Row;
use crate::Result;
use crate::study::{Study, table};

/// Writes the table and the page; `left_out` is what could not be done.
pub(super) fn write(study: &Study, rows: &[Row], left_out: &[&str]) -> Result<()> {
    let fields = rows.iter().map(|row| {
        let [trials, wrong] = [row.trials, row.wrong.len()].map(|count| count.to_string());
        vec![
            row.series.into(),
            row.scheme.into(),
            row.fault.into(),
            trials,
            wrong,
        ]
    });
    study.write_csv("crash.csv", "series,scheme,fault,trials,wrong", fields)?;
    study.write("crash.md", page(rows, study.origin(), left_out))
}

fn page(rows: &[Row], origin: &str, left_out: &[&str]) -> String {
    let mut text = format!(
        "# Runs that are killed\n\n{origin}.\n\n\
         A run of about thirty steps of each scheme is killed (SIGKILL), or a call of it fails (no space left,\n\
         or an error of the disk), at every open, write, rename, sync, truncation, removal, mkdir and lock in\n\
         turn. Then the same command is given once more. A trial is as it must be when all files of the run\n\
         folder are byte for byte those of the run in one piece, the costs in `summary.json` aside, and none is left over.\n\
         Runs are also killed or told to stop (SIGTERM) six times at places drawn by chance, the disk is full at each byte of\n\
         the last row (a limit on the size of files), and a second run is started into the folder.\n\
         Calls that fail may end the run with status 1, 75, for files that cannot be opened 2 or 3, or, where nothing depends on them, 0.\n\n"
    );
    let line = |row: &Row| {
        let (trials, right) = (row.trials, row.trials - row.wrong.len());
        let (series, scheme, fault) = (row.series, row.scheme, row.fault);
        format!("| {series} | {scheme} | {fault} | {trials} | {right} |")
    };
    let heads = "| series | scheme | fault | trials | as they must be |";
    text += &table(heads, rows.iter().map(line));
    let trials: usize = rows.iter().map(|row| row.trials).sum();
    let wrong: usize = rows.iter().map(|row| row.wrong.len()).sum();
    let _ = writeln!(text, "\n{trials} trials, {wrong} wrong.");
    for row in rows {
        let (series, scheme, fault) = (row.series, row.scheme, row.fault);
        for said in &row.wrong {
            let _ = writeln!(text, "- {series}, {scheme}, {fault}: {said}");
        }
    }
    for what in left_out {
        let _ = writeln!(text, "\nNot done: {what}.");
    }
    text
}

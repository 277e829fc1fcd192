//! `crash.csv` and `crash.md`.

use std::fmt::Write;

use super::Row;
use crate::Result;
use crate::study::{Study, filled, table};

/// Writes the table and the page; `left_out` is what could not be done.
pub(super) fn write(study: &Study, rows: &[Row], left_out: &[&str]) -> Result<()> {
    let fields = rows.iter().map(|row| {
        let [trials, wrong] = [row.trials, row.wrong.len()].map(|count| count.to_string());
        let words = [row.series, row.scheme, row.fault, &trials, &wrong];
        words.map(String::from).to_vec()
    });
    study.write_csv("crash.csv", "series,scheme,fault,trials,wrong", fields)?;
    study.write("crash.md", page(rows, study.origin(), left_out))
}

fn page(rows: &[Row], origin: &str, left_out: &[&str]) -> String {
    let line = |row: &Row| {
        let (trials, right) = (row.trials, row.trials - row.wrong.len());
        let (series, scheme, fault) = (row.series, row.scheme, row.fault);
        format!("| {series} | {scheme} | {fault} | {trials} | {right} |")
    };
    let heads = "| series | scheme | fault | trials | correct |";
    let trials: usize = rows.iter().map(|row| row.trials).sum();
    let wrong: usize = rows.iter().map(|row| row.wrong.len()).sum();
    let values = [
        ("origin", origin),
        ("table", &table(heads, rows.iter().map(line))),
        ("trials", &trials.to_string()),
        ("wrong", &wrong.to_string()),
    ];
    let mut text = filled(include_str!("page.txt"), &values);
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

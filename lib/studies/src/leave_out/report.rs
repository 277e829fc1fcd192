//! `leave-out.csv` and `leave-out.md`.

use std::fmt::Write;

use super::{CONTROL, Measured, Row};

/// What a scene may pay for a feature it does not use.
const ALLOWED: f64 = 0.02;

const INTRODUCTION: &str = "# What a scene pays for what it does not use

";

const HEAD: &str = "Each row compares the committed build with one from which \
`pipelines/leave-out/<feature>.patch` removed a feature's code, on a scene that does not use it: a drop in free \
flight (explicit, FLIP, 3D, or plane strain for the third dimension) or a piston in a slit of twelve cells \
(implicit). One thread, CPU time of the whole process, the two in turn (A B B A ...). Ratio: full build over the one \
without, so 1.02 is 2 % paid; median and quartiles of the pairs, the ratio of the two fastest runs and, where valgrind is installed, that of the \
instructions of a few steps, which no neighbour disturbs. The goal is 2 %. The first row is the same binary twice: \
what the machine's noise makes of 1.
";

/// The rows as CSV.
pub fn csv(rows: &[Row]) -> String {
    let mut out = String::from(
        "feature,scene,pairs,cpu_s,ratio_lower_quartile,ratio_median,ratio_upper_quartile,ratio_of_fastest,ratio_of_instructions,sentence\n",
    );
    for row in rows {
        let (name, scene) = (row.feature.name, row.feature.bench.name());
        // Writing to a string cannot fail.
        let _ = match &row.measured {
            Ok(measured) => {
                let pairs = &measured.pairs;
                let [low, median, high] = pairs.quartiles();
                writeln!(
                    out,
                    "{name},\"{scene}\",{},{:.3},{low:.4},{median:.4},{high:.4},{:.4},{},",
                    pairs.0.len(),
                    pairs.seconds(),
                    pairs.of_fastest(),
                    instructions(measured, "")
                )
            }
            Err(said) => writeln!(
                out,
                "{name},\"{scene}\",,,,,,,,\"{}\"",
                said.replace('"', "'")
            ),
        };
    }
    out
}

/// The rows as a page; `origin` says what made it, when and where.
pub fn page(rows: &[Row], origin: &str) -> String {
    let mut out = format!("{INTRODUCTION}{origin}.\n{HEAD}\n");
    out.push_str("| feature | removed | scene | CPU (s) | median | quartiles | fastest | instructions | within 2 % |\n|---|---|---|---|---|---|---|---|---|\n");
    for row in rows {
        let feature = &row.feature;
        let _ = write!(
            out,
            "| {} | {} | {} | ",
            feature.name,
            feature.what,
            feature.bench.name()
        );
        let _ = match &row.measured {
            Ok(measured) => {
                let pairs = &measured.pairs;
                let [low, median, high] = pairs.quartiles();
                let fastest = pairs.of_fastest();
                let verdict = match (
                    feature.name == CONTROL,
                    median - 1.0 <= ALLOWED,
                    fastest - 1.0 <= ALLOWED,
                ) {
                    (true, ..) => "",
                    (_, true, true) => "yes",
                    (_, false, false) => "**no**",
                    _ => "by one of the two",
                };
                writeln!(
                    out,
                    "{:.2} | {median:.3} | {low:.3} to {high:.3} | {fastest:.3} | {} | {verdict} |",
                    pairs.seconds(),
                    instructions(measured, "-")
                )
            }
            Err(_) => writeln!(out, "not measured | | | | | |"),
        };
    }
    for row in rows {
        if let Err(said) = &row.measured {
            let _ = writeln!(out, "\nNot measured: {}: {said}", row.feature.name);
        }
    }
    out
}

/// Ratio of the instructions, or `none` where they were not counted.
fn instructions(measured: &Measured, none: &str) -> String {
    measured
        .instruction_ratio()
        .map_or(none.to_owned(), |ratio| format!("{ratio:.4}"))
}

/// One line for the terminal.
pub fn line(row: &Row) -> String {
    let name = row.feature.name;
    match &row.measured {
        Ok(measured) => {
            let pairs = &measured.pairs;
            let [low, median, high] = pairs.quartiles();
            format!(
                "{name:<26} {:.2} s, full over without: {median:.3} ({low:.3} to {high:.3}), fastest {:.3}, instructions {}",
                pairs.seconds(),
                pairs.of_fastest(),
                instructions(measured, "not counted")
            )
        }
        Err(said) => format!("{name:<26} not measured: {said}"),
    }
}

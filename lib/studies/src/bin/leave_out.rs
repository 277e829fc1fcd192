//! `make leave-out`: what a scene pays for features it does not use.

#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "prints for developers"
)]

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use studies::leave_out::builds::Builds;
use studies::leave_out::{CONTROL, FEATURES, Feature, Measured, Row, instructions, pairs, report};
use studies::study::origin;

/// Pairs of runs per feature.
const PAIRS: usize = 11;

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let [patches, results, only @ ..] = words.as_slice() else {
        eprintln!("usage: leave_out PATCH_FOLDER RESULT_FOLDER [PART_OF_NAME...]");
        return ExitCode::from(2);
    };
    match study(Path::new(patches), Path::new(results), only) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => {
            eprintln!("leave_out: not all features could be measured");
            ExitCode::FAILURE
        }
        Err(said) => {
            eprintln!("leave_out: {said}");
            ExitCode::FAILURE
        }
    }
}

/// Measures the features whose names contain one of `only`, or all; says whether all could be.
fn study(patches: &Path, results: &Path, only: &[&str]) -> Result<bool, String> {
    let out = PathBuf::from("out/leave-out");
    let builds = Builds::new(&out, patches)?;
    let full = builds.full()?;
    let mut rows = Vec::new();
    for feature in FEATURES {
        if only.is_empty() || only.iter().any(|part| feature.name.contains(part)) {
            let row = Row {
                feature: *feature,
                measured: measured(feature, &builds, &full, &out),
            };
            println!("{}", report::line(&row));
            rows.push(row);
        }
    }
    let write = |name: &str, text: &str| {
        let path = results.join(name);
        std::fs::write(&path, text).map_err(|e| format!("{}: {e}", path.display()))
    };
    write("leave-out.csv", &report::csv(&rows))?;
    write(
        "leave-out.md",
        &report::page(&rows, &origin("make leave-out")),
    )?;
    Ok(rows.iter().all(|row| row.measured.is_ok()))
}

fn measured(
    feature: &Feature,
    builds: &Builds,
    full: &Path,
    out: &Path,
) -> Result<Measured, String> {
    let less = if feature.name == CONTROL {
        full.to_owned()
    } else {
        builds.without(feature.name)?
    };
    let case = feature.bench.write(&out.join("cases"))?;
    let (programs, run) = ([full, &less], out.join("run"));
    Ok(Measured {
        pairs: pairs::measure(programs, &case, &run, PAIRS)?,
        instructions: instructions::count(programs, &case, &run, feature.bench.few_steps_us()),
    })
}

//! `make tradeoff`: error against CPU time over schemes and settings; writes a CSV, a figure, a
//! page, and the table that `mpm-run --explain` quotes from.

#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "prints for developers"
)]

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use studies::study::Folders;
use studies::tradeoff::{bond, boxes, mark_front, report, settings};

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [results, quoted, double] = words.as_slice() else {
        eprintln!("usage: tradeoff RESULT_FOLDER QUOTED_CSV MPM_RUN_IN_DOUBLE_PRECISION");
        return ExitCode::from(2);
    };
    match study(Path::new(results), Path::new(quoted), Path::new(double)) {
        Ok(()) => ExitCode::SUCCESS,
        Err(said) => {
            eprintln!("tradeoff: {said}");
            ExitCode::FAILURE
        }
    }
}

fn study(results: &Path, quoted: &Path, double: &Path) -> Result<(), String> {
    let settings = settings::all(double);
    let out = PathBuf::from("out/tradeoff");
    let mut rows = bond::rows(&settings, &out.join("bond"))?;
    let folders = Folders {
        cases: out.join("cases"),
        runs: out.join("runs"),
    };
    let (more, outcomes) = boxes(&settings, &folders);
    rows.extend(more);
    mark_front(&mut rows);
    report::write(results, quoted, &rows, &outcomes)
}

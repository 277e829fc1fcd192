//! `make load-control`: the implicit scheme's clamp at a pressure limit.

#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "prints for developers"
)]

use std::path::Path;
use std::process::ExitCode;

use studies::load_control::{report, rows};
use studies::study::origin;

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let [results, only @ ..] = words.as_slice() else {
        eprintln!("usage: load_control RESULT_FOLDER [PART_OF_NAME...]");
        return ExitCode::from(2);
    };
    match study(Path::new(results), only) {
        Ok(sound) => ExitCode::from(u8::from(!sound)),
        Err(said) => {
            eprintln!("load_control: {said}");
            ExitCode::FAILURE
        }
    }
}

/// Runs the study, writes its page and says whether all is as it should be.
fn study(results: &Path, only: &[&str]) -> Result<bool, String> {
    let rows = rows(only, Path::new("out/load-control"))?;
    let head = format!(
        "{}, runs of one thread each.\n",
        origin("make load-control")
    );
    let page = report::page(&rows, &head);
    print!("{page}");
    for (name, text) in [
        ("load-control.csv", report::csv(&rows)),
        ("load-control.md", page),
    ] {
        let path = results.join(name);
        std::fs::write(&path, text).map_err(|e| format!("{}: {e}", path.display()))?;
    }
    Ok(report::sound(&rows))
}

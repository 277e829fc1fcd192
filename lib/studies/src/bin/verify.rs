//! `make verify`: every verification scene by every scheme and update that applies, against its
//! closed form or reference; writes case files, a CSV, plots and a page.

#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "prints for developers"
)]

use std::path::PathBuf;
use std::process::ExitCode;

use studies::study::{Folders, Job, run_all};
use studies::verification::{catalogue, plots, report};

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [results, only @ ..] = words.as_slice() else {
        eprintln!("usage: verify RESULT_FOLDER [NAME_PART...]");
        return ExitCode::from(2);
    };
    match study(results.into(), only) {
        Ok(0) => ExitCode::SUCCESS,
        Ok(failed) => {
            eprintln!("verify: {failed} runs failed");
            ExitCode::FAILURE
        }
        Err(said) => {
            eprintln!("verify: {said}");
            ExitCode::FAILURE
        }
    }
}

/// Runs everything whose name contains one of `only`; returns how many runs failed.
fn study(results: PathBuf, only: &[String]) -> Result<usize, String> {
    let wanted = |name: &str| only.is_empty() || only.iter().any(|part| name.contains(part));
    let entries: Vec<_> = catalogue::all()
        .into_iter()
        .filter(|(scene, _)| wanted(&scene.name))
        .collect();
    let jobs: Vec<Job> = entries
        .iter()
        .flat_map(|(scene, methods)| {
            let methods = methods.iter().cloned();
            methods.map(move |method| Job { scene, method })
        })
        .collect();
    let folders = Folders {
        cases: PathBuf::from("out/verify/cases"),
        runs: PathBuf::from("out/verify"),
    };
    let outcomes = run_all(&jobs, &folders);
    report::write(&results, &entries, &outcomes)?;
    plots::write(&results, &outcomes)?;
    Ok(outcomes.iter().filter(|o| o.measured.is_err()).count())
}

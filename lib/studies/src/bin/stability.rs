//! `make stability`: stiff and extreme cases by both schemes. `make options`: what the options of
//! the explicit scheme that are not the paper's change.

#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "prints for developers"
)]

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use studies::stability::trial::{Row, Trial, Verdict};
use studies::stability::{instability, options, plan, report};
use studies::study::{Folders, origin, provenance};

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let done = match words.as_slice() {
        ["scenes", results, only @ ..] => scenes(Path::new(results), only),
        ["options", results, only @ ..] => {
            explicit_options(Path::new(results), only).map(|()| true)
        }
        _ => {
            eprintln!("usage: stability scenes|options RESULT_FOLDER [PART_OF_NAME...]");
            return ExitCode::from(2);
        }
    };
    match done {
        Ok(sound) => ExitCode::from(u8::from(!sound)),
        Err(said) => {
            eprintln!("stability: {said}");
            ExitCode::FAILURE
        }
    }
}

fn write(path: &Path, text: &str) -> Result<(), String> {
    std::fs::write(path, text).map_err(|e| format!("{}: {e}", path.display()))
}

/// Runs all trials, or those whose varied quantity or value contains one of `only`, and says
/// whether none was broken.
fn scenes(results: &Path, only: &[&str]) -> Result<bool, String> {
    let trials: Vec<Trial> = (plan::trials().into_iter())
        .filter(|t| {
            let named = |part: &&str| t.varied.contains(*part) || t.value.contains(*part);
            only.is_empty() || only.iter().any(named)
        })
        .collect();
    let folder = Path::new("out/stability");
    let rows = run_all(trials, folder)?;
    let cpu: f64 = rows.iter().map(|r| r.cpu_s).filter(|s| s.is_finite()).sum();
    let head = format!(
        "{}, {} runs of one thread each, {cpu:.0} CPU seconds in those that ended.\n",
        origin("make stability"),
        rows.len()
    );
    write(&results.join("stability.csv"), &report::csv(&rows))?;
    let unstable: Vec<_> = (instability::trials().iter().enumerate())
        .filter(|(_, trial)| only.is_empty() || only.contains(&trial.scene))
        .map(|(i, trial)| trial.run(&folder.join(format!("checkpoint-{i}"))))
        .collect();
    let page = report::page(&rows, &head) + &instability::section(&unstable);
    write(&results.join("stability.md"), &page)?;
    let broken = |row: &Row| matches!(row.verdict, Verdict::Broken(_));
    Ok(!rows.iter().any(broken) && unstable.iter().all(Result::is_ok))
}

/// Runs the trials two at a time, one thread each, and gives their rows in order.
fn run_all(trials: Vec<Trial>, folder: &Path) -> Result<Vec<Row>, String> {
    let next = AtomicUsize::new(0);
    let done: Mutex<Vec<(usize, Result<Row, String>)>> = Mutex::new(Vec::new());
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|| {
                loop {
                    let i = next.fetch_add(1, Ordering::Relaxed);
                    let Some(trial) = trials.get(i) else { return };
                    let row = trial.clone().run(folder);
                    if let Ok(row) = &row {
                        say(row);
                    }
                    if let Ok(mut done) = done.lock() {
                        done.push((i, row));
                    }
                }
            });
        }
    });
    let mut done = done.into_inner().unwrap_or_default();
    done.sort_by_key(|(i, _)| *i);
    done.into_iter().map(|(_, row)| row).collect()
}

fn say(row: &Row) {
    let trial = &row.trial;
    println!(
        "{:<22} {:<30} {:<9} {:>5} {:?} energy {:.2e} J {:.3} to {:.3} balance {:+.1e} {:.1} s",
        trial.varied,
        trial.value,
        trial.method.label,
        trial.cfl,
        row.verdict,
        row.energy,
        row.j[0],
        row.j[1],
        row.balance,
        row.cpu_s
    );
}

/// Runs the options' scenes and prints the tables.
fn explicit_options(results: &Path, only: &[&str]) -> Result<(), String> {
    let folders = Folders {
        cases: PathBuf::from("out/options/cases"),
        runs: PathBuf::from("out/options"),
    };
    let outcomes = options::outcomes(&folders, only);
    write(
        &results.join("explicit-options.csv"),
        &options::csv(&outcomes),
    )?;
    println!(
        "{}{}",
        provenance("make options", &outcomes),
        options::table(&outcomes)
    );
    Ok(())
}

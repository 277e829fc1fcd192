//! `make crash`: runs killed at every call by which they change their folder, and what becomes of
//! them when they go on.

#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "prints for developers"
)]

use std::path::Path;
use std::process::ExitCode;

use studies::crash::{Row, campaign, chains, faults, full_disk, report, together};
use studies::study::origin;

/// Rounds of two runs into one folder.
const ROUNDS: usize = 100;
/// Runs of each scheme that are interrupted several times.
const CHAINS: u64 = 100;

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let [results] = words.as_slice() else {
        eprintln!("usage: crash RESULT_FOLDER");
        return ExitCode::from(2);
    };
    match study(Path::new(results)) {
        Ok(sound) => ExitCode::from(u8::from(!sound)),
        Err(said) => {
            eprintln!("crash: {said}");
            ExitCode::FAILURE
        }
    }
}

/// Makes all trials and writes the tables; whether all ended as they must.
fn study(results: &Path) -> Result<bool, String> {
    let tell = |row: &Row| println!("{}", row.line());
    let (mut rows, mut left_out) = (Vec::new(), Vec::new());
    for row in [together::at_once(ROUNDS)?, together::meanwhile(ROUNDS)?] {
        tell(&row);
        rows.push(row);
    }
    if full_disk::available() {
        rows.extend(full_disk::rows(1, tell)?);
    } else {
        left_out.push("the full disk, as `prlimit` is not installed");
    }
    if faults::available() {
        rows.extend(campaign::rows(1, tell)?);
        rows.extend(chains::rows(CHAINS, tell)?);
    } else {
        left_out.push("kills and failing calls, as `strace` is not installed or may not trace");
    }
    for what in &left_out {
        eprintln!("not done: {what}");
    }
    let write = |name: &str, text: &str| {
        let path = results.join(name);
        std::fs::write(&path, text).map_err(|e| format!("{}: {e}", path.display()))
    };
    write("crash.csv", &report::csv(&rows))?;
    let head = origin("make crash") + ".\n";
    write("crash.md", &report::page(&rows, &head, &left_out))?;
    Ok(left_out.is_empty() && rows.iter().all(|row| row.wrong.is_empty()))
}

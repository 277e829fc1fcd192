//! `make verify tradeoff stability options load-control steps leave-out crash bench experiments`: one study, named as its make target.

#![allow(clippy::print_stderr, reason = "prints for developers")]

use std::path::Path;
use std::process::ExitCode;

use studies::study::Study;
use studies::{
    bench, crash, experiments, leave_out, load_control, options, stability, steps, tradeoff,
    verification,
};

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let run = match words.first().map(String::as_str) {
        Some("verify") => verification::run,
        Some("tradeoff") => tradeoff::run,
        Some("stability") => stability::run,
        Some("options") => options::run,
        Some("load-control") => load_control::run,
        Some("steps") => steps::run,
        Some("leave-out") => leave_out::run,
        Some("crash") => crash::run,
        Some("bench") => bench::run,
        Some("experiments") => experiments::run,
        _ => {
            eprintln!(
                "usage: study verify|tradeoff|stability|options|load-control|steps|leave-out|crash|bench|experiments RESULT_FOLDER [PART_OF_NAME...]"
            );
            return ExitCode::from(2);
        }
    };
    let [name, results, only @ ..] = words.as_slice() else {
        eprintln!("study: name the folder of results");
        return ExitCode::from(2);
    };
    let done = Study::begin(name, Path::new(results), only).and_then(|study| {
        let done = run(&study)?;
        study.check_only()?;
        Ok(done)
    });
    match done {
        Ok(true) => return ExitCode::SUCCESS,
        Ok(false) => eprintln!("{name}: not all is as it should be; see {results}"),
        Err(said) => eprintln!("{name}: {said}"),
    }
    ExitCode::FAILURE
}

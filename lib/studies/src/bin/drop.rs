//! `drop scheme|twin STEPS`: the free drop of `make leave-out`, to be counted and timed from outside.

#![allow(clippy::print_stderr, reason = "prints for developers")]

use std::process::ExitCode;

use studies::leave_out::drop::fly;

fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let flown = match words.as_slice() {
        [who, steps] => steps
            .parse()
            .map_err(|_| format!("'{steps}' is no number of steps"))
            .and_then(|steps| fly(who, steps)),
        _ => Err("usage: drop scheme|twin STEPS".into()),
    };
    match flown {
        Ok(()) => ExitCode::SUCCESS,
        Err(said) => {
            eprintln!("drop: {said}");
            ExitCode::from(2)
        }
    }
}

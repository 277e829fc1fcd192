//! A disk that is full at every byte of the last row, played by a limit on the size of files.

use std::fs;

use super::Row;
use super::place::Place;
use crate::Result;
use crate::method::Scheme;
use crate::study::{ended, said, works};

/// Whether the limit can be set to a byte.
pub fn available() -> bool {
    works("prlimit", &["--fsize=1", "true"])
}

/// Both schemes, at every `stride`-th byte.
pub fn rows(stride: usize) -> Result<Vec<Row>> {
    // Fewer snapshots: the limit is on every file, and only the history shall meet it.
    let more = ["--resume", "--set", "output.snapshots=0"];
    let limited = "trap '' XFSZ; exec prlimit --fsize=\"$0\" \"$@\"";
    let of_scheme = |scheme| {
        let whole = Place::new(scheme)?;
        whole.done(&more)?;
        let history = fs::read(whole.run_folder().join("history.csv"))?;
        let text = history.strip_suffix(b"\n").unwrap_or(&history);
        let start = 1 + text.iter().rposition(|&b| b == b'\n').unwrap_or(0);
        let limits: Vec<usize> = (start..history.len()).step_by(stride).collect();
        let trial = |limit: &usize| {
            let place = Place::new(scheme)?;
            let words = ["bash", "-c", limited, &limit.to_string()].map(String::from);
            let output = ended(&mut place.command(&words, &more))?;
            if output.status.code() != Some(1) || !said(&output).contains("history.csv") {
                return Err(format!("{:?}, {}", output.status, said(&output)).into());
            }
            place.ends_like(&whole, &more)
        };
        let (series, fault) = ("disk full in the last row", "short write");
        Ok(Row::new(series, scheme, fault, &limits, trial))
    };
    Scheme::ALL.into_iter().map(of_scheme).collect()
}

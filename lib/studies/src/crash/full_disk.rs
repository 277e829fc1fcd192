//! A disk that is full at every byte of the last row, played by a limit on the size of files.

use std::fs;

use super::scene::{Place, Scene, same};
use super::{Row, all_wrong};
use crate::Result;
use crate::study::{ended, said};

/// Whether the limit can be set to a byte.
pub fn available() -> bool {
    let tried = std::process::Command::new("prlimit")
        .args(["--fsize=1", "true"])
        .output();
    tried.is_ok_and(|output| output.status.success())
}

/// Both schemes, at every `stride`-th byte.
///
/// # Errors
/// What keeps the trials from being made.
pub fn rows(stride: usize, mut tell: impl FnMut(&Row)) -> Result<Vec<Row>> {
    // Fewer snapshots: the limit is on every file, and only the history shall meet it.
    let more = ["--resume", "--set", "output.snapshots=0"];
    let mut rows = Vec::new();
    for scene in Scene::ALL {
        let whole = Place::new(scene)?;
        whole.done(&more)?;
        let history = fs::read(whole.run_folder().join("history.csv"))?;
        let text = history.strip_suffix(b"\n").unwrap_or(&history);
        let start = 1 + text.iter().rposition(|&b| b == b'\n').unwrap_or(0);
        let limits: Vec<usize> = (start..history.len()).step_by(stride).collect();
        let row = Row {
            series: "disk full within the last row",
            scheme: scene.name(),
            fault: "short write",
            trials: limits.len(),
            wrong: all_wrong(&limits, |&limit| {
                let place = Place::new(scene)?;
                let words = [
                    "bash",
                    "-c",
                    "trap '' XFSZ; exec prlimit --fsize=\"$0\" \"$@\"",
                ];
                let mut words: Vec<String> = words.map(String::from).into();
                words.push(limit.to_string());
                let output = ended(&mut place.command(&words, &more))?;
                if output.status.code() != Some(1) || !said(&output).contains("history.csv") {
                    return Err(format!("{limit}: {:?}, {}", output.status, said(&output)).into());
                }
                place.done(&more)?;
                same(&whole.run_folder(), &place.run_folder())
                    .map_err(|e| format!("{limit}: {e}").into())
            }),
        };
        tell(&row);
        rows.push(row);
    }
    Ok(rows)
}

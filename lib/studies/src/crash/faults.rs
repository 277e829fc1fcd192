//! Faults at chosen system calls, by `strace --inject`.

use std::collections::HashMap;
use std::process::Output;

use super::place::Place;
use crate::Result;
use crate::study::{ended, works};

/// The calls by which a run changes or holds its folder; those a system lacks are left out.
const CALLS: &str = "openat write writev pwrite64 rename renameat renameat2 fsync fdatasync ftruncate \
                     unlink unlinkat rmdir mkdir mkdirat flock";

/// The n-th call of a name by one thread, from 1 on.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) struct Point {
    pub(super) call: String,
    nth: usize,
}

impl std::fmt::Display for Point {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} {}", self.call, self.nth)
    }
}

/// What happens at a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Fault {
    /// SIGKILL before the call.
    Kill,
    /// SIGTERM at the call.
    Terminate,
    /// The call does nothing and fails, for the reason that fits it.
    Fail,
}

impl Fault {
    fn injection(self, point: &Point) -> String {
        let what = match self {
            Fault::Kill => "signal=KILL",
            Fault::Terminate => "signal=TERM",
            Fault::Fail => match point.call.as_str() {
                "fsync" | "fdatasync" | "unlink" | "unlinkat" => "error=EIO",
                "flock" => "error=ENOLCK",
                _ => "error=ENOSPC",
            },
        };
        format!("inject={}:{what}:when={}", point.call, point.nth)
    }
}

/// Whether `strace` is there and allowed to trace.
pub fn available() -> bool {
    works("strace", &["-qq", "-o", "/dev/null", "true"])
}

/// Runs `mpm-run` in `place` with `faults`.
pub(super) fn run(place: &Place, more: &[&str], faults: &[(&Point, Fault)]) -> Result<Output> {
    strace(place, more, "/dev/null", faults)
}

/// The points of a run with `faults`, those after the last fault only, and what it wrote at each.
pub(super) fn points(
    place: &Place,
    more: &[&str],
    faults: &[(&Point, Fault)],
) -> Result<Vec<(Point, String)>> {
    strace(place, more, "trace", faults)?;
    let trace = std::fs::read(place.path().join("trace"))?;
    let trace = String::from_utf8_lossy(&trace);
    let mut counts: HashMap<(&str, &str), usize> = HashMap::new();
    let mut points = Vec::new();
    for line in trace.lines() {
        let (thread, rest) = line.split_once(' ').unwrap_or(("", line));
        let rest = rest.trim_start();
        if rest.starts_with("---") {
            points.clear();
        }
        let Some((call, arguments)) = rest.split_once('(') else {
            continue;
        };
        if !CALLS.split(' ').any(|known| known == call) {
            continue;
        }
        let nth = counts.entry((thread, call)).or_default();
        *nth += 1;
        let point = Point {
            call: call.into(),
            nth: *nth,
        };
        // Another thread's call of the same number is the same point to strace.
        if points.iter().all(|(known, _)| *known != point) {
            points.push((point, arguments.to_owned()));
        }
    }
    Ok(points)
}

fn strace(place: &Place, more: &[&str], to: &str, faults: &[(&Point, Fault)]) -> Result<Output> {
    let trace = format!("trace=?{}", CALLS.replace(' ', ",?"));
    let words = ["strace", "-f", "-qq", "-o", to, "-e", &trace];
    let mut words = words.map(String::from).to_vec();
    for (point, fault) in faults {
        words.extend(["-e".to_owned(), fault.injection(point)]);
    }
    ended(&mut place.command(&words, more))
}

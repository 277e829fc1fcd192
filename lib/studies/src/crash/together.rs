//! Two runs into one folder.

use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use super::Row;
use super::place::Place;
use crate::Result;
use crate::method::Scheme;
use crate::outputs::{Run, tool};
use crate::study::{ended, said, terminate};

const SCHEME: Scheme = Scheme::Explicit;

/// Two started at the same moment, `rounds` times: one ends well, the other exits 2.
///
/// # Errors
/// The system's reason.
pub fn at_once(rounds: usize) -> Result<Row> {
    let whole = Place::new(SCHEME)?;
    whole.done(&[])?;
    let round = || {
        let place = Place::new(SCHEME)?;
        let [one, other] = [start(&place, &[])?, start(&place, &[])?];
        let mut codes =
            [one.wait_with_output()?, other.wait_with_output()?].map(|o| o.status.code());
        codes.sort_unstable();
        if codes != [Some(0), Some(2)] {
            return Err(format!("ended with {codes:?}").into());
        }
        whole.same(&place)
    };
    Ok(Row {
        series: "two runs started at once",
        scheme: SCHEME.name(),
        fault: "second run",
        trials: rounds,
        wrong: (0..rounds)
            .filter_map(|_| Some(round().err()?.to_string()))
            .collect(),
    })
}

/// `rounds` second runs while a first one is on, by several ways and spellings: all exit 2, and the
/// first goes on undisturbed.
///
/// # Errors
/// The system's reason.
pub fn meanwhile(rounds: usize) -> Result<Row> {
    let place = Place::new(SCHEME)?;
    std::os::unix::fs::symlink("run", place.path().join("link"))?;
    // Minutes, of which the seconds of the second runs are needed.
    let long = [
        "clamp.stop=\"3 us\"",
        "integrator.cfl=0.002",
        "output.history_every=\"1e-5 us\"",
    ];
    let long: Vec<&str> = long.iter().flat_map(|change| ["--set", *change]).collect();
    let mut first = start(&place, &long)?;
    let run = Run {
        folder: place.run_folder(),
    };
    let begun = Instant::now();
    while run.rows() < 3 {
        if begun.elapsed() > Duration::from_secs(60) {
            return Err("the first run did not begin".into());
        }
        sleep(Duration::from_millis(2));
    }
    let absolute = place.run_folder().display().to_string();
    let ways: [&[&str]; 5] = [
        &[],
        &["--resume"],
        &["--overwrite"],
        &["--overwrite", "--resume", "-o", "./link/../link/"],
        &["--overwrite", "-o", &absolute],
    ];
    let mut wrong = Vec::new();
    for way in ways.iter().cycle().take(rounds) {
        let second = ended(&mut second(&place, way))?;
        let told = said(&second);
        if second.status.code() != Some(2) || !told.contains("another run is writing") {
            wrong.push(format!("{way:?}: {:?}, {told}", second.status));
        }
    }
    if let Some(ended) = first.try_wait()? {
        return Err(format!("the first run was too short: {ended}").into());
    }
    terminate(&first)?;
    let ended = first.wait_with_output()?;
    if ended.status.code() != Some(75) {
        let (status, said) = (ended.status, said(&ended));
        return Err(format!("the first run: {status:?}, {said}").into());
    }
    Ok(Row {
        series: "second run while the first is on",
        scheme: SCHEME.name(),
        fault: "second run",
        trials: rounds,
        wrong,
    })
}

fn start(place: &Place, more: &[&str]) -> Result<Child> {
    let mut command = place.command(&[], more);
    Ok((command.stdin(Stdio::null()).stderr(Stdio::piped()).spawn())?)
}

/// A run into `run`, or into the folder that `way` names.
fn second(place: &Place, way: &[&str]) -> Command {
    let mut command = tool("mpm-run");
    command
        .args(["case.toml", "--quiet"])
        .args(way)
        .current_dir(place.path());
    if !way.contains(&"-o") {
        command.args(["-o", "run"]);
    }
    command
}

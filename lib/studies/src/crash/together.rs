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
pub fn at_once(rounds: usize) -> Result<Row> {
    let whole = Place::new(SCHEME)?;
    whole.done(&[])?;
    let rounds: Vec<usize> = (0..rounds).collect();
    let series = "two runs started at once";
    Ok(Row::new(series, SCHEME, "second run", &rounds, |_| {
        let place = Place::new(SCHEME)?;
        let both = [start(&place, &[])?, start(&place, &[])?];
        let mut codes = Vec::new();
        for run in both {
            codes.push(run.wait_with_output()?.status.code());
        }
        codes.sort_unstable();
        if codes != [Some(0), Some(2)] {
            return Err(format!("ended with {codes:?}").into());
        }
        whole.same(&place)
    }))
}

/// `rounds` second runs while a first one is on, by several ways and spellings: all exit 2, and the
/// first goes on undisturbed.
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
            return Err("the first run did not start".into());
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
    let rounds: Vec<usize> = (0..rounds).collect();
    let series = "second run during the first";
    let row = Row::new(series, SCHEME, "second run", &rounds, |round| {
        let way = ways[round % ways.len()];
        let output = ended(&mut second(&place, way))?;
        let told = said(&output);
        match output.status.code() == Some(2) && told.contains("another run is writing") {
            true => Ok(()),
            false => Err(format!("{way:?}: {:?}, {told}", output.status).into()),
        }
    });
    if let Some(ended) = first.try_wait()? {
        return Err(format!("the first run was too short: {ended}").into());
    }
    terminate(&first)?;
    let ended = first.wait_with_output()?;
    if ended.status.code() != Some(75) {
        let (status, said) = (ended.status, said(&ended));
        return Err(format!("the first run: {status:?}, {said}").into());
    }
    Ok(row)
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

//! Remains of a run that becomes unstable, and whether it goes on from its last checkpoint.

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::thread::sleep;
use std::time::Duration;

use particle_file::{Kind, ParticleFile};

use super::scenes::{self, Scene, torn};
use crate::Result;
use crate::lines::Values;
use crate::method::Method;
use crate::outputs::Run;
use crate::study::{said, table, terminate, write};

/// Attempts to stop a run in time, on a machine busy with other work.
const ATTEMPTS: u32 = 5;

/// A run that becomes unstable after it was stopped once.
pub struct Trial {
    /// Name of the scene.
    pub scene: &'static str,
    case: Scene,
    method: Method,
    /// Courant number at which it becomes unstable.
    cfl: f64,
    /// Courant number at which it then goes on.
    then: f64,
    /// Steps after which it is told to stop.
    stop_after: usize,
}

/// What came of it.
#[derive(Debug)]
pub struct Row {
    /// Scene and method.
    name: String,
    /// First and second Courant number.
    pub cfl: [f64; 2],
    /// Step of the checkpoint.
    pub checkpoint: u64,
    /// Last step before the run stopped.
    pub unstable: u64,
    /// What it said.
    pub said: String,
    /// Particle files it left, all whole and with finite numbers.
    files: usize,
    /// How it went on at the second Courant number: exit status 0 and the last step, or 1 and
    /// the sentence.
    pub then: Result<u64, String>,
}

/// All trials: the press beyond its viscous limit, stopped early and late, and a liquid that
/// flies apart at any step.
pub fn trials() -> Vec<Trial> {
    // Enough cells along z that a signal comes before the instability.
    let line = Values::all("press depth=32");
    let press = scenes::of(&line[0]).expect("a scene");
    let pressed = |method: Method, stop_after| Trial {
        scene: "press",
        case: Scene {
            duration: 0.5e-6,
            ..press.clone()
        },
        method,
        cfl: 1.2,
        then: 0.5,
        stop_after,
    };
    let cavitating = Method::named("FLIP").setting("adhesive.cavitation_pressure=\"0.1 MPa\"");
    vec![
        pressed(Method::named("FLIP"), 50),
        pressed(Method::named("FLIP"), 150),
        pressed(Method::named("XPIC(5)"), 150),
        Trial {
            scene: "torn apart, 150 m/s",
            case: torn(150.0).deep(64),
            method: cavitating.called("FLIP, cavitation"),
            cfl: 0.5,
            then: 0.1,
            stop_after: 20,
        },
    ]
}

impl Trial {
    /// Runs it below `folder`.
    pub fn run(&self, folder: &Path) -> Result<Row> {
        let run = Run {
            folder: folder.join("run"),
        };
        self.stopped(folder, &run)?;
        let checkpoint = last_step(&run)?;
        let before = fs::read(run.folder.join("checkpoint.mpts"))?;

        let output = self.command(folder, self.cfl).arg("--resume").output()?;
        let said = sentence(&output);
        if output.status.code() != Some(1) {
            return Err(format!("not unstable: {:?}, {said}", output.status).into());
        }
        if fs::read(run.folder.join("checkpoint.mpts")).ok() != Some(before) {
            return Err("the checkpoint changed".into());
        }
        let files = sound_files(&run)?;
        let unstable = last_step(&run)?;

        let output = self.command(folder, self.then).arg("--resume").output()?;
        let then = match output.status.code() {
            Some(0) => Ok(last_step(&run)?),
            Some(1) => Err(sentence(&output)),
            code => return Err(format!("exit {code:?}: {}", sentence(&output)).into()),
        };
        sound_files(&run)?;
        Ok(Row {
            name: format!("{} by {}", self.scene, self.method.label),
            cfl: [self.cfl, self.then],
            checkpoint,
            unstable,
            said,
            files,
            then,
        })
    }

    /// Starts the run and stops it after some steps.
    fn stopped(&self, folder: &Path, run: &Run) -> Result<()> {
        let mut case = self.case.lasting(self.case.duration);
        // A row for each step, by which the steps taken are counted.
        case.history_every = 1e-5 * self.case.duration;
        let text = case.text(self.method.scheme.integrator());
        write(&folder.join("case.toml"), text)?;
        for _ in 0..ATTEMPTS {
            // The rows of an attempt before would have this one stopped before it can answer.
            let _ = fs::remove_dir_all(&run.folder);
            let mut child = self.command(folder, self.cfl).spawn()?;
            let ended = loop {
                match child.try_wait()? {
                    Some(status) => break status,
                    // Told again, it still stops but once.
                    None if run.rows() > self.stop_after => terminate(&child)?,
                    None => sleep(Duration::from_millis(1)),
                }
            };
            match ended.code() {
                Some(75) => return Ok(()),
                // The signal came too late.
                Some(1) => {}
                code => return Err(format!("ended with {code:?}").into()),
            }
        }
        Err(format!("unstable before it was stopped, {ATTEMPTS} times").into())
    }

    fn command(&self, folder: &Path, cfl: f64) -> Command {
        let method = (self.method.clone().setting(format!("integrator.cfl={cfl}")))
            .setting("output.snapshots=100");
        let mut command = method.command("case.toml".as_ref(), "run".as_ref());
        command.current_dir(folder).stderr(Stdio::piped());
        command
    }
}

/// The lines said but for warnings, which must be one.
fn sentence(output: &Output) -> String {
    let said = said(output);
    let lines = said.lines().filter(|line| !line.starts_with("warning"));
    lines.collect::<Vec<_>>().join(" / ")
}

fn last_step(run: &Run) -> Result<u64> {
    let [step] = run.ends(["step"])?;
    Ok(step as u64)
}

/// How many particle files the run folder holds, all whole and without a value that is not a number;
/// the history likewise.
fn sound_files(run: &Run) -> Result<usize> {
    let mut paths = vec![run.folder.join("checkpoint.mpts")];
    paths.push(run.folder.join("final.mpts"));
    paths.retain(|path| path.exists());
    let snapshots = fs::read_dir(run.folder.join("snapshots"));
    paths.extend((snapshots.into_iter().flatten().flatten()).map(|entry| entry.path()));
    for path in &paths {
        sound(path)?;
    }
    for column in ["time_s", "kinetic_energy_J", "adhesive_volume_m3"] {
        if run.history(column)?.iter().any(|x| !x.is_finite()) {
            return Err(format!("the history has a {column} that is not a number").into());
        }
    }
    Ok(paths.len())
}

fn sound(path: &Path) -> Result<()> {
    let file = ParticleFile::open(path)?;
    file.check()?;
    if file.header().kind != Kind::Checkpoint {
        return Ok(());
    }
    // Of a checkpoint `check` reads the arrays but not the numbers: the clock's may be infinite.
    for column in file.columns().filter(|c| !c.name.starts_with("run.")) {
        let single = file.column::<f32>(&column.name);
        let double = file.column::<f64>(&column.name);
        let finite = single.is_ok_and(|v| v.iter().all(|x| x.is_finite()))
            || double.is_ok_and(|v| v.iter().all(|x| x.is_finite()))
            || file.column::<u32>(&column.name).is_ok();
        if !finite {
            return Err(format!("{}: {} is not finite", path.display(), column.name).into());
        }
    }
    Ok(())
}

/// The rows as a table of the page.
pub(super) fn lines(rows: &[Result<Row>]) -> String {
    let line = |row: &Result<Row>| match row {
        Ok(row) => {
            let then = match &row.then {
                Ok(step) => format!("ended after step {step}"),
                Err(said) => format!("stopped: {said}"),
            };
            let ([cfl, smaller], name, said) = (row.cfl, &row.name, &row.said);
            let (checkpoint, unstable, files) = (row.checkpoint, row.unstable, row.files);
            format!(
                "| {name} | {cfl} | {checkpoint} | {unstable} | {files} | {said} | {smaller} | {then} |"
            )
        }
        Err(said) => format!("| BROKEN: {said} | | | | | | | |"),
    };
    let heads = "| run | CFL | checkpoint after step | last step | files left | message | resumed at CFL | result |";
    table(heads, rows.iter().map(line))
}

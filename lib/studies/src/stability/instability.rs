//! Remains of a run that becomes unstable, and whether it goes on from its last checkpoint.

use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::thread::sleep;
use std::time::Duration;

use particle_file::{Kind, ParticleFile};

use super::scenes::{Press, Scene, press, torn};
use crate::method::Method;
use crate::outputs::{Run, bin_folder};

/// Cells along z: enough points that a signal comes before the instability.
const DEPTH: u32 = 32;
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
    pub name: String,
    /// First and second Courant number.
    pub cfl: [f64; 2],
    /// Step of the checkpoint.
    pub checkpoint: u64,
    /// Last step before the run stopped.
    pub unstable: u64,
    /// What it said.
    pub said: String,
    /// Particle files it left, all whole and with finite numbers.
    pub files: usize,
    /// How it went on at the second Courant number: exit status 0 and the last step, or 1 and
    /// the sentence.
    pub then: Result<u64, String>,
}

/// All trials: the press beyond its viscous limit, stopped early and late, and a liquid that
/// flies apart at any step.
pub fn trials() -> Vec<Trial> {
    let pressed = |method: Method, stop_after| Trial {
        scene: "press",
        case: Scene {
            duration: 0.5e-6,
            ..press(Press {
                depth: DEPTH,
                ..Press::default()
            })
        },
        method,
        cfl: 1.2,
        then: 0.5,
        stop_after,
    };
    let cavitating = Method::flip().setting("adhesive.cavitation_pressure=\"0.1 MPa\"");
    vec![
        pressed(Method::flip(), 50),
        pressed(Method::flip(), 150),
        pressed(Method::xpic(5), 150),
        Trial {
            scene: "torn apart, 150 m/s",
            case: torn(150.0).deep(2 * DEPTH),
            method: cavitating.called("FLIP, cavitation"),
            cfl: 0.5,
            then: 0.1,
            stop_after: 20,
        },
    ]
}

impl Trial {
    /// Runs it below `folder`.
    ///
    /// # Errors
    /// What is not as it must be.
    pub fn run(&self, folder: &Path) -> Result<Row, String> {
        fs::create_dir_all(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
        let checkpoint = self.stopped(folder)?;
        let before = fs::read(folder.join("run/checkpoint.mpts")).map_err(|e| e.to_string())?;

        let output = self.resumed(folder, self.cfl)?;
        let said = sentence(&output);
        if output.status.code() != Some(1) {
            return Err(format!("not unstable: {:?}, {said}", output.status));
        }
        if fs::read(folder.join("run/checkpoint.mpts")).ok() != Some(before) {
            return Err("the checkpoint was touched".into());
        }
        let run = Run {
            folder: folder.join("run"),
        };
        let files = sound_files(&run)?;
        let unstable = last_step(&run)?;

        let output = self.resumed(folder, self.then)?;
        let then = match output.status.code() {
            Some(0) => Ok(last_step(&run)?),
            Some(1) => Err(sentence(&output)),
            code => return Err(format!("exit {code:?}: {}", sentence(&output))),
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

    /// Starts the run and stops it after some steps; the step of its checkpoint.
    fn stopped(&self, folder: &Path) -> Result<u64, String> {
        let case = folder.join("case.toml");
        let mut text = self.case.lasting(self.case.duration);
        // A row for each step, by which the steps taken are counted.
        text.history_every = 1e-5 * self.case.duration;
        fs::write(&case, text.text(self.method.scheme.integrator())).map_err(|e| e.to_string())?;
        for _ in 0..ATTEMPTS {
            // The rows of an attempt before would have this one stopped before it can answer.
            let _ = fs::remove_dir_all(folder.join("run"));
            let mut run = self
                .command(folder, self.cfl)
                .spawn()
                .map_err(|e| e.to_string())?;
            let history = folder.join("run/history.csv");
            let rows = || fs::read_to_string(&history).map_or(0, |text| text.lines().count());
            let ended = loop {
                match run.try_wait().map_err(|e| e.to_string())? {
                    Some(status) => break status,
                    // Told again, it still stops but once.
                    None if rows() > self.stop_after => terminate(run.id())?,
                    None => sleep(Duration::from_millis(1)),
                }
            };
            match ended.code() {
                Some(75) => {
                    return last_step(&Run {
                        folder: folder.join("run"),
                    });
                }
                // The signal came too late.
                Some(1) => {}
                code => return Err(format!("ended with {code:?}")),
            }
        }
        Err(format!("unstable before it was stopped, {ATTEMPTS} times"))
    }

    fn resumed(&self, folder: &Path, cfl: f64) -> Result<Output, String> {
        (self.command(folder, cfl).arg("--resume"))
            .output()
            .map_err(|e| e.to_string())
    }

    fn command(&self, folder: &Path, cfl: f64) -> Command {
        let mut command = Command::new(bin_folder().join("mpm-run"));
        command
            .args(["case.toml", "-o", "run", "--quiet", "--threads", "1"])
            .args(["--set", &format!("integrator.cfl={cfl}")])
            .args(["--set", "output.snapshots=100"])
            .current_dir(folder)
            .stderr(Stdio::piped());
        for change in &self.method.set {
            command.args(["--set", change]);
        }
        command
    }
}

fn terminate(id: u32) -> Result<(), String> {
    let sent = Command::new("kill")
        .args(["-TERM", &id.to_string()])
        .stderr(Stdio::null())
        .status();
    sent.map(|_| ()).map_err(|e| e.to_string())
}

/// The last line said, which must be the only one but for warnings.
fn sentence(output: &Output) -> String {
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    let lines: Vec<&str> = (said.lines())
        .filter(|line| !line.starts_with("warning"))
        .collect();
    lines.join(" / ")
}

fn last_step(run: &Run) -> Result<u64, String> {
    let steps = run.history("step")?;
    (steps.last().map(|&s| s as u64)).ok_or_else(|| "its history is empty".into())
}

/// How many particle files the run folder holds, all whole and without a value that is not a number;
/// the history likewise.
///
/// # Errors
/// The file that is not so.
pub fn sound_files(run: &Run) -> Result<usize, String> {
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
            return Err(format!("the history has a {column} that is not a number"));
        }
    }
    Ok(paths.len())
}

fn sound(path: &Path) -> Result<(), String> {
    let file = ParticleFile::open(path).map_err(|e| e.to_string())?;
    file.check().map_err(|e| e.to_string())?;
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
            return Err(format!("{}: {} is not finite", path.display(), column.name));
        }
    }
    Ok(())
}

/// The rows as a section of the page.
pub fn section(rows: &[Result<Row, String>]) -> String {
    let mut out = String::from(SECTION);
    for row in rows {
        // Writing to a string cannot fail.
        let _ = match row {
            Ok(row) => {
                let then = match &row.then {
                    Ok(step) => format!("ended after step {step}"),
                    Err(said) => format!("stopped: {said}"),
                };
                writeln!(
                    out,
                    "| {} | {} | {} | {} | {} | {} | {} | {then} |",
                    row.name,
                    row.cfl[0],
                    row.checkpoint,
                    row.unstable,
                    row.files,
                    row.said,
                    row.cfl[1]
                )
            }
            Err(said) => writeln!(out, "| BROKEN: {said} | | | | | | | |"),
        };
    }
    out
}

const SECTION: &str = "
## checkpoint before an instability

Runs told to stop (exit 75), resumed until they become unstable (exit 1), and resumed from the same
checkpoint at a smaller Courant number, which is the one key of a case that may change on `--resume`.
Checked: the checkpoint is left as it was; every particle file left is whole, and no number in them or
in the history is a NaN or infinite.

| run | CFL | checkpoint after step | last step | files left | said | then CFL | and it |
|---|---|---|---|---|---|---|---|
";

//! Scenes whose right results are known, run by methods through the real `mpm-run` and measured.

use std::path::Path;

use crate::Result;
use crate::case_text::CaseText;
use crate::method::{Method, Scheme};
use crate::outputs::Run;
use crate::study::{side_by_side, write};

type Measure = Box<dyn Fn(&Run) -> Result<Vec<Measured>> + Send + Sync>;

/// A scene with the error of a run of it.
pub struct Scene {
    /// Name of the case file, e.g. "channel-n6-off0.25": its family, the cells across the lumen
    /// where other scenes differ in them alone, and the rest.
    pub name: String,
    /// The case.
    pub case: CaseText,
    /// What is compared, with its equation.
    pub(crate) against: &'static str,
    /// Named errors of a run.
    pub(crate) measure: Measure,
}

impl Scene {
    pub(crate) fn new(
        name: impl Into<String>,
        against: &'static str,
        case: CaseText,
        measure: impl Fn(&Run) -> Result<Vec<Measured>> + Send + Sync + 'static,
    ) -> Self {
        Self {
            name: name.into(),
            case,
            against,
            measure: Box::new(measure),
        }
    }

    /// Cells across the lumen, if the name says so, and the name without them: scenes that agree
    /// in the latter are one refinement series.
    pub(crate) fn resolution(name: &str) -> (String, Option<u32>) {
        let cells = |part: &str| part.strip_prefix('n')?.parse::<u32>().ok();
        let found = name.split('-').find_map(cells);
        let series: Vec<&str> = name.split('-').filter(|p| cells(p).is_none()).collect();
        (series.join("-"), found)
    }
}

/// One number measured against its reference.
#[derive(Clone, Debug)]
pub struct Measured {
    /// What, e.g. "mean velocity".
    pub what: String,
    /// Value of the run.
    pub(crate) value: f64,
    /// Value of the closed form or reference.
    pub(crate) reference: f64,
    /// Error as stated: relative unless `what` says otherwise.
    pub error: f64,
    /// Whether the error is a number of things, not a share.
    pub(crate) counted: bool,
}

impl Measured {
    /// A value with its relative error.
    pub(crate) fn relative(what: impl Into<String>, value: f64, reference: f64) -> Self {
        Self {
            what: what.into(),
            value,
            reference,
            error: value / reference - 1.0,
            counted: false,
        }
    }

    /// An error that is itself the value, e.g. a noise relative to a maximum.
    pub(crate) fn absolute(what: impl Into<String>, error: f64) -> Self {
        Self {
            value: error,
            error,
            ..Self::relative(what, 0.0, 0.0)
        }
    }

    /// A number of things that should be none.
    pub(crate) fn count(what: impl Into<String>, number: usize) -> Self {
        Self {
            counted: true,
            ..Self::absolute(what, number as f64)
        }
    }
}

/// One scene by one method.
pub type Job<'a> = (&'a Scene, Method);

/// What a job gave.
pub struct Outcome {
    /// Name of the scene, and what it is compared with.
    pub(crate) scene: String,
    pub(crate) against: &'static str,
    pub(crate) method: Method,
    /// Measured errors, or why there are none.
    pub measured: Result<Vec<Measured>, String>,
    /// The run.
    pub run: Run,
    /// Steps; NaN if it did not end.
    pub(crate) steps: f64,
    /// User and system time of the run, s; NaN if it did not end.
    pub(crate) cpu_s: f64,
}

impl Outcome {
    /// The measured quantity of this name.
    pub(crate) fn measured(&self, what: &str) -> Option<&Measured> {
        self.measured.as_ref().ok()?.iter().find(|m| m.what == what)
    }
}

/// Runs a job into `folder` from a case file in `cases`; nothing presses in that of the implicit scheme.
fn run((scene, method): &Job, cases: &Path, folder: &Path) -> Result<Vec<Measured>> {
    let scheme = method.scheme;
    let path = cases.join(format!("{}-{}.toml", scene.name, scheme.name()));
    let case = match scheme {
        Scheme::Explicit => scene.case.clone(),
        Scheme::Implicit => scene.case.clone().released(),
    };
    write(&path, case.text(scheme.integrator()))?;
    let mut more = Vec::new();
    let bond = path.with_extension("mpts");
    let name = bond.display().to_string();
    if let Some(voxels) = &case.voxels {
        voxels.write(&bond)?;
        more.extend(["--particles", &name]);
    }
    (scene.measure)(&method.run(&path, folder, &more)?)
}

/// Runs one job in `folder`, which keeps its case in `cases`.
pub fn run_one(job: &Job, folder: &Path) -> Outcome {
    let cases = folder.join("cases");
    let folder = folder.join(format!("{}-{}", job.0.name, job.1.file_label()));
    let measured = run(job, &cases, &folder);
    let run = Run { folder };
    let number = |key: &str| run.summary(key).unwrap_or(f64::NAN);
    Outcome {
        scene: job.0.name.clone(),
        against: job.0.against,
        method: job.1.clone(),
        steps: number("steps"),
        cpu_s: number("cpu_s"),
        measured: measured.map_err(|e| e.to_string()),
        run,
    }
}

/// Runs all jobs and gives their outcomes in the order of the jobs; says each on standard output
/// as it ends.
pub(crate) fn run_all(jobs: &[Job], folder: &Path) -> Vec<Outcome> {
    side_by_side(jobs, |job| {
        let outcome = run_one(job, folder);
        say(&outcome);
        outcome
    })
}

fn say(outcome: &Outcome) {
    let head = format!("{:<28} {:<12}", outcome.scene, outcome.method.label);
    match &outcome.measured {
        Ok(list) => {
            for Measured { what, error, .. } in list {
                println!("{head} {what:<36} {error:+10.3e}  {:7.1} s", outcome.cpu_s);
            }
        }
        Err(said) => println!("{head} FAILED: {said}"),
    }
}

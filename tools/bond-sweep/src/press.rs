//! One run of a sweep: started or continued, and measured where it has ended.

use std::path::Path;

use cli::{Failure, Status};
use run::{End, Mode, Request, RunFailure, Verdict};

use crate::plan::{self, Plan, VERSION};
use crate::{row, specimen};

/// Runs the run `name` of the sweep in `folder` to its end and writes its row. One that has its
/// row is not run again; to have that, remove the row.
///
/// # Errors
/// Exit 75 where it was stopped; all that is not the run's own failure, which is a row: a bond file
/// that has changed, a disk that is full, another process that runs the same.
pub fn run(folder: &Path, name: &str) -> Result<(), Failure> {
    let plan = Plan::read(folder)?;
    let job = plan.job(name)?;
    let place = plan::run_folder(folder, name);
    let row = place.join(row::FILE);
    if row::read(&row)?.is_some() {
        cli::note(format_args!("{} has ended already", place.display()));
        return Ok(());
    }
    cli::catch_interrupts()?;
    let bond = folder.join(&job.bond);
    if let Some(planned) = &job.content
        && specimen::content(&bond)? != *planned
    {
        return Err(Failure::usage(format!(
            "'{}' has changed since the sweep was planned: plan again",
            bond.display()
        )));
    }
    let case = plan::case_of(folder, name);
    let (status, said) = press(&case, &bond, &place, plan.however_long)?;
    let cells = row::of_run(&place, status, &said)?;
    row::write(&row, &cells)?;
    let told = match cells[1].as_str() {
        "" => format!("WP {} um", cells[5]),
        said => said.to_owned(),
    };
    cli::note(format_args!("{}: {status}, {told}", place.display()));
    Ok(())
}

/// Runs `mpm-run` in this process, so that what ends the process ends the run. How it ended, and why.
fn press(
    case: &Path,
    bond: &Path,
    place: &Path,
    however_long: bool,
) -> Result<(&'static str, String), Failure> {
    let request = Request::read(case, Some(bond), &[])?;
    request.warnings().into_iter().for_each(cli::warn);
    let mode = Mode {
        // Of a run that has not begun there is nothing to say.
        resume: place.join(particle_file::RUN_MARK).exists(),
        overwrite: false,
        however_long,
    };
    let name = place.display();
    let verdict = match request.execute_on_terminal(place, mode, VERSION) {
        Err(RunFailure::Unstable { said, .. }) => return Ok(("failed", said)),
        Err(other) => return Err(other.into()),
        Ok(Some(summary)) if summary.end == End::Interrupted => {
            let said = format!("{name}: stopped early; the same command continues it");
            return Err(Failure::new(Status::Resumable, said));
        }
        Ok(Some(summary)) => summary.verdict,
        Ok(None) => Verdict::of_ended(place)?,
    };
    Ok(match verdict.sound {
        true => ("sound", String::new()),
        false => ("not sound", verdict.reasons.join("; ")),
    })
}

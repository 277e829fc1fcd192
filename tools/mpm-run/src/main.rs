//! Presses adhesive into wood: runs a case file into a run folder.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use cli::Failure;
use run::{End, Request};

/// Which build this is: a run of one precision cannot be continued in the other.
const VERSION: &str = if cfg!(feature = "double") {
    concat!(env!("CARGO_PKG_VERSION"), "+double")
} else {
    env!("CARGO_PKG_VERSION")
};

/// Press adhesive into wood: run a case file into a run folder.
#[derive(Parser, Debug)]
#[command(
    version = VERSION,
    after_help = "Examples:
  mpm-run pf-implicit.toml --particles bond.mpts -o runs/pf-implicit
  mpm-run pf-xpic.toml --particles bond.mpts --explain
  mpm-run --reference
  mpm-run pf-xpic.toml --particles bond.mpts -o runs/pf-xpic --resume

The run folder is marked by bondline-run.toml and locked during a run. A run writes \
resolved.toml, history.csv, snapshots/NNNN.mpts, checkpoint.mpts, summary.json and, last, \
final.mpts. It replaces no other file, and no particle file of yours under these names (exit 2).

Options of the explicit scheme beyond the paper's, off unless given \
(docs/results/explicit-options.md):
  integrator.pressure = \"cell-mean\"            pressure from the mean of a cell
  integrator.density_projection = \"0.04 cell\"  uniform density restored every 0.04 cell of motion
  contact.separation = \"0.7 cell\"              distance at which liquid and wall touch

Exit status: 0 the results are sound; 1 the run failed (unstable, not sound, cannot write); \
2 usage or case file; 3 unreadable or damaged data, or too little memory; 75 stopped early \
(SIGINT, SIGTERM, SIGUSR1, SIGUSR2, SIGXCPU, or SIGHUP without nohup), continue with --resume."
)]
struct Arguments {
    /// Case file (TOML); '-' is standard input
    #[arg(required_unless_present = "reference")]
    case: Option<PathBuf>,
    /// Bond file from build-bondline; '-' is standard input. Without it the case's [[body]]
    /// tables describe the scene
    #[arg(long, value_name = "BOND")]
    particles: Option<PathBuf>,
    /// Run folder, a new folder or one with bondline-run.toml
    #[arg(
        short,
        long,
        value_name = "RUNDIR",
        required_unless_present_any = ["explain", "reference"]
    )]
    output: Option<PathBuf>,
    /// Change a key of the case, e.g. --set grid.cell="1.45 um" --set integrator.cfl=0.25
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,
    /// Print the plan, the expected error and the effects left out, and run nothing
    #[arg(long)]
    explain: bool,
    /// Print every table and key of a case file: unit, default, when to change it (Markdown)
    #[arg(long, conflicts_with_all = ["case", "particles", "output", "set", "explain"])]
    reference: bool,
    /// Run even if the forecast exceeds 1e9 steps, a week or the available memory
    #[arg(long)]
    yes_really: bool,
    /// Continue from the last checkpoint in the run folder; start if there is none, do nothing if the run
    /// has ended. Only integrator.cfl may differ from the case of that run
    #[arg(long, conflicts_with = "explain")]
    resume: bool,
    /// Replace the files of another run in the run folder, and no others; with --resume, continue the
    /// same run, or keep it if it has ended
    #[arg(long, conflicts_with = "explain")]
    overwrite: bool,
    #[command(flatten)]
    common: cli::Common,
}

fn main() -> ExitCode {
    machine::give_back_large_arrays();
    cli::main(|a: &Arguments| &a.common, start)
}

fn start(arguments: Arguments) -> Result<(), Failure> {
    let Some(case) = &arguments.case else {
        return cli::Output::Stdout.write(|out| write!(out, "{}", run::REFERENCE));
    };
    let request = Request::read(case, arguments.particles.as_deref(), &arguments.set)?;
    request.warnings().into_iter().for_each(cli::warn);
    if arguments.explain {
        let plan = request.explain()?;
        return cli::Output::Stdout.write(|out| write!(out, "{plan}"));
    }
    // Without a plan or the reference it is required.
    let folder = arguments.output.unwrap_or_default();
    if folder.as_os_str() == "-" {
        return Err(Failure::usage(
            "a run is a folder of files and cannot go to standard output: -o RUNDIR is needed",
        ));
    }
    cli::catch_interrupts()?;
    let mode = run::Mode {
        resume: arguments.resume,
        overwrite: arguments.overwrite,
        however_long: arguments.yes_really,
    };
    let Some(summary) = request.execute_on_terminal(&folder, mode, VERSION)? else {
        let verdict = run::Verdict::of_ended(&folder)?;
        cli::note(format!("{} has ended already", folder.display()));
        return sound(&verdict);
    };
    cli::note(format!("{}: {}", folder.display(), summary.sentence()));
    match summary.end {
        End::Interrupted => Err(Failure::new(
            cli::Status::Resumable,
            format!(
                "stopped early; continue with --resume -o {}",
                folder.display()
            ),
        )),
        _ => sound(&summary.verdict),
    }
}

/// Exit status 0 is a claim that the results are sound.
fn sound(verdict: &run::Verdict) -> Result<(), Failure> {
    match verdict.objection() {
        Some(said) => Err(Failure::failed(said)),
        None => Ok(()),
    }
}

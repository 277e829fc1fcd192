//! Many runs from one table, on whatever starts jobs: see docs/cluster.md.

mod collect;
mod draft;
mod inputs;
mod plan;
mod press;
mod row;
mod specimen;
mod table;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use cli::{Failure, Output};

/// Run a table of parameters, one run per row, and collect one table of results
#[derive(Parser)]
#[command(
    version,
    after_help = "Examples:
  bond-sweep plan table.csv --case pf-implicit.toml -o sweep
  xargs -P 8 -n 1 bond-sweep run --threads 1 sweep < sweep/runs.txt
  bond-sweep collect sweep -o results.csv

A column of the table is a key of the case (adhesive.viscosity, clamp.max_pressure ...); case (a \
case file); particles (a bond file); or specimen.adhesive, .size, .slab, .voxel, .grain_angle, \
.seed (a synthetic specimen, by default the quick one of make). Paths start from the table's \
folder; a case without an ending is a file beside that of --case. An empty cell stands for the \
value of the case file.

Exit status: 0 ok; 1 cannot write; 2 usage, table or case; 3 unreadable or damaged data, or too little memory; 75 \
stopped early or not all runs ended: start the same command again."
)]
struct Arguments {
    #[command(subcommand)]
    step: Step,
    #[command(flatten)]
    common: cli::Common,
}

#[derive(Subcommand)]
enum Step {
    /// Check every cell of a table, make the specimens, and lay out the runs in a folder
    #[command(after_help = "Examples:
  bond-sweep plan table.csv --case pipelines/cases/pf-implicit.toml -o out/sweep/table
  bond-sweep plan large.csv --case pf-xpic.toml --yes-really -o sweep
  bond-sweep plan table.csv --case pf-implicit.toml -o sweep && wc -l sweep/runs.txt")]
    Plan {
        /// Table of the runs (CSV); '-' is standard input, its paths then start from the working folder
        table: PathBuf,
        /// Case file of rows without a case of their own; '-' is standard input
        #[arg(long, value_name = "CASE.toml")]
        case: PathBuf,
        /// Folder of the sweep
        #[arg(short, long, value_name = "FOLDER")]
        output: PathBuf,
        /// Plan even runs whose forecast exceeds 1e9 steps, a week or the available memory
        #[arg(long)]
        yes_really: bool,
    },
    /// Start or continue one of the planned runs, and measure its last state
    #[command(after_help = "Examples:
  bond-sweep run sweep 03f2a1b4c5d6e7f8
  parallel --joblog sweep/jobs bond-sweep run --threads 1 sweep {} < sweep/runs.txt
  bond-sweep run sweep $(sed -n ${SLURM_ARRAY_TASK_ID}p sweep/runs.txt)")]
    Run {
        /// Folder of the sweep
        folder: PathBuf,
        /// Name of the run: a line of the folder's runs.txt
        run: String,
    },
    /// Put the results of all rows into one table
    #[command(after_help = "Examples:
  bond-sweep collect sweep -o results.csv
  bond-sweep collect sweep -o results.csv --cost cost.csv
  bond-sweep collect sweep -o - | column -s, -t | less -S")]
    Collect {
        /// Folder of the sweep
        folder: PathBuf,
        /// CSV to write; `-` is standard output
        #[arg(short, long, value_name = "CSV")]
        output: Output,
        /// Write time and memory of each run, which differ from one execution to the next
        #[arg(long, value_name = "CSV")]
        cost: Option<Output>,
    },
}

fn main() -> ExitCode {
    cli::main(|a: &Arguments| &a.common, run)
}

fn run(arguments: Arguments) -> Result<(), Failure> {
    match arguments.step {
        Step::Plan {
            mut table,
            mut case,
            output,
            yes_really,
        } => {
            if output.as_os_str() == "-" {
                return Err(Failure::usage(
                    "a sweep is a folder of files and cannot go to standard output: -o FOLDER is needed",
                ));
            }
            // A case is read for each row, a table once.
            let text = |head: &[u8]| !head.contains(&0);
            let _spooled = match case.as_os_str() == "-" {
                true => cli::stdin_in_place([&mut table, &mut case], text)?,
                false => None,
            };
            plan::make(&table, &case, &output, yes_really)
        }
        Step::Run { folder, run } => press::run(&folder, &run),
        Step::Collect {
            folder,
            output,
            cost,
        } => collect::collect(&folder, &output, cost.as_ref()),
    }
}

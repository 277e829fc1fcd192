//! Looks into particle files: what they hold, whether they are whole, their order-free sum,
//! and their content in other formats.

mod export;
mod info;

use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Args, Parser, Subcommand};
use cli::{Common, Failure};
use particle_file::ParticleFile;

/// Describe, check, sum and export particle files (.mpts)
#[derive(Parser, Debug)]
#[command(
    version,
    after_help = "Examples:
  particles info bond.mpts
  particles check runs/pf/final.mpts && particles sum runs/pf/final.mpts
  particles export runs/pf/snapshots/*.mpts -o pf.pvd"
)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
    #[command(flatten)]
    common: Common,
}

#[derive(Subcommand, Debug)]
enum Command {
    /// Print what a file holds and how it was made
    Info(Files),
    /// Check a whole file: checksums of all arrays, finite numbers
    Check(Files),
    /// Print a checksum of the material points that does not depend on their order
    Sum(Files),
    /// Write the content as csv, npz, vtp, vti, pvd or labelled tiff
    ///
    /// csv and vtp hold the liquid points or, in a file without any, its adhesive voxels.
    /// vti and tiff hold labels: void 0, wood 128, adhesive 255; the fullest voxels outside wood are
    /// adhesive, as many as the volume of the liquid fills. npz holds everything. pvd is a
    /// series for ParaView, with its data in the folder NAME.parts beside it, where
    /// only files of an earlier series are replaced.
    Export(export::Arguments),
}

#[derive(Args, Debug)]
struct Files {
    /// Particle files; '-' is standard input
    #[arg(required = true, value_name = "FILE")]
    files: Vec<PathBuf>,
}

fn main() -> ExitCode {
    cli::main(|a: &Arguments| &a.common, run)
}

fn run(arguments: Arguments) -> Result<(), Failure> {
    match arguments.command {
        Command::Info(files) => for_each(&files.files, info::describe),
        Command::Check(files) => check(&files.files),
        Command::Sum(files) => for_each(&files.files, |file| {
            let sum = file.sum().map_err(Failure::data)?;
            Ok(format!("{sum:016x}  {}\n", file.name()))
        }),
        Command::Export(arguments) => export::run(&arguments),
    }
}

fn for_each(
    files: &[PathBuf],
    text: impl Fn(&ParticleFile) -> Result<String, Failure>,
) -> Result<(), Failure> {
    for path in files {
        let file = ParticleFile::open(path).map_err(Failure::data)?;
        cli::print(&text(&file)?)?;
    }
    Ok(())
}

/// Checks every file, also behind a damaged one, so that one call finds all of them.
fn check(files: &[PathBuf]) -> Result<(), Failure> {
    let mut last_fault = None;
    let mut faults = 0;
    for path in files {
        match ParticleFile::open(path).and_then(|file| file.check().map(|()| file)) {
            Ok(file) => cli::print(&format!("{}: ok\n", file.name()))?,
            Err(fault) => {
                if let Some(earlier) = last_fault.replace(fault) {
                    cli::warn(earlier);
                }
                faults += 1;
            }
        }
    }
    match last_fault {
        None => Ok(()),
        Some(fault) if faults == 1 => Err(Failure::data(fault)),
        Some(fault) => Err(Failure::data(format!(
            "{fault}; {faults} files are damaged"
        ))),
    }
}

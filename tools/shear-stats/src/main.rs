//! Shear rates in the states of a run: see `lib/metrics`.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use cli::{Failure, InputRecord, Output, Record};
use metrics::{Convention, ShearRates, table, tube_shear_rate};
use particle_file::by_time;
use units::{Length, Speed, positive};

/// Distribution of shear rates in the adhesive, weighted by volume
///
/// One row of quantiles per snapshot, as in Figs. 10 and 11 of Hammerquist & Nairn.
#[derive(Parser)]
#[command(
    version,
    after_help = "Examples:
  shear-stats run/snapshots/*.mpts -o shear.csv
  shear-stats run/final.mpts --convention rheometer
  shear-stats --tube '1 m/s,50 um'"
)]
struct Arguments {
    /// Snapshots of one run, in any order, each counted once; `-` is standard input
    #[arg(required_unless_present = "tube")]
    snapshots: Vec<PathBuf>,
    /// Convert to 2|dev D| (paper) or sqrt(2 D:D) (rheometer) [default: as stored]
    #[arg(long, value_name = "paper|rheometer")]
    convention: Option<Convention>,
    /// Print the shear rate at the wall of a tube, 8 v / d (Eq. 7), in both conventions (on
    /// standard error if a table is written too)
    #[arg(long, value_name = "SPEED,DIAMETER", value_parser = tube)]
    tube: Option<[f64; 2]>,
    /// Table to write; `-` is standard output
    #[arg(short, long, value_name = "CSV", default_value = "-")]
    output: Output,
    #[command(flatten)]
    common: cli::Common,
}

/// Speed (m/s) and diameter (m) of a tube.
fn tube(text: &str) -> Result<[f64; 2], String> {
    let (speed, diameter) = text
        .split_once(',')
        .ok_or_else(|| format!("'{text}' is not SPEED,DIAMETER; accepted is e.g. '1 m/s,50 um'"))?;
    let values = positive::<Speed>(speed).and_then(|v| Ok([v, positive::<Length>(diameter)?]));
    values.map_err(|error| error.to_string())
}

fn main() -> ExitCode {
    cli::main(|a: &Arguments| &a.common, run)
}

fn run(arguments: Arguments) -> Result<(), Failure> {
    let read = arguments.snapshots.iter().map(PathBuf::as_path);
    cli::keep_apart_with_records(read, [&arguments.output])?;
    if let Some(tube) = arguments.tube {
        let line = tube_line(tube);
        if arguments.snapshots.is_empty() {
            return arguments.output.write(|out| writeln!(out, "{line}"));
        }
        cli::note(line);
    }
    let mut states = Vec::new();
    let mut inputs = Vec::new();
    let snapshots = by_time(arguments.snapshots).map_err(|e| Failure::of_input(e.is_usage(), e))?;
    for (path, file) in snapshots {
        let rates = ShearRates::of_file(&file, arguments.convention).map_err(|error| {
            Failure::of_input(error.is_usage(), format!("'{}': {error}", path.display()))
        })?;
        states.push(rates);
        if arguments.output != Output::Stdout {
            inputs.push(InputRecord::new(
                path.display().to_string(),
                file.content_hash(),
            ));
        }
    }
    let record = Record::new(env!("CARGO_PKG_NAME"), env!("CARGO_PKG_VERSION"), inputs);
    arguments
        .output
        .write_with_record(&record, |out| table::write_shear_rates(out, &states))
}

fn tube_line([speed, diameter]: [f64; 2]) -> String {
    let rate = tube_shear_rate(speed, diameter);
    format!(
        "tube of {:.3} um at {speed:.3} m/s: 8 v / d = {rate:.4e} 1/s (rheometer), {:.4e} 1/s (paper)",
        1e6 * diameter,
        Convention::Paper.factor() * rate
    )
}

//! One page of HTML about runs: see `lib/report`.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;
use clap::builder::{OsStringValueParser, TypedValueParser};
use cli::{Failure, InputRecord, Output, Record};
use particle_file::ParticleFile;
use report::{Error, Labelled, Report, RunFolder, measured, picture, scene, table};

/// Put runs, tables and pictures into one HTML page that needs no network
#[derive(Parser)]
#[command(
    version,
    after_help = "Examples:
  bond-report --run implicit=out/tutorial/implicit -o report.html
  bond-report --run PF=runs/pf --picture \"Pressure=pressure.svg\" --table \"Table 2=table2.csv\" -o pf.html
  bond-report --title \"PF, 2.5 MPa\" --run PF=runs/pf --state PF=runs/pf/final.mpts -o pf.html

The page begins with a summary: specimen, adhesive and press; weighted penetration by side, with its error if the run folder \
has a wp.csv of wp-metrics --finer; whether the bond closed; the first two pictures; caveats. Then come tables with rounded \
numbers, the other pictures, states in 3D (only the middle of states of more than 700 000 voxels), and for each run its \
parameters, expected error, effects left out, cost and provenance."
)]
struct Arguments {
    /// Title of the page
    #[arg(
        long,
        value_name = "TEXT",
        default_value = "Adhesive pressed into wood"
    )]
    title: String,
    /// A run folder; may be repeated
    #[arg(long, value_name = "[LABEL=]RUNDIR", value_parser = labelled())]
    run: Vec<Labelled>,
    /// CSV of wp-metrics of a measured specimen, shown above the runs; may be repeated
    #[arg(long, value_name = "[LABEL=]CSV", value_parser = labelled())]
    experiment: Vec<Labelled>,
    /// A CSV table, of at most 1000 rows; may be repeated
    #[arg(long, value_name = "[CAPTION=]CSV", value_parser = labelled())]
    table: Vec<Labelled>,
    /// An SVG or PNG picture; may be repeated
    #[arg(long, value_name = "[CAPTION=]FILE", value_parser = labelled())]
    picture: Vec<Labelled>,
    /// A specimen, bond or state to show in 3D; may be repeated
    #[arg(long, value_name = "[LABEL=]FILE", value_parser = labelled())]
    state: Vec<Labelled>,
    /// Page to write; `-` is standard output
    #[arg(short, long, value_name = "HTML")]
    output: Output,
    #[command(flatten)]
    common: cli::Common,
}

fn main() -> ExitCode {
    cli::main(|a: &Arguments| &a.common, start)
}

fn start(mut arguments: Arguments) -> Result<(), Failure> {
    let given = inputs(&arguments);
    if given.is_empty() {
        return Err(Failure::usage(
            "nothing to report on: give --run, --experiment, --table, --picture or --state",
        ));
    }
    cli::keep_apart_with_records(given.iter().map(PathBuf::as_path), [&arguments.output])?;
    let files = [
        &mut arguments.experiment,
        &mut arguments.table,
        &mut arguments.picture,
        &mut arguments.state,
    ];
    let paths = files.into_iter().flatten().map(|file| &mut file.path);
    let known = |head: &[u8]| {
        ParticleFile::recognises(head) || head.starts_with(b"\x89PNG") || !head.contains(&0)
    };
    let _spooled = cli::stdin_in_place(paths, known)?;
    let inputs = inputs(&arguments);
    for labels in [&mut arguments.run, &mut arguments.experiment] {
        Labelled::tell_apart(labels);
    }
    let mut report = Report {
        title: arguments.title,
        experiments: all(&arguments.experiment, measured)?,
        runs: all(&arguments.run, RunFolder::read)?,
        tables: all(&arguments.table, table)?,
        pictures: all(&arguments.picture, picture)?,
        scenes: all(&arguments.state, scene)?,
        ..Report::default()
    };
    // What was read has an end.
    let there = (inputs.iter().zip(&given)).filter(|(path, _)| path.exists());
    let hashed = there.map(|(path, given)| InputRecord::of_file(path, given.display().to_string()));
    let hashed = hashed.collect::<Result<_, _>>()?;
    let record = Record::new(env!("CARGO_PKG_NAME"), env!("CARGO_PKG_VERSION"), hashed);
    report.command = particle_file::command_line(&record.command);
    let files = record.inputs.iter();
    report.inputs = files
        .map(|file| [file.path.clone(), file.xxh3.clone()])
        .collect();
    let page = report.to_html();
    let write = |out: &mut dyn std::io::Write| out.write_all(page.as_bytes());
    arguments.output.write_with_record(&record, write)?;
    let size = machine::bytes(page.len() as u64);
    cli::note(format!("{}: {size}", arguments.output));
    Ok(())
}

fn all<T>(given: &[Labelled], read: fn(&Labelled) -> Result<T, Error>) -> Result<Vec<T>, Failure> {
    let read: Result<_, _> = given.iter().map(read).collect();
    read.map_err(Failure::data)
}

/// The files read.
fn inputs(arguments: &Arguments) -> Vec<PathBuf> {
    let files = |run: &Labelled| RunFolder::FILES.map(|name| run.path.join(name));
    let of_runs = arguments.run.iter().flat_map(files);
    let others = [
        &arguments.experiment,
        &arguments.table,
        &arguments.picture,
        &arguments.state,
    ];
    let others = others.into_iter().flatten().map(|file| file.path.clone());
    of_runs.chain(others).collect()
}

/// `LABEL=PATH`, or a path alone, which is its own label. Paths need not be UTF-8.
fn labelled() -> impl TypedValueParser<Value = Labelled> {
    let itself = |path: &Path| path.display().to_string();
    OsStringValueParser::new().try_map(move |text| Labelled::parse(&text, itself))
}

//! How far adhesive penetrated: see `lib/metrics`.

mod finer;
mod input;
mod permeability;
mod series;

use std::path::PathBuf;
use std::process::ExitCode;
use std::str::FromStr;

use clap::Parser;
use cli::{Failure, InputRecord, Output, Record};
use input::{GreyLevels, Input, StackOptions};
use metrics::table::{self, PenetrationRows};
use metrics::{
    Adhesive, Datum, Map, Reference, Sealed, Side, bond_line, compare, depth_profile, penetration,
};
use units::{Axis, Length, Quantity};
use voxels::{Dims, Labels, RawType};

/// Measure weighted and effective penetration of adhesive
///
/// Of a state of a run, a bond, a specimen (particle files) or straight of an image stack.
/// WP is Eq. 6 of Hammerquist & Nairn; slab_wp_um is that of a slab of the same volume that
/// has not penetrated.
#[derive(Parser)]
#[command(
    version,
    after_help = "Examples:
  wp-metrics run/final.mpts run/snapshots/*.mpts -o wp.csv
  wp-metrics stack.tif --voxel 1.45um --reference plane=226.2um --map map.csv --profile depth.csv
  wp-metrics run/final.mpts --compare specimen.mpts
  wp-metrics --series run -o series.csv
  wp-metrics run/final.mpts --finer run-in-half-cells/final.mpts
  wp-metrics specimen.mpts --reference fit --ignore-islands 100
  wp-metrics wood.tif --voxel 1.45um --permeability z"
)]
struct Arguments {
    /// Particle files, stacks of every kind that xct2particles reads (raw ones: --dims), or folders
    /// of slices; `-` is standard input
    #[arg(required = true)]
    files: Vec<PathBuf>,
    /// What to measure from: mid (midway between the bond surfaces), adherend (the bond
    /// surface of each side), fit (a tilted plane midway) or plane=LEN
    #[arg(long, value_name = "WHAT", default_value = "mid", value_parser = reference)]
    reference: Reference,
    /// Axis across the bond: x, y or z [default: the file's, y of a stack]
    #[arg(long, value_name = "AXIS")]
    normal: Option<Axis>,
    /// Where the table goes; `-` is standard output
    #[arg(short, long, value_name = "CSV", default_value = "-")]
    output: Output,
    /// Write WP and volume of every column of voxels across the bond (one FILE only)
    #[arg(long, value_name = "CSV")]
    map: Option<Output>,
    /// Write adhesive and filled void against depth (one FILE only, or of each time of a series)
    #[arg(long, value_name = "CSV")]
    profile: Option<Output>,
    /// Add agreement with this specimen: Dice coefficient of the voxels and correlation of
    /// the maps
    #[arg(long, value_name = "EXPERIMENT")]
    compare: Option<PathBuf>,
    /// Add WP, EP and pressure carried on to cells of no size, and their errors, from the end of
    /// the same run in cells at most half as large: first order, error the difference (one FILE only)
    #[arg(long, value_name = "STATE")]
    finer: Option<PathBuf>,
    /// Add time, gap (way of the clamp left until the bond is closed), depth of 95 % of the adhesive, wetted
    /// area, distance of the bond surfaces, depth to which the open lumens are half full, and state of the bond line (filled;
    /// starved where less than half of the room within two voxels of the adherends' surfaces is filled;
    /// squeezed-out where a twentieth of the adhesive has left), in order of time; FILE may be the
    /// folder of a run
    #[arg(long)]
    series: bool,
    /// Add the pressure on the body that the clamp drives (states of runs; with --finer always)
    #[arg(long)]
    pressure: bool,
    /// Leave out adhesive that hangs together to fewer than N pixels of a slice normal to z, by edges and corners (stacks,
    /// specimens and bonds)
    #[arg(long, value_name = "N", conflicts_with_all = ["compare", "finer", "series"])]
    ignore_islands: Option<usize>,
    /// Tell the permeability along this axis instead, x, y or z, of all that is not wood full of liquid that sticks to it:
    /// steady flow through the voxels in cells of one, and as its error the distance from that in cells of two
    #[arg(
        long,
        value_name = "AXIS",
        conflicts_with_all = [
            "reference", "normal", "map", "profile", "compare", "finer", "series", "pressure", "ignore_islands"
        ]
    )]
    permeability: Option<Axis>,
    /// The sides along the flow are periodic, not mirrors
    #[arg(long, requires = "permeability")]
    periodic: bool,
    /// Voxel edge of stacks [default: from their metadata]
    #[arg(long, value_name = "LEN", help_heading = "Image stacks")]
    voxel: Option<Quantity<Length>>,
    /// Labels of stacks, as in void=0,wood=1|2,adhesive=255 [default: guessed]
    #[arg(long, value_name = "LABELS", help_heading = "Image stacks")]
    labels: Option<Labels>,
    /// Grey values of stacks, as in wood=90..170,adhesive=171..; auto takes those that
    /// xct2particles --grey auto proposes, and says them
    #[arg(
        long,
        value_name = "auto|RANGES",
        conflicts_with = "labels",
        help_heading = "Image stacks",
        value_parser = grey
    )]
    grey: Option<GreyLevels>,
    /// Size of stacks that are raw volumes, x fastest
    #[arg(
        long,
        value_name = "XxYxZ",
        requires = "kind",
        help_heading = "Image stacks"
    )]
    dims: Option<Dims>,
    /// Number type of raw volumes: u8, i16, f32 ..., little-endian; big-endian as u16be
    #[arg(
        long = "type",
        id = "kind",
        value_name = "TYPE",
        requires = "dims",
        help_heading = "Image stacks"
    )]
    kind: Option<RawType>,
    #[command(flatten)]
    common: cli::Common,
}

fn grey(text: &str) -> Result<GreyLevels, String> {
    match text {
        "auto" => Ok(GreyLevels::Auto),
        ranges => ranges.parse().map(GreyLevels::Given),
    }
}

fn reference(text: &str) -> Result<Reference, String> {
    match (text, text.strip_prefix("plane=")) {
        ("mid", _) => Ok(Reference::Mid),
        ("adherend", _) => Ok(Reference::Adherend),
        ("fit", _) => Ok(Reference::Fit),
        (_, Some(length)) => Quantity::<Length>::from_str(length)
            .map(|length| Reference::Plane(length.si()))
            .map_err(|e| e.to_string()),
        _ => Err(format!(
            "'{text}' is not a reference; accepted are mid, adherend, fit and plane=LEN"
        )),
    }
}

fn main() -> ExitCode {
    cli::main(|a: &Arguments| &a.common, run)
}

fn run(arguments: Arguments) -> Result<(), Failure> {
    let paths = series::of(&arguments)?;
    if paths.len() > 1 && arguments.finer.is_some() {
        return Err(Failure::usage(
            "--finer belongs to one file, but several are given: run wp-metrics on each",
        ));
    }
    let profile = arguments.profile.is_some() && !arguments.series;
    if paths.len() > 1 && (arguments.map.is_some() || profile) {
        return Err(Failure::usage(
            "--map and --profile describe one file, but several are given: run wp-metrics on each",
        ));
    }
    let on_stdout = outputs(&arguments).filter(|o| **o == Output::Stdout);
    if on_stdout.count() > 1 {
        return Err(Failure::usage(
            "two tables on standard output cannot be told apart: give all but one of -o, --map and --profile a file",
        ));
    }
    let read = paths.iter();
    let read = read.chain(&arguments.compare).chain(&arguments.finer);
    cli::keep_apart_with_records(read.map(PathBuf::as_path), outputs(&arguments))?;
    let options = stack_options(&arguments)?;
    // Which files a stack is read from shows once it is open; nothing is written before.
    let open = |path: &PathBuf| {
        let input = Input::open(path, &options)?;
        cli::keep_apart_with_records(input.stack_files(), outputs(&arguments))?;
        Ok(input)
    };
    let experiment = arguments.compare.as_ref().map(open).transpose()?;
    let finer = arguments.finer.as_ref().map(open).transpose()?;
    let mut record = Recorder::new(&arguments);
    for beside in experiment.iter().chain(&finer) {
        record.add(beside)?;
    }
    if let Some(axis) = arguments.permeability {
        return permeability::tell(&paths, axis, &arguments, open, record);
    }
    let mut files = Vec::new();
    let mut profiles = Vec::new();
    for path in &paths {
        // A row of numbers is all that stays of a file.
        let input = open(path)?;
        record.add(&input)?;
        let mut rows = measure(&input, &arguments, experiment.as_ref(), &record)?;
        if arguments.pressure || finer.is_some() {
            rows.pressure_pa = Some(input.noted(finer::PRESSURE)?);
        }
        if arguments.series {
            let state = input.state(arguments.normal)?;
            let begun = files.first().map_or(&rows, |first: &PenetrationRows| first);
            let begun_m3 = begun.sides[2].volume_m3;
            let fail = |error| input.failure(&error);
            let middle = Datum::find(Reference::Mid, &state).map_err(fail)?;
            let sealed = Sealed::of(&state, &middle);
            let line = bond_line(&state, begun_m3, &sealed).map_err(fail)?;
            rows.course = Some((input.time_s(), input.gap_m(), line));
            if arguments.profile.is_some() {
                let datum = Datum::find(arguments.reference, &state).map_err(fail)?;
                let profile = depth_profile(&state, &datum, &sealed).map_err(fail)?;
                profiles.push((Some(input.time_s()), profile));
            }
        }
        if let Some(finer) = &finer {
            finer::carry_on(&mut rows, &input, finer, &arguments)?;
        }
        files.push(rows);
    }
    if let Some(output) = arguments.profile.as_ref().filter(|_| arguments.series) {
        output.write_with_record(&record.finish(), |out| {
            table::write_depth_profiles(out, &profiles)
        })?;
    }
    arguments.output.write_with_record(&record.finish(), |out| {
        table::write_penetration(out, &files)
    })
}

fn outputs(arguments: &Arguments) -> impl Iterator<Item = &Output> {
    let table = [&arguments.output].into_iter();
    table.chain(&arguments.map).chain(&arguments.profile)
}

fn stack_options(arguments: &Arguments) -> Result<StackOptions, Failure> {
    let voxel = arguments.voxel.map(Quantity::positive).transpose();
    Ok(StackOptions {
        voxel_m: voxel.map_err(Failure::usage)?.map(Quantity::si),
        raw: arguments.dims.zip(arguments.kind),
        labels: arguments.labels.clone(),
        grey: arguments.grey.clone(),
    })
}

/// The row of one file; writes its map and profile where they are asked for.
fn measure(
    input: &Input,
    arguments: &Arguments,
    experiment: Option<&Input>,
    record: &Recorder,
) -> Result<PenetrationRows, Failure> {
    let fail = |error| input.failure(&error);
    let mut state = input.state(arguments.normal)?;
    let kept = (arguments.ignore_islands)
        .map(|least| input.without_islands(&state, least))
        .transpose()?;
    if let (Some(kept), Adhesive::Voxels(adhesive)) = (&kept, &mut state.adhesive) {
        adhesive.bits = kept.view();
    }
    let datum = Datum::find(arguments.reference, &state).map_err(fail)?;
    if let Some(doubt) = datum.doubt(&state) {
        cli::warn(format!("'{}': {doubt}", input.name));
    }
    if let Some(output) = &arguments.map {
        let map = Map::new(&state, &datum, Side::Total);
        output.write_with_record(&record.finish(), |out| table::write_map(out, &map))?;
    }
    if let Some(output) = arguments.profile.as_ref().filter(|_| !arguments.series) {
        let sealed = Sealed::of(&state, &datum);
        let layers = depth_profile(&state, &datum, &sealed).map_err(fail)?;
        let profile = [(None, layers)];
        output.write_with_record(&record.finish(), |out| {
            table::write_depth_profiles(out, &profile)
        })?;
    }
    let agreement = match experiment {
        Some(experiment) => {
            let experiment = experiment.state(arguments.normal)?;
            Some(compare(&state, &experiment).map_err(fail)?)
        }
        None => None,
    };
    Ok(PenetrationRows {
        file: cli::cell(&input.name).into_owned(),
        reference: arguments.reference,
        sides: penetration(&state, &datum),
        agreement,
        pressure_pa: None,
        course: None,
        cell_error: None,
    })
}

/// Collects what the outputs were made from. Hashing reads every input whole, so it is done
/// only when an output is a file, beside which a record can stand.
struct Recorder {
    wanted: bool,
    inputs: Vec<InputRecord>,
}

impl Recorder {
    fn new(arguments: &Arguments) -> Self {
        Self {
            wanted: outputs(arguments).any(|o| *o != Output::Stdout),
            inputs: Vec::new(),
        }
    }

    fn add(&mut self, input: &Input) -> Result<(), Failure> {
        if self.wanted {
            self.inputs.extend(input.records()?);
        }
        Ok(())
    }

    fn finish(&self) -> Record {
        Record::new(
            env!("CARGO_PKG_NAME"),
            env!("CARGO_PKG_VERSION"),
            self.inputs.clone(),
        )
    }
}

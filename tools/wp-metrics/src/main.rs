//! How far adhesive penetrated: see `lib/metrics`.

mod arguments;
mod files;
mod finer;
mod input;
mod wood;

use std::path::PathBuf;
use std::process::ExitCode;

use arguments::Arguments;
use cli::{Failure, InputRecord, Output, Record};
use input::Input;
use metrics::table::{self, PenetrationRows};
use metrics::{
    Adhesive, Datum, DepthLayer, Map, Reference, Sealed, Side, Wood, bond_line, compare,
    depth_profile, penetration,
};
use particle_file::Kind;

/// What a series needs that a scene of boxes lacks.
const NO_GAP: &str =
    "there is no gap between two adherends, which --series follows; leave out --series";

fn main() -> ExitCode {
    cli::main(|a: &Arguments| &a.common, run)
}

fn run(arguments: Arguments) -> Result<(), Failure> {
    let paths = files::of(&arguments)?;
    fit_together(&arguments, paths.len())?;
    let read = paths.iter();
    let read = read.chain(&arguments.compare).chain(&arguments.finer);
    let compared = (arguments.finer.iter()).flat_map(|finer| [finer].into_iter().chain(&paths));
    let cases: Vec<PathBuf> = compared.flat_map(|state| finer::cases(state)).collect();
    let read = read.chain(&cases);
    cli::keep_apart_with_records(read.map(PathBuf::as_path), outputs(&arguments))?;
    // Which files a stack is read from shows once it is open; nothing is written before.
    let open = |path: &PathBuf| {
        let input = Input::open(path, &arguments)?;
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
        return wood::tell_permeability(&paths, axis, &arguments, open, record);
    }
    if arguments.pores {
        return wood::tell_pores(&paths, &arguments, open, record);
    }
    let mut files: Vec<PenetrationRows> = Vec::new();
    let mut profiles = Vec::new();
    for path in &paths {
        // A row of numbers is all that stays of a file.
        let input = open(path)?;
        record.add_specimen(&input)?;
        let mut rows = measure(&input, &arguments, experiment.as_ref(), &record)?;
        if arguments.pressure || finer.is_some() {
            rows.pressure_pa = Some(input.noted(finer::PRESSURE)?);
        }
        if arguments.series {
            let state = input.state(arguments.normal)?;
            let fail = |error| input.failure(&error);
            let middle = Datum::find(Reference::Mid, &state).map_err(|error| match error {
                metrics::Error::Usage(_) if matches!(state.wood, Wood::None) => {
                    fail(metrics::Error::Usage(NO_GAP.to_owned()))
                }
                _ => fail(error),
            })?;
            let sealed = Sealed::of(&state, &middle);
            // Older states do not note what left.
            let left = input.noted("left_through_open_sides").unwrap_or(0.0);
            let line = bond_line(&state, left, &sealed).map_err(fail)?;
            let gap_m = input.noted("gap_m").unwrap_or(f64::NAN);
            rows.series = Some((input.time_s(), gap_m, line));
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
        write_profiles(output, &record, &profiles)?;
    }
    if let Some(output) = &arguments.summary {
        output.write_with_record(&record.finish(), |out| table::write_summary(out, &files))?;
    }
    arguments.output.write_with_record(&record.finish(), |out| {
        table::write_penetration(out, &files)
    })
}

/// Refuses options that do not go with so many files, or with one another.
fn fit_together(arguments: &Arguments, files: usize) -> Result<(), Failure> {
    let map_or_profile =
        arguments.map.is_some() || arguments.profile.is_some() && !arguments.series;
    let on_stdout = outputs(arguments).filter(|o| **o == Output::Stdout);
    let wrong = if files > 1 && arguments.finer.is_some() {
        "--finer needs a single file: run wp-metrics on each"
    } else if files > 1 && map_or_profile {
        "--map and --profile need a single file: run wp-metrics on each"
    } else if files < 2 && arguments.summary.is_some() {
        "--summary needs several files: name them, or a folder of particle files"
    } else if on_stdout.count() > 1 {
        "two tables on standard output cannot be told apart: give all but one of -o, --summary, --map and --profile a file"
    } else {
        return Ok(());
    };
    Err(Failure::usage(wrong))
}

fn outputs(arguments: &Arguments) -> impl Iterator<Item = &Output> {
    let table = [&arguments.output].into_iter().chain(&arguments.summary);
    table.chain(&arguments.map).chain(&arguments.profile)
}

fn write_profiles(
    output: &Output,
    record: &Recorder,
    profiles: &[(Option<f64>, Vec<DepthLayer>)],
) -> Result<(), Failure> {
    output.write_with_record(&record.finish(), |out| {
        table::write_depth_profiles(out, profiles)
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
    for doubt in datum
        .fit_doubt()
        .into_iter()
        .chain(datum.severed_doubt(&state))
    {
        cli::warn(format!("'{}': {doubt}", input.name));
    }
    if let Some(output) = &arguments.map {
        let map = Map::new(&state, &datum, Side::Total);
        output.write_with_record(&record.finish(), |out| table::write_map(out, &map))?;
    }
    if let Some(output) = arguments.profile.as_ref().filter(|_| !arguments.series) {
        let layers = depth_profile(&state, &datum, &Sealed::of(&state, &datum)).map_err(fail)?;
        write_profiles(output, record, &[(None, layers)])?;
    }
    // A specimen lies across any axis.
    let across = |e: &Input| (e.kind() == Kind::Specimen).then_some(state.normal);
    let experiment = experiment.map(|e| e.state(across(e))).transpose()?;
    let agreement = experiment.map(|experiment| compare(&state, &experiment));
    let agreement = agreement.transpose().map_err(fail)?;
    Ok(PenetrationRows {
        file: cli::cell(&input.name).into_owned(),
        reference: arguments.reference,
        tilt: datum.tilt(),
        sides: penetration(&state, &datum),
        agreement,
        pressure_pa: None,
        series: None,
        cell_error: None,
    })
}

/// Collects what the outputs were made from. Hashing reads every input whole, so it is done
/// only when an output is a file, beside which a record can stand.
struct Recorder {
    wanted: bool,
    inputs: Vec<InputRecord>,
    /// Whether each specimen counts once, and names, kinds and contents of those that were added.
    once: bool,
    specimens: Vec<(String, Kind, Vec<String>)>,
}

impl Recorder {
    fn new(arguments: &Arguments) -> Self {
        Self {
            wanted: outputs(arguments).any(|o| *o != Output::Stdout),
            inputs: Vec::new(),
            once: arguments.summary.is_some(),
            specimens: Vec::new(),
        }
    }

    /// Adds one of the files to measure; a copy of another would count twice in their mean.
    fn add_specimen(&mut self, input: &Input) -> Result<(), Failure> {
        if !self.once {
            return self.add(input);
        }
        let records = input.records()?;
        let content = records.iter().map(|record| record.xxh3.clone()).collect();
        let (name, kind) = (&input.name, input.kind());
        let of_other_kind = self.specimens.iter().find(|(_, other, _)| *other != kind);
        if let Some((other, other_kind, _)) = of_other_kind {
            return Err(Failure::usage(format!(
                "'{name}' is a {kind} and '{other}' a {other_kind}: --summary needs files of one kind"
            )));
        }
        let copied = self.specimens.iter().find(|(.., other)| *other == content);
        if let Some((other, ..)) = copied {
            return Err(Failure::usage(format!(
                "'{name}' holds the same as '{other}': --summary accepts each specimen once"
            )));
        }
        self.specimens.push((name.clone(), kind, content));
        self.inputs.extend(records);
        Ok(())
    }

    fn add(&mut self, input: &Input) -> Result<(), Failure> {
        if self.wanted {
            self.inputs.extend(input.records()?);
        }
        Ok(())
    }

    fn finish(&self) -> Record {
        let (tool, version) = (env!("CARGO_PKG_NAME"), env!("CARGO_PKG_VERSION"));
        Record::new(tool, version, self.inputs.clone())
    }
}

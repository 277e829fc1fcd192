//! Figures and Table 2 from the tools' outputs: see `lib/figures`.

mod arguments;
mod inputs;
mod picture;
mod values;

use std::process::ExitCode;

use cli::{Failure, Output, Record};
use figures::{
    Case, CellErrors, Closing, Cut, Drawing, Error, Labelled, Movie, Response, Setup, ShearRates,
    Slices, Table2, Views, WpMap, penetrations, pores,
};
use particle_file::{by_time, states_of_run};

use arguments::{Arguments, Figure, MovieArgs, SliceArgs, Table2Args};
use inputs::Inputs;
use picture::Picture;
use values::{Format, Target};

fn main() -> ExitCode {
    cli::main(Arguments::common, run)
}

fn run(arguments: Arguments) -> Result<(), Failure> {
    match arguments.figure {
        Figure::Pressure(a) => {
            let runs = a.run.len();
            let inputs = Inputs::of_runs(a.run.into_iter().chain(a.finer).collect())?;
            let (run, finer) = inputs.files().split_at(runs);
            let limit = a.limit.map(|pressure| pressure.0);
            let title = a.title.as_deref().unwrap_or_default();
            let figure = Closing::read(run, finer, limit, title).map_err(failure)?;
            write(&figure.on(a.picture.page()).draw(), &a.picture, &inputs)
        }
        Figure::Map(a) => {
            let inputs = Inputs::new(a.map)?.marked()?;
            let figure = WpMap::read(inputs.files()).map_err(failure)?;
            write(&figure.on(a.picture.page()).draw(), &a.picture, &inputs)
        }
        Figure::Shear(a) => {
            let inputs = Inputs::new(a.files)?.marked()?;
            let figure = ShearRates::read(inputs.files()).map_err(failure)?;
            write(&figure.on(a.picture.page()).draw(), &a.picture, &inputs)
        }
        Figure::Penetration(a) => {
            let inputs = Inputs::of_runs(a.files)?.marked()?;
            let plot = penetrations(inputs.files(), a.show.into())
                .map_err(failure)?
                .on(a.picture.page());
            write(&plot.draw().map_err(failure)?, &a.picture, &inputs)
        }
        Figure::Pores(a) => {
            let inputs = Inputs::new(a.files)?;
            let plot = pores(inputs.files()).map_err(failure)?.on(a.picture.page());
            write(&plot.draw().map_err(failure)?, &a.picture, &inputs)
        }
        Figure::Response(a) => {
            let inputs = Inputs::new(vec![a.sweep])?;
            let figure = Response::read(&inputs.files()[0], &a.result, a.error).map_err(failure)?;
            write(&figure.on(a.picture.page()).draw(), &a.picture, &inputs)
        }
        Figure::Slice(a) => slice(a),
        Figure::Setup(a) => {
            let inputs = Inputs::new(vec![a.specimen, a.bond])?;
            let files = inputs.files();
            let figure = Setup::read(&files[0], &files[1]).map_err(failure)?;
            write(&figure.on(a.picture.page()).draw(), &a.picture, &inputs)
        }
        Figure::View(a) => {
            let inputs = Inputs::new(a.files)?.marked()?;
            let (wood, from) = (a.look.wood.into(), a.look.from());
            let figure = Views::read(inputs.files(), wood, from).map_err(failure)?;
            write(&figure.on(a.picture.page()).draw(), &a.picture, &inputs)
        }
        Figure::Movie(a) => movie(&a),
        Figure::Table2(a) => table2(a),
    }
}

fn slice(a: SliceArgs) -> Result<(), Failure> {
    let inputs = Inputs::new(a.files)?.marked()?;
    let cut = Cut {
        axis: a.normal,
        position: a.at,
    };
    let mut figure = Slices::read(inputs.files(), cut, a.colour.into()).map_err(failure)?;
    let voxel = figure.voxel_m();
    if let Some(part) = a.part {
        let part = part.map(|ends| ends.map(|end| end.si(voxel)));
        figure = figure.part(part).map_err(failure)?;
    }
    if let Some(cell) = a.grid {
        figure = figure.grid(cell.si(voxel)).map_err(failure)?;
    }
    write(&figure.on(a.picture.page()).draw(), &a.picture, &inputs)
}

fn movie(a: &MovieArgs) -> Result<(), Failure> {
    let states = states_of_run(&a.run.path)
        .and_then(by_time)
        .map_err(Failure::data)?;
    let named = states.into_iter().map(|path| Labelled {
        label: a.run.label.clone(),
        path,
    });
    let inputs = Inputs::new(named.collect())?;
    inputs.keep_from([&a.output])?;
    let movie = Movie::read(inputs.files(), a.look.wood.into(), a.look.from()).map_err(failure)?;
    let png = movie.on(a.print.page()).to_png(a.rate).map_err(failure)?;
    (a.output).write_with_record(&inputs.record()?, |out| out.write_all(&png))
}

fn table2(a: Table2Args) -> Result<(), Failure> {
    let (inputs, cases) = Inputs::of_cases(a.cases())?;
    let pictures = a.picture.iter().map(|target| &target.output);
    inputs.keep_from([&a.output].into_iter().chain(&a.errors).chain(pictures))?;
    let table = Table2::read(&cases).map_err(failure)?.with_paper(a.paper);
    let errors = errors(&a, &cases[a.experiments()..])?;
    let mut text = table.to_text();
    text.extend(errors.iter().map(CellErrors::to_text));
    // The CSV may itself go to standard output; the text for reading then gives way.
    match &a.output {
        Output::Stdout => cli::note(text.trim_end()),
        Output::File(_) => cli::print(&text)?,
    }
    let record = inputs.record()?;
    if let (Some(output), Some(errors)) = (&a.errors, &errors) {
        output.write_with_record(&record, |out| errors.write_csv(out))?;
    }
    let drawing = table.draw(&a.name.iter().cloned().collect(), a.print.page());
    write_all(&drawing, &a.picture, &record)?;
    a.output
        .write_with_record(&record, |out| table.write_csv(out))
}

/// What finer runs say of the errors of `runs`.
fn errors(arguments: &Table2Args, runs: &[Case]) -> Result<Option<CellErrors>, Failure> {
    if arguments.errors.as_ref() == Some(&Output::Stdout) {
        return Err(Failure::usage("--errors goes to a file, not to '-'"));
    }
    let errors = match runs {
        [] => None,
        runs => CellErrors::read(runs).map_err(failure)?,
    };
    if arguments.errors.is_some() && errors.is_none() {
        return Err(Failure::usage(
            "--errors: no run has an error; give the table that wp-metrics --finer writes",
        ));
    }
    Ok(errors)
}

/// Writes the picture to each of its outputs.
fn write(drawing: &Drawing, picture: &Picture, inputs: &Inputs) -> Result<(), Failure> {
    inputs.keep_from(picture.output.iter().map(|target| &target.output))?;
    write_all(drawing, &picture.output, &inputs.record()?)
}

fn write_all(drawing: &Drawing, targets: &[Target], record: &Record) -> Result<(), Failure> {
    for target in targets {
        let bytes = match target.format {
            Format::Svg => drawing.to_svg().map_err(failure)?.into_bytes(),
            Format::Png => drawing.to_png().map_err(failure)?,
            Format::Pdf => drawing.to_pdf().map_err(failure)?,
        };
        let write = |out: &mut dyn std::io::Write| out.write_all(&bytes);
        target.output.write_with_record(record, write)?;
    }
    Ok(())
}

fn failure(error: Error) -> Failure {
    match error {
        Error::Data(_) => Failure::data(error),
        Error::Request(_) => Failure::usage(error),
        Error::Draw(_) => Failure::failed(error),
    }
}

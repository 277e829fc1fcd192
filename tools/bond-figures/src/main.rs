//! Figures and Table 2 from the tools' outputs: see `lib/figures`.

mod arguments;

use std::path::PathBuf;
use std::process::ExitCode;

use cli::{Failure, InputRecord, Output, Record};
use figures::{Closing, Cut, Drawing, Error, Labelled, ShearRates, Slices, Table2, WpMap};

use arguments::{Arguments, Figure, Format, Picture};

fn main() -> ExitCode {
    cli::main(Arguments::common, run)
}

fn run(arguments: Arguments) -> Result<(), Failure> {
    match arguments.figure {
        Figure::Pressure(a) => {
            let files = histories(&a.run);
            let limit = a.limit.map(|pressure| pressure.0);
            let figure = Closing::read(&files, limit, a.title.as_deref().unwrap_or_default());
            write(&figure.map_err(failure)?.draw(), &a.picture, &files)
        }
        Figure::Map(a) => {
            let figure = WpMap::read(&a.map).map_err(failure)?;
            write(&figure.draw(), &a.picture, &a.map)
        }
        Figure::Shear(a) => {
            let figure = ShearRates::read(&a.files).map_err(failure)?;
            write(&figure.draw(), &a.picture, &a.files)
        }
        Figure::Slice(a) => {
            let cut = Cut {
                axis: a.normal,
                position: a.at,
            };
            let figure = Slices::read(&a.files, cut, a.colour.into()).map_err(failure)?;
            write(&figure.draw(), &a.picture, &a.files)
        }
        Figure::Table2(a) => {
            let cases = a.cases();
            let table = Table2::read(&cases).map_err(failure)?;
            let record = record(cases.iter().map(|case| &case.path))?;
            // The CSV may itself go to standard output; the text for reading then gives way.
            match &a.output {
                Output::Stdout => cli::note(table.to_text().trim_end()),
                Output::File(_) => {
                    Output::Stdout.write(|out| out.write_all(table.to_text().as_bytes()))?;
                }
            }
            a.output
                .write_with_record(&record, |out| table.write_csv(out))
        }
    }
}

/// The history of each run: a run folder stands for its `history.csv`.
fn histories(runs: &[Labelled]) -> Vec<Labelled> {
    let history = |run: &Labelled| Labelled {
        label: run.label.clone(),
        path: if run.path.is_dir() {
            run.path.join("history.csv")
        } else {
            run.path.clone()
        },
    };
    runs.iter().map(history).collect()
}

/// Writes the picture to each of its outputs.
fn write(drawing: &Drawing, picture: &Picture, inputs: &[Labelled]) -> Result<(), Failure> {
    let record = record(inputs.iter().map(|input| &input.path))?;
    for target in &picture.output {
        let bytes = match target.format {
            Format::Svg => drawing.to_svg().map_err(failure)?.into_bytes(),
            Format::Png => drawing.to_png().map_err(failure)?,
        };
        let write = |out: &mut dyn std::io::Write| out.write_all(&bytes);
        target.output.write_with_record(&record, write)?;
    }
    Ok(())
}

fn record<'a>(inputs: impl Iterator<Item = &'a PathBuf>) -> Result<Record, Failure> {
    let hashed = inputs.map(|path| {
        InputRecord::of_file(path)
            .map_err(|e| Failure::data(format!("cannot read '{}': {e}", path.display())))
    });
    let (tool, version) = (env!("CARGO_PKG_NAME"), env!("CARGO_PKG_VERSION"));
    Ok(Record::new(
        tool,
        version,
        hashed.collect::<Result<_, _>>()?,
    ))
}

fn failure(error: Error) -> Failure {
    match error {
        Error::Data(_) => Failure::data(error),
        Error::Request(_) => Failure::usage(error),
        Error::Draw(_) => Failure::failed(error),
    }
}

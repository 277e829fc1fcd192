//! Figures and Table 2 from the tools' outputs: see `lib/figures`.

mod arguments;
mod inputs;

use std::process::ExitCode;

use cli::{Failure, Output};
use figures::{Closing, Cut, Drawing, Error, ShearRates, Slices, Table2, WpMap};

use arguments::{Arguments, Figure, Format, Picture};
use inputs::Inputs;

fn main() -> ExitCode {
    cli::main(Arguments::common, run)
}

fn run(arguments: Arguments) -> Result<(), Failure> {
    match arguments.figure {
        Figure::Pressure(a) => {
            let inputs = Inputs::of_runs(a.run)?;
            let limit = a.limit.map(|pressure| pressure.0);
            let title = a.title.as_deref().unwrap_or_default();
            let figure = Closing::read(inputs.files(), limit, title).map_err(failure)?;
            write(&figure.draw(), &a.picture, &inputs)
        }
        Figure::Map(a) => {
            let inputs = Inputs::new(a.map)?;
            let figure = WpMap::read(inputs.files()).map_err(failure)?;
            write(&figure.draw(), &a.picture, &inputs)
        }
        Figure::Shear(a) => {
            let inputs = Inputs::new(a.files)?;
            let figure = ShearRates::read(inputs.files()).map_err(failure)?;
            write(&figure.draw(), &a.picture, &inputs)
        }
        Figure::Slice(a) => {
            let inputs = Inputs::new(a.files)?;
            let cut = Cut {
                axis: a.normal,
                position: a.at,
            };
            let figure = Slices::read(inputs.files(), cut, a.colour.into()).map_err(failure)?;
            write(&figure.draw(), &a.picture, &inputs)
        }
        Figure::Table2(a) => {
            let (inputs, cases) = Inputs::of_cases(a.cases())?;
            inputs.keep_from([&a.output])?;
            let table = Table2::read(&cases).map_err(failure)?;
            // The CSV may itself go to standard output; the text for reading then gives way.
            match &a.output {
                Output::Stdout => cli::note(table.to_text().trim_end()),
                Output::File(_) => cli::print(&table.to_text())?,
            }
            let record = inputs.record()?;
            a.output
                .write_with_record(&record, |out| table.write_csv(out))
        }
    }
}

/// Writes the picture to each of its outputs.
fn write(drawing: &Drawing, picture: &Picture, inputs: &Inputs) -> Result<(), Failure> {
    inputs.keep_from(picture.output.iter().map(|target| &target.output))?;
    let record = inputs.record()?;
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

fn failure(error: Error) -> Failure {
    match error {
        Error::Data(_) => Failure::data(error),
        Error::Request(_) => Failure::usage(error),
        Error::Draw(_) => Failure::failed(error),
    }
}

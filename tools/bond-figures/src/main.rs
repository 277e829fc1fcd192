//! Figures and Table 2 from the tools' outputs: see `lib/figures`.

mod arguments;
mod inputs;
mod picture;
mod values;

use std::process::ExitCode;

use cli::{Failure, Output, Record};
use figures::{
    Cut, Drawing, Error, Labelled, Slices, Table2, Views, closing, penetrations, pores, response,
    setup, shear_rates, wp_maps,
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
    let (inputs, picture, drawing) = match arguments.figure {
        Figure::Movie(a) => return movie(&a),
        Figure::Table2(a) => return table2(&a),
        Figure::Pressure {
            run,
            finer,
            limit,
            title,
            picture,
        } => {
            let runs = run.len();
            let inputs = Inputs::of_runs([run, finer].concat())?;
            let (run, finer) = inputs.files().split_at(runs);
            let title = title.unwrap_or_default();
            let drawing = closing(run, finer, limit, &title, picture.print.page());
            (inputs, picture, drawing)
        }
        Figure::Map { map, picture } => {
            let inputs = Inputs::new(map)?.marked()?;
            let drawing = wp_maps(inputs.files(), picture.print.page());
            (inputs, picture, drawing)
        }
        Figure::Shear { files, picture } => {
            let inputs = Inputs::new(files)?.marked()?;
            let drawing = shear_rates(inputs.files(), picture.print.page());
            (inputs, picture, drawing)
        }
        Figure::Penetration {
            files,
            show,
            picture,
        } => {
            let inputs = Inputs::of_runs(files)?.marked()?;
            let plot = penetrations(inputs.files(), show);
            let drawing = plot.and_then(|plot| plot.draw(picture.print.page()));
            (inputs, picture, drawing)
        }
        Figure::Pores { files, picture } => {
            let inputs = Inputs::new(files)?;
            let plot = pores(inputs.files());
            let drawing = plot.and_then(|plot| plot.draw(picture.print.page()));
            (inputs, picture, drawing)
        }
        Figure::Response {
            sweep,
            result,
            error,
            picture,
        } => {
            let inputs = Inputs::new(vec![sweep])?;
            let drawing = response(&inputs.files()[0], &result, error, picture.print.page());
            (inputs, picture, drawing)
        }
        Figure::Slice(a) => slice(a)?,
        Figure::Setup {
            specimen,
            bond,
            picture,
        } => {
            let inputs = Inputs::new(vec![specimen, bond])?;
            let [specimen, bond] = [0, 1].map(|i| &inputs.files()[i]);
            let drawing = setup(specimen, bond, picture.print.page());
            (inputs, picture, drawing)
        }
        Figure::View {
            files,
            look,
            picture,
        } => {
            let inputs = Inputs::new(files)?.marked()?;
            let views = Views::read(inputs.files(), look.wood, look.from());
            let drawing = views.map(|views| views.draw(picture.print.page()));
            (inputs, picture, drawing)
        }
    };
    let drawing = drawing.map_err(failure)?;
    inputs.keep_from(picture.output.iter().map(|target| &target.output))?;
    write(&drawing, &picture.output, &inputs.record()?)
}

/// What a figure is made of, where it goes and how it came out.
type Drawn = (Inputs, Picture, Result<Drawing, Error>);

fn slice(a: SliceArgs) -> Result<Drawn, Failure> {
    let inputs = Inputs::new(a.files)?.marked()?;
    let cut = Cut {
        axis: a.normal,
        position: a.at,
    };
    let mut slices = Slices::read(inputs.files(), cut, a.colour);
    let voxel = slices.as_ref().map_or(f64::NAN, Slices::voxel_m);
    if let Some(part) = a.part {
        let part = part.map(|ends| ends.map(|end| end.si(voxel)));
        slices = slices.and_then(|slices| slices.part(part));
    }
    if let Some(cell) = a.grid {
        slices = slices.and_then(|slices| slices.grid(cell.si(voxel)));
    }
    let drawing = slices.map(|slices| slices.draw(a.picture.print.page()));
    Ok((inputs, a.picture, drawing))
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
    let (wood, from) = (a.look.wood, a.look.from());
    let png = figures::movie(inputs.files(), wood, from, a.print.page(), a.rate);
    let png = png.map_err(failure)?;
    (a.output).write_with_record(&inputs.record()?, |out| out.write_all(&png))
}

fn table2(a: &Table2Args) -> Result<(), Failure> {
    let (inputs, cases) = Inputs::of_cases(a.cases())?;
    let pictures = a.picture.iter().map(|target| &target.output);
    inputs.keep_from([&a.output].into_iter().chain(&a.errors).chain(pictures))?;
    let table = Table2::read(&cases).map_err(failure)?.with_paper(a.paper);
    let has_errors = table.has_cell_errors();
    match &a.errors {
        Some(Output::Stdout) => {
            return Err(Failure::usage("--errors goes to a file, not to '-'"));
        }
        Some(_) if !has_errors => {
            return Err(Failure::usage(
                "--errors: no run has an error; give the table that wp-metrics --finer writes",
            ));
        }
        _ => {}
    }
    let mut text = table.to_text();
    if has_errors {
        text += &table.cell_errors_to_text();
    }
    // The CSV may itself go to standard output; the text for reading then gives way.
    match &a.output {
        Output::Stdout => cli::note(text.trim_end()),
        Output::File(_) => cli::print(&text)?,
    }
    let record = inputs.record()?;
    if let Some(output) = &a.errors {
        output.write_with_record(&record, |out| table.write_cell_errors(out))?;
    }
    let drawing = table.draw(&a.name.iter().cloned().collect(), a.print.page());
    write(&drawing, &a.picture, &record)?;
    (a.output).write_with_record(&record, |out| table.write_csv(out))
}

/// Writes the picture to each of its outputs.
fn write(drawing: &Drawing, targets: &[Target], record: &Record) -> Result<(), Failure> {
    for target in targets {
        let bytes = match target.format {
            Format::Svg => drawing.to_svg().map(String::into_bytes),
            Format::Png => drawing.to_png(),
            Format::Pdf => drawing.to_pdf(),
        };
        let bytes = bytes.map_err(failure)?;
        (target.output).write_with_record(record, |out| out.write_all(&bytes))?;
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

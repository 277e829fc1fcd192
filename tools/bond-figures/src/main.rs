//! Figures and Table 2 from the tools' outputs: see `lib/figures`.

mod arguments;
mod inputs;
mod picture;
mod values;

use std::process::ExitCode;

use cli::{Failure, Output, Progress, Record};
use figures::{
    Cut, Drawing, Error, Labelled, Page, Slices, Table2, Views, closing, penetrations, pores,
    response, setup, shear_rates, wp_maps,
};
use particle_file::{by_time, states_of_run};

use arguments::{Arguments, Figure, MovieArgs, SliceArgs, Table2Args};
use inputs::Inputs;
use picture::Picture;
use values::Target;

fn main() -> ExitCode {
    cli::main(|a: &Arguments| &a.common, run)
}

fn run(arguments: Arguments) -> Result<(), Failure> {
    match arguments.figure {
        Figure::Movie(a) => movie(&a),
        Figure::Table2(a) => table2(&a),
        Figure::Pressure {
            run,
            finer,
            limit,
            title,
            picture,
        } => {
            let (runs, mut run) = (run.len(), run);
            // A finer run has the label of its run.
            if finer.is_empty() {
                Labelled::tell_apart(&mut run);
            }
            let inputs = Inputs::of_runs([run, finer].concat())?;
            drawn(&inputs, &picture, |files, page| {
                let (run, finer) = files.split_at(runs);
                closing(run, finer, limit, &title.unwrap_or_default(), page)
            })
        }
        Figure::Map { map, picture } => drawn(&Inputs::new(map)?.marked()?, &picture, wp_maps),
        Figure::Shear { files, picture } => {
            drawn(&Inputs::new(files)?.marked()?, &picture, shear_rates)
        }
        Figure::Penetration {
            files,
            show,
            picture,
        } => {
            let inputs = Inputs::of_runs(files)?.marked()?;
            drawn(&inputs, &picture, |files, page| {
                penetrations(files, show)?.draw(page)
            })
        }
        Figure::Pores { files, picture } => {
            drawn(&Inputs::new(files)?.marked()?, &picture, |files, page| {
                pores(files)?.draw(page)
            })
        }
        Figure::Response {
            sweep,
            result,
            error,
            picture,
        } => drawn(&Inputs::new(vec![sweep])?, &picture, |files, page| {
            response(&files[0], result.as_deref(), error, page)
        }),
        Figure::Slice(a) => slice(a),
        Figure::Setup {
            specimen,
            bond,
            picture,
        } => {
            let inputs = Inputs::new(vec![specimen, bond])?;
            drawn(&inputs, &picture, |files, page| {
                setup(&files[0], &files[1], page)
            })
        }
        Figure::View {
            files,
            look,
            picture,
        } => drawn(&Inputs::new(files)?.marked()?, &picture, |files, page| {
            Ok(Views::read(files, look.wood, look.from())?.draw(page))
        }),
    }
}

/// Draws what is made of the files and writes it.
fn drawn(
    inputs: &Inputs,
    picture: &Picture,
    draw: impl FnOnce(&[Labelled], Page) -> Result<Drawing, Error>,
) -> Result<(), Failure> {
    let drawing = draw(inputs.files(), picture.print.page()).map_err(failure)?;
    inputs.keep_from(picture.output.iter().map(|target| &target.output))?;
    write(&drawing, &picture.output, &inputs.record()?)
}

fn slice(a: SliceArgs) -> Result<(), Failure> {
    let cut = Cut {
        axis: a.normal,
        position: a.at,
    };
    drawn(
        &Inputs::new(a.files)?.marked()?,
        &a.picture,
        |files, page| {
            let mut slices = Slices::read(files, cut, a.colour)?;
            let voxel = slices.voxel_m();
            if let Some(part) = a.part {
                slices = slices.part(part.map(|ends| ends.map(|end| end.si(voxel))))?;
            }
            if let Some(cell) = a.grid {
                slices = slices.grid(cell.si(voxel))?;
            }
            Ok(slices.draw(page))
        },
    )
}

fn movie(a: &MovieArgs) -> Result<(), Failure> {
    let states = states_of_run(&a.run.path)
        .and_then(by_time)
        .map_err(Failure::data)?;
    let named = states.into_iter().map(|(path, _)| Labelled {
        label: a.run.label.clone(),
        path,
    });
    let inputs = Inputs::new(named.collect())?;
    inputs.keep_from([&a.output])?;
    warn_of([a.run.label.as_str()].into_iter());
    let (wood, from) = (a.look.wood, a.look.from());
    let (count, mut progress) = (inputs.files().len(), Progress::new("drawing the movie"));
    let on_frame = |done| {
        let end = ("done, {} left", done as f64 / count as f64);
        progress.update(&[end], || format!("frame {done} of {count}"));
    };
    let page = a.print.page();
    let png = figures::movie(inputs.files(), wood, from, page, a.rate, on_frame);
    progress.finish();
    let png = png.map_err(failure)?;
    (a.output).write_with_record(&inputs.record()?, |out| out.write_all(&png))
}

fn table2(a: &Table2Args) -> Result<(), Failure> {
    let mut cases = [&a.experiment[..], &a.run].concat();
    let inputs = Inputs::of_cases(&mut cases)?;
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
    if targets.iter().any(|target| !target.keeps_text) {
        let boxes = drawing.text_boxes();
        warn_of(boxes.iter().map(|one| one.text.as_str()));
    }
    for target in targets {
        let bytes = (target.render)(drawing).map_err(failure)?;
        (target.output).write_with_record(record, |out| out.write_all(&bytes))?;
    }
    Ok(())
}

/// Says which characters a PNG or PDF does not show.
fn warn_of<'a>(texts: impl Iterator<Item = &'a str>) {
    let missing = figures::undrawn(texts);
    if !missing.is_empty() {
        cli::warn(format_args!(
            "the font of PNG and PDF does not show '{missing}': boxes, or letters that stand alone, are in their place; an SVG keeps the text"
        ));
    }
}

fn failure(error: Error) -> Failure {
    match error {
        Error::Data(_) => Failure::data(error),
        Error::Request(_) => Failure::usage(error),
        Error::Draw(_) => Failure::failed(error),
    }
}

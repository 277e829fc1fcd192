//! A label stack as a particle file of a specimen.

mod arguments;
mod doubt;
mod report;

use std::fs::File;
use std::io::Read;
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use arguments::Arguments;
use bondline::{PlacedVoxels, Specimen};
use cli::{Failure, Output, Progress};
use figures::{Cut, Page, Position, Slices};
use metrics::Tilt;
use particle_file::{Block, Draft, Header, Kind, Material, ParticleFile, Provenance};
use rayon::prelude::*;
use units::Axis;
use voxels::{
    Crop, GreyLevels, Histogram, Phases, Proposal, Segmented, Source, Stack, VoxelEdge, segment,
};

fn main() -> ExitCode {
    cli::main(|a: &Arguments| &a.common, run)
}

fn run(arguments: Arguments) -> Result<(), Failure> {
    let stack = open(&arguments).map_err(failure)?;
    stack.gap().into_iter().for_each(cli::warn);
    let Arguments {
        output,
        histogram,
        preview,
        ..
    } = &arguments;
    cli::keep_apart(
        stack.sources().iter().map(Source::path),
        output.iter().chain(histogram).chain(preview),
    )?;
    let crop = kept(&stack, &arguments);
    let denoised = denoised(&stack, &crop, &arguments)?;
    let whole = Crop::whole(crop.dims());
    let (values, kept) = match &denoised {
        Some(denoised) => (denoised, &whole),
        None => (&stack, &crop),
    };
    let proposed = proposal(values, kept, &arguments)?;
    if output.is_none() && preview.is_none() {
        return Ok(());
    }
    let edge = VoxelEdge::resolve(arguments.voxel, stack.voxel_size(), stack.name());
    let edge = edge.map_err(failure)?;
    report::stack(&stack, &crop, &edge);
    looks_wrong(edge.doubt(), arguments.yes_really || edge.is_believed())?;
    let phases = match (&arguments.labels, &arguments.grey, proposed) {
        (Some(labels), _, _) => Phases::Labels(labels.clone()),
        (None, Some(GreyLevels::Given(grey)), _) => Phases::Grey(grey.clone()),
        (None, Some(_), Some(proposed)) => {
            let wrong = |why| Failure::usage(format!("{}: {why}", stack.name()));
            Phases::Grey(proposed.map_err(wrong)?.grey)
        }
        _ => Phases::Guess,
    };
    // Hashing a large file takes minutes: what cannot be read is refused before.
    voxels::check(&stack, &phases, &crop).map_err(failure)?;
    let hashed = output.as_ref().map_or(&[][..], |_| stack.sources());
    let (segmented, inputs) = rayon::join(|| read_pages(values, &phases, kept), || hashes(hashed));
    let (mut segmented, inputs) = (segmented?, inputs?);
    if let Some(most) = arguments.despeckle {
        report::despeckled(&segmented.despeckle(most.into()), most);
    } else if let Phases::Grey(_) = phases {
        report::noise(&segmented);
    }
    if let Some(normal) = arguments.level {
        let refused = |why| Failure::usage(format!("{}: --level {normal}: {why}", stack.name()));
        let tilt = level(&mut segmented, normal, &edge).map_err(refused)?;
        report::level(&tilt, segmented.wood.dims());
    }
    if let Phases::Grey(grey) = &phases {
        let prepared = |segmented: &mut Segmented| {
            if let Some(most) = arguments.despeckle {
                segmented.despeckle(most.into());
            }
            let level = |normal| level(segmented, normal, &edge).map(|_| ());
            arguments.level.map_or(Ok(()), level)
        };
        let doubt = Histogram::of(values, kept).map_err(failure)?.doubt(grey);
        if doubt.share > 0.0 {
            let bond = (edge.metres, across(&arguments));
            let moved = doubt::moved((values, kept), (grey, doubt), bond, prepared);
            let cure = match arguments.denoise {
                true => "look at it by --preview",
                false => "--denoise takes noise out",
            };
            report::doubt(doubt, &moved.map_err(failure)?, cure);
        }
    }
    report::phases(&segmented, edge.metres, across(&arguments));
    let draft = draft(&segmented, &edge, &crop, &arguments, inputs);
    if let Some(preview) = preview {
        draw(&draft, (values, kept), &phases, &arguments, preview)?;
    }
    let cure = "check with --preview, or exchange the two in --labels or --grey";
    let swapped = segmented.swapped().map(|said| format!("{said}; {cure}"));
    looks_wrong(swapped, arguments.yes_really)?;
    output
        .as_ref()
        .map_or(Ok(()), |output| output.write(|out| draft.write_to(out)))
}

/// The grey values that are proposed, where that is asked for; the histogram is written.
fn proposal(
    stack: &Stack,
    crop: &Crop,
    arguments: &Arguments,
) -> Result<Option<Result<Proposal, String>>, Failure> {
    let given = matches!(arguments.grey, None | Some(GreyLevels::Given(_)));
    if given && arguments.histogram.is_none() {
        return Ok(None);
    }
    let histogram = Histogram::of(stack, crop).map_err(failure)?;
    if let Some(output) = &arguments.histogram {
        output.write(|out| {
            writeln!(out, "grey,voxels")?;
            (histogram.values()).try_for_each(|(grey, voxels)| writeln!(out, "{grey},{voxels}"))
        })?;
    }
    let proposed = histogram.propose(arguments.grey == Some(GreyLevels::AutoWood));
    report::proposal(&proposed);
    Ok(Some(proposed))
}

/// The part of a stack that is kept.
fn kept(stack: &Stack, arguments: &Arguments) -> Crop {
    (arguments.crop.clone()).unwrap_or_else(|| Crop::whole(stack.dims()))
}

/// The axis across the bond.
fn across(arguments: &Arguments) -> Axis {
    arguments.level.unwrap_or(Axis::Y)
}

/// Turns a specimen until its bond plane is level across `normal`; its tilt before, or why it cannot.
fn level(segmented: &mut Segmented, normal: Axis, edge: &VoxelEdge) -> Result<Tilt, String> {
    let parts = [&segmented.wood, &segmented.adhesive];
    let [wood, adhesive] = parts.map(|bits| PlacedVoxels::at_origin(bits.view(), edge.metres));
    let specimen = Specimen::new(wood, adhesive).map_err(|why| why.to_string())?;
    let turned = metrics::level(&specimen, normal)?;
    (segmented.wood, segmented.adhesive) = (turned.wood, turned.adhesive);
    Ok(turned.tilt)
}

/// Refuses what looks wrong, or warns of it where it is to go on `really`.
fn looks_wrong(said: Option<String>, really: bool) -> Result<(), Failure> {
    match said {
        None => Ok(()),
        Some(said) if really => {
            cli::warn(said);
            Ok(())
        }
        Some(said) => Err(Failure::usage(format!(
            "{said}; --yes-really continues anyway"
        ))),
    }
}

/// Draws the phases of a specimen in cuts through its middle, normal to z, y and x, beside the grey values that they were
/// taken from.
fn draw(
    draft: &Draft,
    (stack, crop): (&Stack, &Crop),
    phases: &Phases,
    arguments: &Arguments,
    preview: &Output,
) -> Result<(), Failure> {
    let by_grey = matches!(phases, Phases::Grey(_));
    let turned = by_grey && arguments.level.is_some();
    if turned {
        cli::note("preview     without grey values: --level turns only labels");
    }
    let greys = (by_grey && !turned).then(|| stack.middle_cuts(crop));
    let greys = greys.transpose().map_err(failure)?;
    let name = arguments.stack[0].file_name().unwrap_or_default();
    let mut bytes = Vec::new();
    draft.write_to(&mut bytes).map_err(Failure::failed)?;
    let file = ParticleFile::from_bytes(&bytes).map_err(Failure::failed)?;
    let header = file.header();
    let cuts = [Axis::Z, Axis::Y, Axis::X].map(|axis| {
        let a = axis.index();
        let layer = (header.box_max_m[a] / header.voxel_m).round() as usize / 2;
        let position = Position::At((layer as f64 + 0.5) * header.voxel_m);
        (
            Cut { axis, position },
            greys.as_ref().map(|greys| &greys[a][..]),
        )
    });
    let slices = Slices::through(&file, &name.to_string_lossy(), &cuts).map_err(Failure::failed)?;
    let png = slices
        .draw(Page::default())
        .to_png()
        .map_err(Failure::failed)?;
    preview.write(|out| out.write_all(&png))
}

fn open(arguments: &Arguments) -> Result<Stack, voxels::Error> {
    let (Some(dims), Some(kind)) = (arguments.dims, arguments.kind) else {
        return Stack::open(&arguments.stack);
    };
    match arguments.stack.as_slice() {
        [path] => Stack::open_raw(path, dims, kind),
        several => Err(voxels::Error::Usage(format!(
            "--dims and --type describe one raw volume, but {} are given",
            several.len()
        ))),
    }
}

fn failure(error: voxels::Error) -> Failure {
    Failure::of_input(error.is_usage(), error)
}

fn read_pages(stack: &Stack, phases: &Phases, crop: &Crop) -> Result<Segmented, Failure> {
    let read = |on_page: &(dyn Fn() + Sync)| segment(stack, phases, crop, on_page);
    shown("reading pages", crop, read).map_err(failure)
}

/// The stack without its noise, where that is asked for.
fn denoised(stack: &Stack, crop: &Crop, arguments: &Arguments) -> Result<Option<Stack>, Failure> {
    let filter = |on_page: &(dyn Fn() + Sync)| stack.denoised(crop, on_page);
    let denoised = (arguments.denoise).then(|| shown("taking noise out", crop, filter));
    denoised.transpose().map_err(failure)
}

/// Result of `work` on the pages of `crop`, with its progress shown.
fn shown<T>(what: &str, crop: &Crop, work: impl FnOnce(&(dyn Fn() + Sync)) -> T) -> T {
    let total = crop.dims()[2];
    let progress = Mutex::new(Progress::new(what));
    let done = AtomicUsize::new(0);
    let made = work(&|| {
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        // A page that finds the bar in use need not wait for it.
        if let Ok(mut progress) = progress.try_lock() {
            let end = ("read, {} left", done as f64 / total as f64);
            progress.update(&[end], || format!("page {done} of {total}"));
        }
    });
    if let Ok(progress) = progress.into_inner() {
        progress.finish();
    }
    made
}

/// Path and hash of every file read.
fn hashes(sources: &[Source]) -> Result<Vec<(String, u64)>, Failure> {
    let hash = |source: &Source| {
        let hash = source.reader().and_then(cli::hash_reader);
        let hash = hash.map_err(|e| Failure::data(format!("cannot read {source}: {e}")))?;
        Ok((source.path().display().to_string(), hash))
    };
    sources.par_iter().map(hash).collect()
}

/// The particle file of a specimen, with its low corner at the origin.
fn draft<'a>(
    specimen: &'a Segmented,
    edge: &VoxelEdge,
    crop: &Crop,
    arguments: &Arguments,
    inputs: Vec<(String, u64)>,
) -> Draft<'a> {
    let high = specimen.wood.dims().map(|n| n as f64 * edge.metres);
    let normal = across(arguments).index() as u8;
    let mut header = Header::new(Kind::Specimen, edge.metres, normal, [0.0; 3], high);
    let crop = (crop.ranges().clone()).map(|range| format!("{}:{}", range.start, range.end));
    header.set_attribute("crop", crop.join(","));
    header.set_attribute("voxel_from", edge.from);
    if let Some(most) = arguments.despeckle {
        header.set_attribute("despeckle", most.to_string());
    }
    if arguments.denoise {
        header.set_attribute("denoise", "median of 3 x 3 x 3 voxels");
    }
    if let Some(normal) = arguments.level {
        header.set_attribute("level", normal.to_string());
    }
    if inputs.first().is_some_and(|(stack, _)| is_grown(stack)) {
        let parts = match specimen.adhesive.count() {
            0 => "wood",
            _ => "wood and adhesive",
        };
        header.set_attribute("synthetic", parts);
    }
    let (tool, version) = (env!("CARGO_PKG_NAME"), env!("CARGO_PKG_VERSION"));
    header.provenance = vec![Provenance::of_process(tool, version, inputs)];

    let block = |name, material, bits| Block::new(name, material, [0.0; 3], edge.metres, bits);
    let wood = block("wood", Material::Rigid, &specimen.wood);
    let adhesive = block("adhesive", Material::Adhesive, &specimen.adhesive);
    Draft::new(header)
        .block(wood, &specimen.wood)
        .block(adhesive, &specimen.adhesive)
}

/// Whether a program grew the stack, by the record beside it.
fn is_grown(stack: &str) -> bool {
    let mut record = String::new();
    let file = File::open(format!("{stack}.provenance.json"));
    let read = file.and_then(|file| file.take(1 << 20).read_to_string(&mut record));
    read.is_ok() && record.contains("\"tool\": \"synth-xct\"")
}

//! A label stack as a particle file of a specimen.

mod report;

use std::io::{self, Write};
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use clap::Parser;
use cli::{Failure, Output, Progress};
use particle_file::{Block, Draft, Header, Kind, Material, Provenance};
use rayon::prelude::*;
use units::{Axis, Length, Quantity};
use voxels::{
    Crop, Dims, Grey, Histogram, Labels, Phases, RawType, Segmented, Source, Stack, VoxelEdge,
    segment,
};

/// Turn a stack of XCT label images into a particle file
///
/// Every voxel of wood or adhesive becomes one material point. The stored sample value is the
/// label, whatever colour an image program shows for it, unless that differs between pages: then
/// the colours are the labels. Pages are z, rows y, columns x.
#[derive(Parser)]
#[command(
    version,
    after_help = "Examples:
  xct2particles bondline.tif --voxel '1.45 um' --labels void=0,wood=128,adhesive=255 -o specimen.mpts
  xct2particles slices/ --voxel 1.45um --grey wood=90..170,adhesive=171.. -o grey.mpts
  xct2particles undamaged.tif --voxel 1.45um --grey auto-wood -o wood.mpts
  xct2particles scan.raw --dims 400x394x400 --type u16 --voxel 1.45um --histogram grey.csv
  xct2particles stack.ome.tif --crop 0:200,50:250,0:100 -o - | wp-metrics -"
)]
struct Arguments {
    /// A multi-page TIFF, .npy, .npz, .mhd, .nrrd or .nii file, a raw volume (--dims), a folder of
    /// TIFF, BMP, PNG or JPEG slices, or several slices; `-` is standard input
    #[arg(required = true, value_name = "STACK")]
    stack: Vec<PathBuf>,
    /// Voxel edge [default: what the stack's metadata state]
    #[arg(long, value_name = "LEN", allow_hyphen_values = true, value_parser = length)]
    voxel: Option<f64>,
    /// Size of a raw volume, x fastest
    #[arg(long, value_name = "XxYxZ", requires = "kind")]
    dims: Option<Dims>,
    /// Number type of a raw volume: u8, i16, f32 ..., little-endian; big-endian as u16be
    #[arg(long = "type", id = "kind", value_name = "TYPE", requires = "dims")]
    kind: Option<RawType>,
    /// Labels of each phase; several as 1|2|7, colours as R:G:B; wood alone has no adhesive
    /// [default: guessed if the stack holds exactly 0, 1, 2 or 0, 128, 255, or, for wood alone,
    /// the first two of either]
    #[arg(long, value_name = "void=L,wood=L,adhesive=L", conflicts_with = "grey")]
    labels: Option<Labels>,
    /// Grey values of wood and adhesive, both ends included, for a stack without labels; wood alone
    /// has no adhesive. auto proposes them (Otsu's two thresholds), to be looked at: wood darker
    /// than adhesive; auto-wood does for wood alone (one threshold)
    #[arg(long, value_name = "auto|auto-wood|wood=A..B,adhesive=C..", value_parser = grey)]
    grey: Option<GreyLevels>,
    /// Write how many voxels hold each grey value (CSV: grey,voxels) and say what --grey auto
    /// would take
    #[arg(long, value_name = "CSV")]
    histogram: Option<Output>,
    /// Box of voxels to keep, the first of a range included and the last not
    #[arg(long, value_name = "x0:x1,y0:y1,z0:z1")]
    crop: Option<Crop>,
    /// Particle file to write; `-` is standard output
    #[arg(
        short,
        long,
        value_name = "FILE",
        required_unless_present = "histogram"
    )]
    output: Option<Output>,
    #[command(flatten)]
    common: cli::Common,
}

/// What `--grey` asks for.
#[derive(Clone)]
enum GreyLevels {
    Auto,
    AutoWood,
    Given(Grey),
}

fn grey(text: &str) -> Result<GreyLevels, String> {
    match text {
        "auto" => Ok(GreyLevels::Auto),
        "auto-wood" => Ok(GreyLevels::AutoWood),
        ranges => ranges.parse().map(GreyLevels::Given),
    }
}

fn length(text: &str) -> Result<f64, String> {
    let length = text
        .parse::<Quantity<Length>>()
        .and_then(Quantity::positive);
    length.map(Quantity::si).map_err(|e| e.to_string())
}

fn main() -> ExitCode {
    cli::main(|a: &Arguments| &a.common, run)
}

fn run(arguments: Arguments) -> Result<(), Failure> {
    let stack = open(&arguments).map_err(failure)?;
    stack.gap().into_iter().for_each(cli::warn);
    cli::keep_apart(
        stack.sources().iter().map(Source::path),
        arguments.output.iter().chain(&arguments.histogram),
    )?;
    let crop = arguments.crop.unwrap_or_else(|| Crop::whole(stack.dims()));
    let bare = matches!(arguments.grey, Some(GreyLevels::AutoWood));
    let auto = bare || matches!(arguments.grey, Some(GreyLevels::Auto));
    let mut proposed = None;
    if auto || arguments.histogram.is_some() {
        let histogram = Histogram::of(&stack, &crop).map_err(failure)?;
        if let Some(output) = &arguments.histogram {
            output.write(|out| write_histogram(&histogram, out))?;
        }
        proposed = Some(if bare {
            histogram.otsu_of_wood()
        } else {
            histogram.otsu()
        });
        report::proposal(&proposed);
    }
    let Some(output) = arguments.output else {
        return Ok(());
    };
    let edge = VoxelEdge::resolve(arguments.voxel, stack.voxel_size(), stack.name());
    let edge = edge.map_err(failure)?;
    report::stack(&stack, &edge);

    let phases = match (arguments.labels, arguments.grey, proposed) {
        (Some(labels), _, _) => Phases::Labels(labels),
        (None, Some(GreyLevels::Given(grey)), _) => Phases::Grey(grey),
        (None, Some(GreyLevels::Auto | GreyLevels::AutoWood), Some(proposed)) => {
            let wrong = |why| Failure::usage(format!("{}: {why}", stack.name()));
            Phases::Grey(proposed.map_err(wrong)?.grey)
        }
        _ => Phases::Guess,
    };
    // Hashing a large file takes minutes: what cannot be read is refused before.
    voxels::check(&stack, &phases, &crop).map_err(failure)?;
    let (segmented, inputs) = rayon::join(
        || read_pages(&stack, &phases, &crop),
        || hashes(stack.sources()),
    );
    let (segmented, inputs) = (segmented?, inputs?);
    report::phases(&segmented, edge.metres);
    write(&output, &segmented, &edge, &crop, inputs)
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

/// `grey,voxels` from the lowest to the highest value found.
fn write_histogram(histogram: &Histogram, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "grey,voxels")?;
    (histogram.values()).try_for_each(|(grey, voxels)| writeln!(out, "{grey},{voxels}"))
}

/// Other arguments may help (exit 2) or the file is at fault (exit 3).
fn failure(error: voxels::Error) -> Failure {
    if error.is_usage() {
        Failure::usage(error)
    } else {
        Failure::data(error)
    }
}

fn read_pages(stack: &Stack, phases: &Phases, crop: &Crop) -> Result<Segmented, Failure> {
    let total = crop.dims()[2];
    let progress = Mutex::new(Progress::new("reading pages"));
    let done = AtomicUsize::new(0);
    let on_page = || {
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        // A page that finds the bar in use need not wait for it.
        if let Ok(mut progress) = progress.try_lock() {
            progress.update(done as f64 / total as f64, || {
                format!("page {done} of {total}")
            });
        }
    };
    let segmented = segment(stack, phases, crop, on_page).map_err(failure);
    if let Ok(progress) = progress.into_inner() {
        progress.finish();
    }
    segmented
}

/// Path and hash of every file read.
fn hashes(sources: &[Source]) -> Result<Vec<(String, u64)>, Failure> {
    let hash = |source: &Source| {
        let hash = source.reader().and_then(cli::hash_reader);
        match hash {
            Ok(hash) => Ok((source.path().display().to_string(), hash)),
            Err(e) => Err(Failure::data(format!("cannot read {source}: {e}"))),
        }
    };
    sources.par_iter().map(hash).collect()
}

/// Writes the specimen with its low corner at the origin.
fn write(
    output: &Output,
    specimen: &Segmented,
    edge: &VoxelEdge,
    crop: &Crop,
    inputs: Vec<(String, u64)>,
) -> Result<(), Failure> {
    let high = specimen.wood.dims().map(|n| n as f64 * edge.metres);
    let normal = Axis::Y.index() as u8;
    let mut header = Header::new(Kind::Specimen, edge.metres, normal, [0.0; 3], high);
    let [x, y, z] = crop.ranges();
    let crop = [x, y, z].map(|range| format!("{}:{}", range.start, range.end));
    header.set_attribute("crop", crop.join(","));
    header.set_attribute("voxel_from", edge.from);
    let (tool, version) = (env!("CARGO_PKG_NAME"), env!("CARGO_PKG_VERSION"));
    header.provenance = vec![Provenance::of_process(tool, version, inputs)];

    let block = |name, material, bits| Block::new(name, material, [0.0; 3], edge.metres, bits);
    let wood = block("wood", Material::Rigid, &specimen.wood);
    let adhesive = block("adhesive", Material::Adhesive, &specimen.adhesive);
    let draft = Draft::new(header)
        .block(wood, &specimen.wood)
        .block(adhesive, &specimen.adhesive);
    output.write(|out| draft.write_to(out))
}

//! A label stack as a particle file of a specimen.

mod report;

use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use clap::Parser;
use cli::{Failure, Output, Progress};
use particle_file::{Block, Draft, Header, Kind, Material, Provenance};
use rayon::prelude::*;
use units::{Axis, Length, Quantity};
use voxels::{Crop, Grey, Labels, Phases, Segmented, Source, Stack, VoxelEdge, segment};

/// Turn a stack of XCT label images into a particle file
///
/// Every voxel of wood or adhesive becomes one material point. The stored sample value is the
/// label, whatever colours an image program shows for it. Pages are z, rows y, columns x.
#[derive(Parser)]
#[command(
    version,
    after_help = "Examples:
  xct2particles bondline.tif --voxel '1.45 um' --labels void=0,wood=128,adhesive=255 -o specimen.mpts
  xct2particles slices/ --voxel 1.45um --grey wood=90..170,adhesive=171.. -o grey.mpts
  xct2particles stack.ome.tif --crop 0:200,50:250,0:100 -o - | wp-metrics -"
)]
struct Arguments {
    /// A multi-page TIFF, .npy or .mhd file, a folder of TIFF slices, or several slices; `-` is standard input
    #[arg(required = true, value_name = "STACK")]
    stack: Vec<PathBuf>,
    /// Voxel edge [default: what the stack's metadata state]
    #[arg(long, value_name = "LEN", allow_hyphen_values = true, value_parser = length)]
    voxel: Option<f64>,
    /// Labels of each phase; several as 1|2|7, colours as R:G:B
    /// [default: guessed if the stack holds exactly 0, 1, 2 or 0, 128, 255]
    #[arg(long, value_name = "void=L,wood=L,adhesive=L", conflicts_with = "grey")]
    labels: Option<Labels>,
    /// Grey values of wood and adhesive, both ends included, for a stack without labels
    #[arg(long, value_name = "wood=A..B,adhesive=C..")]
    grey: Option<Grey>,
    /// Box of voxels to keep, the first of a range included and the last not
    #[arg(long, value_name = "x0:x1,y0:y1,z0:z1")]
    crop: Option<Crop>,
    /// Particle file to write; `-` is standard output
    #[arg(short, long, value_name = "FILE")]
    output: Output,
    #[command(flatten)]
    common: cli::Common,
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
    let stack = Stack::open(&arguments.stack).map_err(failure)?;
    cli::keep_apart(
        stack.sources().iter().map(Source::path),
        [&arguments.output],
    )?;
    let edge = VoxelEdge::resolve(arguments.voxel, stack.voxel_size(), stack.name());
    let edge = edge.map_err(failure)?;
    report::stack(&stack, &edge);

    let phases = match (arguments.labels, arguments.grey) {
        (Some(labels), _) => Phases::Labels(labels),
        (None, Some(grey)) => Phases::Grey(grey),
        (None, None) => Phases::Guess,
    };
    let crop = arguments.crop.unwrap_or_else(|| Crop::whole(stack.dims()));
    let (segmented, inputs) = rayon::join(
        || read_pages(&stack, &phases, &crop),
        || hashes(stack.sources()),
    );
    let (segmented, inputs) = (segmented?, inputs?);
    report::phases(&segmented, edge.metres);
    write(&arguments.output, &segmented, &edge, &crop, inputs)
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

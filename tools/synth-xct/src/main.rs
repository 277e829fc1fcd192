//! A synthetic specimen as a label stack: see `synthetic-wood`.

use std::process::ExitCode;

use clap::Parser;
use cli::{Failure, Output, Record};
use synthetic_wood::{AdhesiveSystem, Anatomy, Recipe, RecipeError, Species, Specimen};
use units::{Angle, Length, positive};
use voxels::{Dims, TiffWriter};

/// Generate a synthetic hybrid poplar specimen with a bond line, or undamaged wood of one of four species, as an 8-bit label stack
///
/// Labels: 0 void, 128 wood, 255 adhesive. Fibres run nearly along z, the bond normal is y. Undamaged wood is cut like a
/// peeled veneer, with rays nearly along y. The adhesive is placed by distance and connectivity, not by a flow simulation.
/// The same arguments give the same bytes.
#[derive(Parser)]
#[command(
    version,
    after_help = "Examples:
  synth-xct --adhesive pf --seed 1 -o pf.tif
  synth-xct --adhesive pva-pf --size 64x128x64 --slab 29um --seed 7 -o small.tif
  synth-xct --adhesive none --species spruce --size 300x600x100 --seed 1 -o spruce.tif
  synth-xct --adhesive pf --size 393x393x400 --seed 1 -o full.tif && xct2particles full.tif -o full.mpts"
)]
struct Arguments {
    /// Adhesive, which gives the default slab (PF 55.1 um, PVA-PF 78.3 um); none is one piece of undamaged wood. Large PF
    /// boxes have adhesive in an isolated tube
    #[arg(long, value_parser = ["pf", "pva-pf", "none"])]
    adhesive: String,
    /// Wood species; only hybrid poplar can have adhesive
    #[arg(long, value_parser = ["hybrid-poplar", "beech", "birch", "spruce"], default_value = "hybrid-poplar")]
    species: String,
    /// Voxels along x, y and z
    #[arg(long, value_name = "XxYxZ", default_value = "48x96x48")]
    size: Dims,
    /// Voxel edge
    #[arg(long, value_name = "LEN", default_value = "1.45 um", allow_hyphen_values = true, value_parser = positive::<Length>)]
    voxel: f64,
    /// Thickness of the slab, adhesive volume over bond area [default: the paper's, at most a sixth of the height]
    #[arg(long, value_name = "LEN", allow_hyphen_values = true, value_parser = positive::<Length>)]
    slab: Option<f64>,
    /// Angle of the fibres against the bond plane, 0 to 30 deg [default: drawn from 3 to 6 deg for each adherend]
    #[arg(long, value_name = "ANGLE", allow_hyphen_values = true, value_parser = units::si::<Angle>)]
    grain_angle: Option<f64>,
    /// Generate it even if the forecast exceeds the available memory
    #[arg(long)]
    yes_really: bool,
    /// Seed of all random choices
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// TIFF file to write; `-` is standard output
    #[arg(short, long, value_name = "FILE")]
    output: Output,
    #[command(flatten)]
    common: cli::Common,
}

fn main() -> ExitCode {
    cli::main(|a: &Arguments| &a.common, run)
}

fn run(arguments: Arguments) -> Result<(), Failure> {
    let recipe = Recipe {
        size: arguments.size.0,
        voxel: arguments.voxel,
        species: match arguments.species.as_str() {
            "beech" => Species::Beech,
            "birch" => Species::Birch,
            "spruce" => Species::Spruce,
            _ => Species::HybridPoplar,
        },
        adhesive: match arguments.adhesive.as_str() {
            "pf" => Some(AdhesiveSystem::Pf),
            "pva-pf" => Some(AdhesiveSystem::PvaPf),
            _ => None,
        },
        slab: arguments.slab,
        grain_angle: arguments.grain_angle,
        seed: arguments.seed,
    };
    cli::keep_apart_with_records([], [&arguments.output])?;
    let [nx, ny, nz] = recipe.size;
    let bytes = recipe.memory_bytes().map_err(Failure::usage)?;
    if let Some(short) = machine::shortage(bytes) {
        let said = format!(
            "a specimen of {nx} x {ny} x {nz} voxels needs {short}; a smaller --size is needed"
        );
        if !arguments.yes_really {
            let really = "--yes-really continues anyway";
            return Err(Failure::usage(format!("{said}; {really}")));
        }
        cli::warn(said);
    }
    let specimen = Specimen::grow(&recipe).map_err(|error| match error {
        RecipeError::Overfull(_) => Failure::failed(error),
        _ => Failure::usage(error),
    })?;
    report(&specimen, &recipe);
    let record = Record::new("synth-xct", env!("CARGO_PKG_VERSION"), Vec::new());
    let adhesive = match recipe.adhesive {
        Some(adhesive) => format!("synthetic {adhesive:?} adhesive"),
        None => "without adhesive".into(),
    };
    let grain = match recipe.grain_angle {
        Some(angle) => format!(", grain angle {:.3} deg", angle.to_degrees()),
        None => String::new(),
    };
    let note = format!(
        "note=SYNTHETIC {}, {adhesive}{grain} (not a scan); seed={}; {} {}",
        recipe.species.name(),
        recipe.seed,
        record.tool,
        record.version
    );
    arguments.output.write_with_record(&record, |out| {
        let mut tiff = TiffWriter::new(out, specimen.size(), recipe.voxel, &note)?;
        for page in specimen.pages() {
            tiff.write_page(&page)?;
        }
        tiff.finish()
    })
}

fn report(specimen: &Specimen, recipe: &Recipe) {
    let anatomy = specimen.anatomy();
    let [nx, ny, nz] = specimen.size();
    // As given: 1.7 um are 1.6999999999999997e-6 m times 1e6.
    let um = (recipe.voxel * 1e15).round() / 1e9;
    cli::note(format_args!(
        "SYNTHETIC specimen, {nx} x {ny} x {nz} voxels of {um} um ({:.0} x {:.0} x {:.0} um), seed {}",
        nx as f64 * um,
        ny as f64 * um,
        nz as f64 * um,
        recipe.seed
    ));
    let targets = recipe.species.targets();
    for ((name, target), value) in Anatomy::NAMES.iter().zip(targets).zip(anatomy.values) {
        let Some(target) = target else { continue };
        let [low, high] = target.range;
        // A page too small to hold a whole vessel or ray shows none.
        let measured = match value {
            0.0 => "none met".into(),
            value => format!("{:+.0} %", 100.0 * (value / target.value - 1.0)),
        };
        cli::note(format_args!(
            "  {name:<20} {value:>8.3}   {} {low} to {high}, usually {} ({measured})",
            recipe.species.name(),
            target.value,
        ));
    }
    if recipe.adhesive.is_none() {
        return;
    }
    let [gap, wood, tube] = anatomy.adhesive_voxels;
    cli::note(format_args!(
        "  {:<20} {:>8.4e} m3 = slab of {:.2} um; {gap} voxels in the gap, {wood} in the wood, {tube} in an isolated tube",
        "adhesive",
        anatomy.adhesive_volume,
        anatomy.slab * 1e6,
    ));
}

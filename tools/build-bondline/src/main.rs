//! From a bonded specimen to the bond line before pressing: see `lib/bondline`.

use std::path::PathBuf;
use std::process::ExitCode;

use bondline::{Bond, Options, Placed, Plane, Specimen};
use clap::Parser;
use cli::{Failure, Output};
use particle_file::{Block, Draft, Header, Kind, Material, ParticleFile, Provenance};
use units::{Axis, Length, Quantity};

/// Take the adhesive out of a specimen, part its adherends and put a slab between them
#[derive(Parser)]
#[command(
    version,
    after_help = "Examples:
  build-bondline specimen.mpts -o bond.mpts
  xct2particles stack.tif --voxel 1.45um -o - | build-bondline - -o bond.mpts
  build-bondline specimen.mpts --normal z --plane 226.2um --voxels-per-cell 1 -o bond.mpts"
)]
struct Arguments {
    /// Particle file with wood and adhesive, as xct2particles writes; `-` is standard input
    specimen: PathBuf,
    /// Particle file to write; `-` is standard output
    #[arg(short, long, value_name = "BOND")]
    output: Output,
    /// Axis across the bond: x, y or z [default: the specimen's, usually y]
    #[arg(long, value_name = "AXIS")]
    normal: Option<Axis>,
    /// Where to split the wood: auto, or a length from the low face of the stack
    #[arg(long, value_name = "auto|LEN", default_value = "auto", value_parser = auto_or_length)]
    plane: AutoOr,
    /// Voxels along the edge of a grid cell: the slab is a whole number of cells thick
    #[arg(long, value_name = "N", default_value_t = 2, value_parser = clap::value_parser!(u16).range(1..=64))]
    voxels_per_cell: u16,
    /// How far to move the top adherend away: auto (by the slab's thickness) or a length
    #[arg(long, value_name = "auto|LEN", default_value = "auto", value_parser = auto_or_length)]
    gap: AutoOr,
    /// Largest change of the adhesive volume by rounding that is accepted
    #[arg(long, value_name = "PERCENT", default_value = "5%", value_parser = percent)]
    tolerance: f64,
    #[command(flatten)]
    common: cli::Common,
}

/// A length in metres, or none for `auto`.
#[derive(Clone, Copy)]
struct AutoOr(Option<f64>);

fn auto_or_length(text: &str) -> Result<AutoOr, String> {
    if text == "auto" {
        return Ok(AutoOr(None));
    }
    match text.parse::<Quantity<Length>>() {
        Ok(length) => Ok(AutoOr(Some(length.si()))),
        Err(error) => Err(format!("{error}, or 'auto'")),
    }
}

fn percent(text: &str) -> Result<f64, String> {
    let number = text.strip_suffix('%').map(|n| n.trim().parse::<f64>());
    match number {
        Some(Ok(percent)) if percent.is_finite() && percent >= 0.0 => Ok(percent / 100.0),
        _ => Err(format!(
            "'{text}' is not a percentage: a number of at least 0 with % is needed, e.g. 5%"
        )),
    }
}

fn main() -> ExitCode {
    cli::main(|a: &Arguments| &a.common, run)
}

fn run(arguments: Arguments) -> Result<(), Failure> {
    cli::keep_apart([arguments.specimen.as_path()], [&arguments.output])?;
    let file = ParticleFile::open(&arguments.specimen).map_err(Failure::data)?;
    if file.header().kind != Kind::Specimen {
        return Err(Failure::usage(format!(
            "'{}' holds a {}, not a specimen: a file as xct2particles writes is needed",
            file.name(),
            file.header().kind
        )));
    }
    let options = options(&arguments, file.header());
    let block = |name| file.block_named(name).map_err(Failure::data);
    let bond = Specimen::new(
        Placed::of_block(block("wood")?),
        Placed::of_block(block("adhesive")?),
    )
    .and_then(|specimen| bondline::build(&specimen, &options))
    .map_err(|error| {
        let said = format!("'{}': {error}", file.name());
        if error.is_unfit_data() {
            Failure::data(said)
        } else {
            Failure::usage(said)
        }
    })?;
    report(&bond, &options);
    write(&bond, &options, &file, &arguments)
}

fn options(arguments: &Arguments, header: &Header) -> Options {
    let own = Axis::from_index(header.normal.into());
    let normal = arguments.normal.or(own).unwrap_or(Axis::Y);
    Options {
        normal,
        plane: match arguments.plane.0 {
            Some(plane_m) => Plane::At(plane_m),
            None => Plane::Auto,
        },
        voxels_per_cell: arguments.voxels_per_cell.into(),
        gap_m: arguments.gap.0,
        tolerance: arguments.tolerance,
    }
}

fn report(bond: &Bond, options: &Options) {
    let um = |metres: f64| 1e6 * metres;
    let um3 = |voxels: u64| voxels as f64 * um(bond.voxel_m).powi(3);
    let how = match bond.found {
        Some(line) => format!(
            "found midway between the bond surfaces at {} and {} voxels; adhesive most outweighs wood in layer {}, by {:.1} % of the area",
            line.bottom,
            line.top,
            line.seed,
            100.0 * line.contrast
        ),
        None => "as given, at the nearest face between voxels".into(),
    };
    cli::note(format!(
        "bond plane: {} = {:.3} um ({how}); it parts {} touching pairs of wood voxels, {:.2} % of the bond area",
        options.normal,
        um(bond.plane_m),
        bond.severed,
        100.0 * bond.severed as f64 / bond.area as f64
    ));
    if bond.trimmed != [0; 3] {
        cli::note(format!(
            "left out {:?} layers at the high x, y, z sides: the bond is a whole number of cells wide",
            bond.trimmed
        ));
    }
    cli::note(format!(
        "wood: {} voxels in the bottom adherend, {} in the top one",
        bond.bottom.bits.count(),
        bond.top.bits.count()
    ));
    cli::note(format!(
        "adhesive: in {} voxels = {:.1} um3, out {} voxels = {:.1} um3, rounding {:+.3} %",
        bond.adhesive_in,
        um3(bond.adhesive_in),
        bond.adhesive_out,
        um3(bond.adhesive_out),
        100.0 * bond.rounding()
    ));
    cli::note(format!(
        "slab: {:.3} um = {} cells of {:.3} um (effective penetration of the specimen {:.4} um); gap {:.3} um",
        um(bond.slab_m()),
        bond.slab_cells,
        um(bond.cell_m),
        um(bond.effective_penetration_m()),
        um(bond.gap_m)
    ));
}

fn write(
    bond: &Bond,
    options: &Options,
    from: &ParticleFile,
    arguments: &Arguments,
) -> Result<(), Failure> {
    let source = from.header();
    let mut header = Header::new(
        Kind::Bond,
        bond.voxel_m,
        options.normal.index() as u8,
        bond.box_min_m,
        bond.box_max_m,
    );
    header.attributes.clone_from(&source.attributes);
    for (name, value) in [
        ("bond_plane_m", bond.plane_m),
        ("gap_m", bond.gap_m),
        ("slab_thickness_m", bond.slab_m()),
        ("cell_m", bond.cell_m),
        ("slab_cells", bond.slab_cells as f64),
        ("adhesive_voxels_in", bond.adhesive_in as f64),
        ("adhesive_voxels_out", bond.adhesive_out as f64),
        ("effective_penetration_m", bond.effective_penetration_m()),
    ] {
        header.set_attribute(name, value);
    }
    let input = (
        arguments.specimen.display().to_string(),
        from.content_hash(),
    );
    header.provenance.clone_from(&source.provenance);
    header.provenance.push(Provenance::of_process(
        env!("CARGO_PKG_NAME"),
        env!("CARGO_PKG_VERSION"),
        vec![input],
    ));
    let mut draft = Draft::new(header);
    for (name, material, part) in [
        ("wood-bottom", Material::Rigid, &bond.bottom),
        ("wood-top", Material::Rigid, &bond.top),
        ("adhesive", Material::Adhesive, &bond.slab),
    ] {
        let block = Block::new(name, material, part.origin_m, bond.voxel_m, &part.bits);
        draft = draft.block(block, &part.bits);
    }
    arguments.output.write(|out| draft.write_to(out))
}

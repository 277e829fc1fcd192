//! From a bonded specimen, or from undamaged wood, to the bond line before pressing: see
//! `lib/bondline`.

mod arguments;
mod report;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use bondline::{Bond, Error, Layup, Opening, Pieces, PlacedVoxels, Specimen};
use cli::Failure;
use particle_file::{Header, Kind, ParticleFile, Provenance};
use units::Axis;

use arguments::Arguments;

/// Memory that a bond takes while it is made, in lengths of the file of each piece: copies of the wood
/// whole and in two parts, and as it is turned.
const MADE_OF_A_BYTE: u64 = 2;

fn main() -> ExitCode {
    cli::main(|a: &Arguments| &a.common, run)
}

fn run(arguments: Arguments) -> Result<(), Failure> {
    let paths = paths(&arguments);
    cli::keep_apart(paths.iter().copied(), [&arguments.output])?;
    let slab_m = arguments.wood.slab_m()?;
    if paths.iter().filter(|path| **path == Path::new("-")).count() > 1 {
        return Err(Failure::usage(
            "only one piece can come from standard input: name a file for the other",
        ));
    }
    let files = (paths.iter())
        .map(|path| specimen(path))
        .collect::<Result<Vec<_>, Failure>>()?;
    for file in &files {
        (voxels::doubt_of_file(file.header()).into_iter()).for_each(cli::warn);
        let bytes = file.len_bytes().saturating_mul(MADE_OF_A_BYTE);
        file.fits(bytes, "a bond of it").map_err(Failure::data)?;
    }
    let normal = normal(&arguments, &files)?;
    let bond = match slab_m {
        None => bonded(&files[0], &arguments, normal)?,
        Some(slab_m) => wood(&files, &arguments, normal, slab_m)?,
    };
    report::report(&bond, normal);
    write(&bond, normal, &files, &paths, &arguments)
}

/// The files to read: a specimen, or a bottom and a top piece.
fn paths(arguments: &Arguments) -> Vec<&Path> {
    let wood = &arguments.wood;
    let given = [&arguments.specimen, &wood.bottom, &wood.top];
    given.into_iter().flatten().map(PathBuf::as_path).collect()
}

fn specimen(path: &Path) -> Result<ParticleFile, Failure> {
    let file = ParticleFile::open(path).map_err(Failure::data)?;
    if file.header().kind != Kind::Specimen {
        return Err(Failure::usage(format!(
            "'{}' holds a {}, not a specimen: a file as xct2particles writes is needed",
            file.name(),
            file.header().kind
        )));
    }
    Ok(file)
}

fn normal(arguments: &Arguments, files: &[ParticleFile]) -> Result<Axis, Failure> {
    let own = |file: &ParticleFile| Axis::from_index(file.header().normal.into());
    let first = own(&files[0]);
    match (arguments.normal, files.get(1)) {
        (Some(normal), _) => Ok(normal),
        (None, Some(second)) if own(second) != first => Err(Failure::usage(format!(
            "the bond normals of '{}' and '{}' are not the same axis: give --normal",
            files[0].name(),
            second.name()
        ))),
        _ => Ok(first.unwrap_or(Axis::Y)),
    }
}

fn placed<'a>(file: &'a ParticleFile, name: &str) -> Result<PlacedVoxels<'a>, Failure> {
    let block = file.block_named(name).map_err(Failure::data)?;
    Ok(PlacedVoxels::of_block(block))
}

/// A refusal of the pieces of `files`.
fn refusal(files: &[ParticleFile], error: &Error) -> Failure {
    let names: Vec<_> = files.iter().map(|f| format!("'{}'", f.name())).collect();
    let said = format!("{}: {error}", names.join(" and "));
    Failure::of_input(!error.is_unfit_data(), said)
}

fn opening(arguments: &Arguments, normal: Axis) -> Opening {
    Opening {
        normal,
        voxels_per_cell: arguments.voxels_per_cell.into(),
        gap_m: arguments.gap.0,
        tolerance: arguments.tolerance,
    }
}

fn bonded(file: &ParticleFile, arguments: &Arguments, normal: Axis) -> Result<Bond, Failure> {
    let refused = |error| refusal(std::slice::from_ref(file), &error);
    let specimen =
        Specimen::new(placed(file, "wood")?, placed(file, "adhesive")?).map_err(refused)?;
    let bond = bondline::build(&specimen, arguments.plane.0, &opening(arguments, normal))
        .map_err(refused)?;
    report::tilt(&specimen, &bond, normal);
    Ok(bond)
}

fn wood(
    files: &[ParticleFile],
    arguments: &Arguments,
    normal: Axis,
    slab_m: f64,
) -> Result<Bond, Failure> {
    for file in files {
        if placed(file, "adhesive")?.bits.count() > 0 {
            return Err(Failure::usage(format!(
                "'{}' holds adhesive: --slab and --spread are for wood without adhesive; the adhesive volume of a bonded specimen is kept",
                file.name()
            )));
        }
    }
    let plane = arguments.plane.0;
    let pieces = match files {
        [bottom, top] if plane.is_none() => Pieces::Two {
            bottom: placed(bottom, "wood")?,
            top: placed(top, "wood")?,
        },
        [whole] => {
            let cut = plane.ok_or_else(|| {
                Failure::usage("wood without adhesive has no bond line: give the cut with --plane LEN, or two pieces with --bottom and --top")
            })?;
            Pieces::Cut(placed(whole, "wood")?, cut)
        }
        _ => {
            return Err(Failure::usage(
                "--plane cuts one piece of wood; the faces of --bottom and --top are found by the tool",
            ));
        }
    };
    let layup = Layup {
        opening: opening(arguments, normal),
        slab_m,
        quarters: arguments.wood.quarters(),
        crop: arguments.wood.crop_to_fit,
        drop_islands: arguments.wood.drop_islands,
    };
    bondline::lay_up(&pieces, &layup).map_err(|error| refusal(files, &error))
}

fn write(
    bond: &Bond,
    normal: Axis,
    files: &[ParticleFile],
    paths: &[&Path],
    arguments: &Arguments,
) -> Result<(), Failure> {
    let normal = normal.index() as u8;
    let (low, high) = (bond.box_min_m, bond.box_max_m);
    let mut header = Header::new(Kind::Bond, bond.voxel_m, normal, low, high);
    let source = files[0].header();
    header.attributes.clone_from(&source.attributes);
    for (name, value) in [
        ("bond_plane_m", bond.plane_m),
        ("gap_m", bond.gap_m),
        ("slab_thickness_m", bond.slab_m()),
        ("cell_m", bond.cell_m),
        ("slab_cells", bond.slab_cells as f64),
        ("adhesive_voxels_in", bond.adhesive_in),
        ("adhesive_voxels_out", bond.adhesive_out as f64),
        ("effective_penetration_m", bond.effective_penetration_m()),
    ] {
        header.set_attribute(name, value);
    }
    let inputs = paths.iter().zip(files);
    let inputs = inputs.map(|(path, file)| (path.display().to_string(), file.content_hash()));
    let (tool, version) = (env!("CARGO_PKG_NAME"), env!("CARGO_PKG_VERSION"));
    let own = Provenance::of_process(tool, version, inputs.collect());
    let before = files
        .iter()
        .flat_map(|file| file.header().provenance.clone());
    header.provenance = before.chain([own]).collect();
    let draft = bond.draft(header);
    arguments.output.write(|out| draft.write_to(out))
}

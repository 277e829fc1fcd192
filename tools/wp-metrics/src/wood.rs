//! Tables of wood without adhesive: permeabilities and sizes of pores.

use std::path::PathBuf;

use bondline::PlacedVoxels;
use cli::{Failure, Progress};
use implicit::Permeability;
use metrics::table::{self, PermeabilityRow};
use metrics::{State, Wood};
use physics::{Boundary, VoxelBlock};
use units::Axis;

use crate::Recorder;
use crate::arguments::Arguments;
use crate::input::Input;

/// Memory that flow through a voxel takes, bytes: measured on wood of two thirds lumens.
const FLOW_BYTES: u64 = 3000;
/// Memory that the size of the pore at a voxel takes, bytes.
const SIZE_BYTES: u64 = 17;

pub fn tell_permeability(
    paths: &[PathBuf],
    axis: Axis,
    arguments: &Arguments,
    open: impl Fn(&PathBuf) -> Result<Input, Failure>,
    mut record: Recorder,
) -> Result<(), Failure> {
    let row = |path| {
        let input = open(path)?;
        record.add(&input)?;
        let found = of(&input, axis, arguments.periodic)?;
        Ok(PermeabilityRow {
            file: cli::cell(&input.name).into_owned(),
            axis,
            permeability_m2: [found.m2, found.error_m2()],
            porosity: found.porosity,
            through: found.through,
        })
    };
    let rows = paths.iter().map(row).collect::<Result<Vec<_>, Failure>>()?;
    arguments.output.write_with_record(&record.finish(), |out| {
        table::write_permeabilities(out, &rows)
    })
}

fn of(input: &Input, axis: Axis, periodic: bool) -> Result<Permeability, Failure> {
    let state = input.state(None)?;
    let wood = whole(input, &state)?;
    fits(input, &wood, FLOW_BYTES, "the flow through")?;
    let solid = VoxelBlock::new(
        wood.origin_m,
        [wood.voxel_m; 3],
        wood.bits.dims(),
        wood.bits.words().to_vec(),
    );
    let sides = match periodic {
        true => Boundary::Periodic,
        false => Boundary::Symmetry,
    };
    implicit::permeability(&solid, axis.index(), sides).map_err(|why| refused(input, &why))
}

pub fn tell_pores(
    paths: &[PathBuf],
    arguments: &Arguments,
    open: impl Fn(&PathBuf) -> Result<Input, Failure>,
    mut record: Recorder,
) -> Result<(), Failure> {
    let mut files = Vec::new();
    for path in paths {
        let input = open(path)?;
        record.add(&input)?;
        let state = input.state(None)?;
        let wood = whole(&input, &state)?;
        fits(&input, &wood, SIZE_BYTES, "the sizes of pores in")?;
        let mut progress = Progress::new(&format!("pores of '{}'", input.name));
        let sizes = metrics::pore_sizes(wood, |done| {
            progress.update(&[("done, {} left", done)], || "sizes".into());
        });
        progress.finish();
        if sizes.is_empty() {
            return Err(refused(&input, "it has no pores in the wood"));
        }
        files.push((cli::cell(&input.name).into_owned(), sizes));
    }
    (arguments.output).write_with_record(&record.finish(), |out| table::write_pores(out, &files))
}

fn whole<'a>(input: &Input, state: &State<'a>) -> Result<PlacedVoxels<'a>, Failure> {
    match state.wood {
        Wood::Whole(wood) => Ok(wood),
        Wood::Parted { .. } => Err(refused(
            input,
            "its adherends are separated; permeability and pores need a specimen or stack",
        )),
        Wood::None => Err(refused(input, "it has no wood")),
    }
}

fn fits(input: &Input, wood: &PlacedVoxels, bytes_a_voxel: u64, what: &str) -> Result<(), Failure> {
    let [x, y, z] = wood.bits.dims();
    let need = bytes_a_voxel.saturating_mul((x * y * z) as u64);
    match machine::shortage(need) {
        None => Ok(()),
        Some(short) => Err(Failure::data(format!(
            "'{}': {what} {x} x {y} x {z} voxels takes {short}; use a part of it (xct2particles --crop)",
            input.name
        ))),
    }
}

fn refused(input: &Input, why: &str) -> Failure {
    Failure::usage(format!("'{}': {why}", input.name))
}

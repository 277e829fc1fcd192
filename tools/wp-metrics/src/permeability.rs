//! The table of permeabilities.

use std::path::PathBuf;

use cli::Failure;
use implicit::Permeability;
use metrics::Wood;
use metrics::table::{self, PermeabilityRow};
use physics::{Boundary, VoxelBlock};
use units::Axis;

use crate::input::Input;
use crate::{Arguments, Recorder};

/// Memory that flow through a voxel takes, bytes: measured on wood of two thirds lumens.
const BYTES_A_VOXEL: u64 = 3000;

/// Writes the permeability of each file along an axis.
pub fn tell(
    paths: &[PathBuf],
    axis: Axis,
    arguments: &Arguments,
    open: impl Fn(&PathBuf) -> Result<Input, Failure>,
    mut record: Recorder,
) -> Result<(), Failure> {
    let mut rows = Vec::new();
    for path in paths {
        let input = open(path)?;
        record.add(&input)?;
        let found = of(&input, axis, arguments.periodic)?;
        rows.push(PermeabilityRow {
            file: cli::cell(&input.name).into_owned(),
            axis,
            permeability_m2: [found.m2, found.error_m2],
            porosity: found.porosity,
            through: found.through,
        });
    }
    arguments.output.write_with_record(&record.finish(), |out| {
        table::write_permeabilities(out, &rows)
    })
}

fn of(input: &Input, axis: Axis, periodic: bool) -> Result<Permeability, Failure> {
    let refused = |why: &str| Failure::usage(format!("'{}': {why}", input.name));
    let state = input.state(None)?;
    let wood = match state.wood {
        Wood::Whole(wood) => wood,
        Wood::Parted { .. } => {
            return Err(refused(
                "its adherends are parted; a permeability is of one specimen or stack",
            ));
        }
        Wood::None => return Err(refused("it has no wood")),
    };
    let dims = wood.bits.dims();
    let need = BYTES_A_VOXEL.saturating_mul(dims.iter().product::<usize>() as u64);
    if let Some(short) = machine::shortage(need) {
        let [x, y, z] = dims;
        return Err(Failure::data(format!(
            "'{}': the flow through {x} x {y} x {z} voxels takes {short}; cut a part out (xct2particles --crop)",
            input.name
        )));
    }
    let solid = VoxelBlock::new(
        wood.origin_m,
        [wood.voxel_m; 3],
        dims,
        wood.bits.words().to_vec(),
    );
    let sides = match periodic {
        true => Boundary::Periodic,
        false => Boundary::Symmetry,
    };
    implicit::permeability(&solid, axis.index(), sides).map_err(|why| refused(&why))
}

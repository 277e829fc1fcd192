//! From a bond file to plain data with the bond normal turned to y.

use particle_file::{BitsRef, Block, Kind, ParticleFile};
use physics::VoxelBlock;
use units::Axis;

use crate::request::RunFailure;
use crate::resolve::Bond;

/// Exchanges y and the bond normal of a vector; its own inverse.
pub(crate) fn swap<T>(mut v: [T; 3], normal: Axis) -> [T; 3] {
    v.swap(1, normal.index());
    v
}

/// Reads what a run needs from a bond file.
///
/// # Errors
/// Exit 2 when the file is no bond file, exit 3 when it is corrupt.
pub(crate) fn bond(file: &ParticleFile) -> Result<Bond, RunFailure> {
    let header = file.header();
    if header.kind != Kind::Bond {
        return Err(RunFailure::Usage(format!(
            "'{}' is no bond file but holds a {}; make one with build-bondline",
            file.name(),
            header.kind
        )));
    }
    let corrupt = |said: String| RunFailure::Data(format!("{}: {said}", file.name()));
    let normal = Axis::from_index(header.normal.into())
        .ok_or_else(|| corrupt("its bond normal is no axis".into()))?;
    let gap_m = header
        .attribute("gap_m")
        .and_then(|text| text.parse::<f64>().ok())
        .filter(|g| g.is_finite() && *g >= 0.0)
        .ok_or_else(|| corrupt("attribute gap_m is missing or not a length".into()))?;
    let block = |name: &str| -> Result<VoxelBlock, RunFailure> {
        let (block, bits) = file
            .block_named(name)
            .map_err(|e| RunFailure::Data(e.to_string()))?;
        Ok(canonical(block, bits, normal))
    };
    Ok(Bond {
        min_m: swap(header.box_min_m, normal),
        max_m: swap(header.box_max_m, normal),
        normal,
        bottom: block("wood-bottom")?,
        top: block("wood-top")?,
        adhesive: block("adhesive")?,
        gap_m,
    })
}

fn canonical(block: &Block, bits: BitsRef, normal: Axis) -> VoxelBlock {
    let origin = swap(block.origin_m, normal);
    let voxel = [block.voxel_m; 3];
    let dims = swap(bits.dims(), normal);
    if normal == Axis::Y {
        return VoxelBlock::new(origin, voxel, dims, bits.words().to_vec());
    }
    VoxelBlock::from_fn(origin, voxel, dims, |i, j, k| {
        let [i, j, k] = swap([i, j, k], normal);
        bits.get(i, j, k)
    })
}

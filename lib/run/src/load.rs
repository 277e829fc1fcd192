//! Input of a run: the text of its case, and a bond file as plain data with the bond normal
//! turned to y.

use std::fs::File;
use std::io::Read;
use std::path::Path;

use particle_file::{BitsRef, Block, Header, Kind, ParticleFile, limits};
use physics::VoxelBlock;
use units::Axis;

use crate::failure::RunFailure;
use crate::resolve::Bond;

/// Bytes that the scene takes for each byte of a bond file, before a scheme asks for more: its blocks
/// here, and where liquid begins (121 MB of 885 million voxels: 240 MB).
const MADE_OF_A_BYTE: u64 = 2;

/// The text of a case file.
/// Errors: exit 2 when it cannot be read, is longer than a case can be, or is no text.
pub(crate) fn case_text(path: &Path) -> Result<String, RunFailure> {
    let refused = |why: String| {
        RunFailure::Usage(format!(
            "cannot read the case file '{}': {why}",
            path.display()
        ))
    };
    let mut bytes = Vec::new();
    File::open(path)
        .and_then(|file| file.take(limits::CASE + 1).read_to_end(&mut bytes))
        .map_err(|e| refused(e.to_string()))?;
    if bytes.len() as u64 > limits::CASE {
        let why = format!("it is longer than the {} bytes accepted", limits::CASE);
        return Err(refused(why));
    }
    String::from_utf8(bytes).map_err(|_| refused("it is not TOML text".into()))
}

/// Exchanges y and the bond normal of a vector; its own inverse.
pub(crate) fn swap<T>(mut v: [T; 3], normal: Axis) -> [T; 3] {
    v.swap(1, normal.index());
    v
}

/// Reads what a run needs from a bond file.
/// Errors: exit 2 when the file is no bond file, exit 3 when it is corrupt.
pub(crate) fn bond(file: &ParticleFile) -> Result<Bond, RunFailure> {
    let header = file.header();
    if header.kind != Kind::Bond {
        return Err(RunFailure::Usage(format!(
            "'{}' is no bond file but holds a {}; make one with build-bondline",
            file.name(),
            header.kind
        )));
    }
    file.fits(MADE_OF_A_BYTE * file.len_bytes(), "a run of it")
        .map_err(|e| RunFailure::Data(e.to_string()))?;
    let corrupt = |said: String| RunFailure::Data(format!("{}: {said}", file.name()));
    box_of_its_blocks(header).map_err(corrupt)?;
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
        most_cells: limits::cells_of(file.len_bytes()),
    })
}

/// Refuses a box that is not that of the blocks. build-bondline puts its low side below the wood
/// by less than a cell, and the scheme's grid fills it: a box of its own would be a grid of any
/// size.
fn box_of_its_blocks(header: &Header) -> Result<(), String> {
    /// Voxels along the edge of a cell at most, and one for rounding.
    const CELL: f64 = 65.0;
    let near = |a: f64, b: f64| (a - b).abs() <= CELL * header.voxel_m;
    let corner = |of: fn(f64, f64) -> f64, which: fn(&Block) -> [f64; 3]| -> [f64; 3] {
        let corners = header.blocks.iter().map(which);
        let outer = corners.reduce(|a, b| std::array::from_fn(|i| of(a[i], b[i])));
        outer.unwrap_or([f64::NAN; 3])
    };
    let low = corner(f64::min, |b| b.origin_m);
    let high = corner(f64::max, Block::max_m);
    for a in 0..3 {
        if !(near(header.box_min_m[a], low[a]) && near(header.box_max_m[a], high[a])) {
            return Err(format!(
                "its box reaches from {:.3} to {:.3} um along {} and its blocks from {:.3} to {:.3} um: they must be the same to a cell",
                1e6 * header.box_min_m[a],
                1e6 * header.box_max_m[a],
                ["x", "y", "z"][a],
                1e6 * low[a],
                1e6 * high[a]
            ));
        }
    }
    Ok(())
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

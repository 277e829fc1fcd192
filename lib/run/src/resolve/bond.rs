//! Scenes from a bond file: two adherends and a slab of adhesive between them.

use particle_file::{BitsRef, Block, Header, Kind, ParticleFile, limits};
use physics::{Dimensions, GridBox, Motion, RigidBody, VoxelBlock};
use units::Axis;

use super::seed::Seeds;
use super::{Geometry, cells_along};
use crate::case::Case;
use crate::failure::{RunFailure, refused};

/// Memory of the scene per byte of the bond file, without the scheme: the blocks of the bodies and of the liquid (240 MB for
/// a file of 121 MB with 885 million voxels).
const MADE_OF_A_BYTE: u64 = 2;

/// Exchanges y and the bond normal of a vector; its own inverse.
pub(crate) fn swap<T>(mut v: [T; 3], normal: Axis) -> [T; 3] {
    v.swap(1, normal.index());
    v
}

/// Errors: exit 2 if the file is no bond file or does not fit the case, exit 3 if it is corrupt.
pub(super) fn geometry(
    case: &Case,
    dimensions: Dimensions,
    file: &ParticleFile,
) -> Result<Geometry, RunFailure> {
    let header = file.header();
    let (normal, gap_m) = checked(file)?;
    let block = |name| -> Result<VoxelBlock, RunFailure> {
        let (block, bits) = file.block_named(name)?;
        Ok(canonical(block, bits, normal))
    };
    let [bottom, top, adhesive] = [
        block("wood-bottom")?,
        block("wood-top")?,
        block("adhesive")?,
    ];
    let [mut min_m, max_m] =
        [header.box_min_m, header.box_max_m].map(|corner| swap(corner, normal));
    let cell = case.grid.cell.si(adhesive.voxel()[0]);
    if case.grid.domain.is_some() {
        return refused("[grid] domain is for [[body]] scenes; a bond file has its own box");
    }
    let depth = (dimensions == Dimensions::Two).then_some(cell);
    if depth.is_some() && adhesive.dims()[2] != 1 {
        return refused(format!(
            "plane strain needs a bond one voxel thick along z, but this one has {}; cut it with xct2particles --crop",
            adhesive.dims()[2]
        ));
    }
    let mut cells = [1; 3];
    for a in 0..dimensions.axes() {
        let n = (max_m[a] - min_m[a]) / cell;
        if a != 1 && (n - n.round()).abs() > 1e-3 {
            return refused(format!(
                "the bond is {n:.3} cells of {:.4} um wide along {}: its symmetry sides must lie on cell faces; crop it or choose another cell",
                cell * 1e6,
                ["x", "y", "z"][a]
            ));
        }
        cells[a] = cells_along(n - 1e-3)?;
    }
    let [x, y, z] = cells;
    let most = limits::cells_of(file.len_bytes());
    if limits::volume(cells.map(|n| n as u64)) > most {
        return refused(format!(
            "the grid would have {x} x {y} x {z} cells; accepted are {most} in all for a bond file of this size: choose a larger cell"
        ));
    }
    if depth.is_some() {
        min_m[2] = 0.0;
    }
    let grid = GridBox {
        cell_m: cell,
        min_m,
        cells,
    };
    let seeds = seeds(case, &adhesive, cell, depth)?;
    let body = |name: &str, block, motion| RigidBody {
        name: name.into(),
        blocks: vec![deepen(block, depth)],
        motion,
    };
    let motion = match case.clamp {
        Some(_) => Motion::Clamped,
        None => Motion::Fixed,
    };
    let bodies = vec![
        body("wood-bottom", bottom, Motion::Fixed),
        body("wood-top", top, motion),
    ];
    let clamp = case.clamp.as_ref();
    let travel_m = match clamp.and_then(|clamp| clamp.travel) {
        Some(travel) => travel.si(),
        None => {
            let voxel = adhesive.voxel()[0];
            let closed_m = clamp.map_or(0.0, |clamp| clamp.closed_gap.si(voxel));
            if closed_m > 0.0 && closed_m >= gap_m {
                return refused(format!(
                    "[clamp] closed_gap of {:.4} um is no less than the gap of {:.4} um: nothing would be pressed",
                    1e6 * closed_m,
                    1e6 * gap_m
                ));
            }
            gap_m - closed_m
        }
    };
    Ok(Geometry {
        grid,
        seeds,
        bodies,
        bottom: Some(0),
        top: Some(1),
        travel_m: Some(travel_m),
        normal,
    })
}

/// Checks a bond file. Returns its bond normal, and the distance by which its upper adherend was moved away, m.
fn checked(file: &ParticleFile) -> Result<(Axis, f64), RunFailure> {
    let header = file.header();
    if header.kind != Kind::Bond {
        return refused(format!(
            "'{}' is not a bond file but a {}; make one with build-bondline",
            file.name(),
            header.kind
        ));
    }
    file.fits(MADE_OF_A_BYTE * file.len_bytes(), "a run of it")?;
    let corrupt = |said: String| RunFailure::Data(format!("{}: {said}", file.name()));
    box_of_its_blocks(header).map_err(corrupt)?;
    let normal = Axis::from_index(header.normal.into())
        .ok_or_else(|| corrupt("its bond normal is not an axis".into()))?;
    let gap_m = header
        .attribute("gap_m")
        .and_then(|text| text.parse::<f64>().ok())
        .filter(|g| g.is_finite() && *g >= 0.0)
        .ok_or_else(|| corrupt("attribute gap_m is missing or not a length".into()))?;
    Ok((normal, gap_m))
}

/// Refuses a header whose box does not fit its blocks: the scheme's grid fills the box, so a forged one could ask for a grid
/// of any size. build-bondline puts the low side of the box below the wood by less than a cell.
fn box_of_its_blocks(header: &Header) -> Result<(), String> {
    /// Most voxels along the edge of a cell, plus one for rounding.
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

/// Makes a block as deep as the one layer of cells in plane strain.
fn deepen(block: VoxelBlock, depth: Option<f64>) -> VoxelBlock {
    let Some(depth) = depth else {
        return block;
    };
    let (mut origin, mut voxel) = (block.origin(), block.voxel());
    (origin[2], voxel[2]) = (0.0, depth);
    VoxelBlock::new(origin, voxel, block.dims(), block.bits().to_vec())
}

/// A regular lattice of points in every adhesive voxel.
fn seeds(
    case: &Case,
    block: &VoxelBlock,
    cell: f64,
    depth: Option<f64>,
) -> Result<Seeds, RunFailure> {
    let voxel = block.voxel()[0];
    let spacing = cell / f64::from(case.grid.points_per_direction);
    let per_edge = voxel / spacing;
    if per_edge < 0.99 || (per_edge - per_edge.round()).abs() > 1e-3 {
        return refused(format!(
            "cell {:.4} um with {} points per direction puts {per_edge:.3} points along a voxel of {:.4} um: a whole number is needed",
            cell * 1e6,
            case.grid.points_per_direction,
            voxel * 1e6
        ));
    }
    Ok(Seeds::Voxels {
        block: block.clone(),
        spacing,
        plane_strain_depth: depth,
    })
}

//! Scenes from a bond file: two adherends and a slab of adhesive between them.

use particle_file::limits;
use physics::{Dimensions, GridBox, Motion, RigidBody, VoxelBlock};

use super::seed::Seeds;
use super::{Geometry, cells_along};
use crate::case::Case;
use crate::failure::{RunFailure, refused};

/// What a bond file says, with the bond normal turned to y.
#[derive(Clone, Debug)]
pub struct Bond {
    /// Low corner of the box, m.
    pub min_m: [f64; 3],
    /// High corner of the box, the top adherend moved away, m.
    pub max_m: [f64; 3],
    /// Bond normal in the file.
    pub normal: units::Axis,
    /// Lower adherend.
    pub bottom: VoxelBlock,
    /// Upper adherend.
    pub top: VoxelBlock,
    /// Adhesive voxels.
    pub adhesive: VoxelBlock,
    /// How far the upper adherend was moved away, m.
    pub gap_m: f64,
    /// Cells that a file of this length may ask for.
    pub most_cells: u64,
}

pub(super) fn geometry(
    case: &Case,
    dimensions: Dimensions,
    bond: Bond,
) -> Result<Geometry, RunFailure> {
    let cell = case.grid.cell.si(bond.adhesive.voxel()[0]);
    if case.grid.domain.is_some() {
        return refused("[grid] domain is for [[body]] scenes; a bond file has its own box");
    }
    let depth = (dimensions == Dimensions::Two).then_some(cell);
    if depth.is_some() && bond.adhesive.dims()[2] != 1 {
        return refused(format!(
            "plane strain needs a bond one voxel thick along z, but this one has {}; cut it with xct2particles --crop",
            bond.adhesive.dims()[2]
        ));
    }
    let mut cells = [1; 3];
    for a in 0..dimensions.axes() {
        let n = (bond.max_m[a] - bond.min_m[a]) / cell;
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
    if limits::volume(cells.map(|n| n as u64)) > bond.most_cells {
        return refused(format!(
            "the grid would have {x} x {y} x {z} cells; accepted are {} in all for a bond file of this size: choose a larger cell",
            bond.most_cells
        ));
    }
    let mut min_m = bond.min_m;
    if depth.is_some() {
        min_m[2] = 0.0;
    }
    let grid = GridBox {
        cell_m: cell,
        min_m,
        cells,
    };
    let seeds = seeds(case, &bond.adhesive, cell, depth)?;
    let body = |name: &str, block: &VoxelBlock, motion| RigidBody {
        name: name.into(),
        blocks: vec![deepen(block, depth)],
        motion,
    };
    let motion = match case.clamp {
        Some(_) => Motion::Clamped,
        None => Motion::Fixed,
    };
    let bodies = vec![
        body("wood-bottom", &bond.bottom, Motion::Fixed),
        body("wood-top", &bond.top, motion),
    ];
    let travel = case.clamp.as_ref().and_then(|clamp| clamp.travel);
    Ok(Geometry {
        grid,
        seeds,
        bodies,
        bottom: Some(0),
        top: Some(1),
        travel_m: Some(travel.map_or(bond.gap_m, |travel| travel.si())),
        normal: bond.normal,
    })
}

/// In plane strain a block is as deep as the one layer of cells.
fn deepen(block: &VoxelBlock, depth: Option<f64>) -> VoxelBlock {
    let Some(depth) = depth else {
        return block.clone();
    };
    let (mut origin, mut voxel) = (block.origin(), block.voxel());
    (origin[2], voxel[2]) = (0.0, depth);
    VoxelBlock::new(origin, voxel, block.dims(), block.bits().to_vec())
}

/// The same number of points in every adhesive voxel, on a regular lattice.
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

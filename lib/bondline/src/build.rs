//! The bond line before pressing, from a bonded specimen; the opening of any two adherends.

use particle_file::{BitGrid, BitsRef};
use units::Axis;

use crate::placed::crop;
use crate::slab;
use crate::{BondLine, Error, Face, Placed, Specimen, find, severed};

/// Where to split the wood.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Plane {
    /// Midway between the bond surfaces that [`find`] finds.
    Auto,
    /// At this coordinate (m), rounded to the nearest face between voxels.
    At(f64),
}

/// How to build a bond.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Axis across the bond.
    pub normal: Axis,
    /// The bond plane.
    pub plane: Plane,
    /// Voxels along the edge of a cell of the later grid, at least one.
    pub voxels_per_cell: usize,
    /// How far to move the top adherend away (m); `None`: by the thickness of the slab.
    pub gap_m: Option<f64>,
    /// Largest relative change of the adhesive volume by rounding the slab to whole cells.
    pub tolerance: f64,
}

/// A bond line before pressing.
///
/// The slab is as wide as the specimen and lies in the middle of the opening at the bond
/// plane: with the default gap it fills exactly `plane` to `plane + thickness`, and the top
/// adherend, split off at the same plane, begins where the slab ends. No voxel of wood can
/// be in it. Where the surfaces are rough or stood apart in the specimen, air remains
/// between slab and wood; pressing by `gap_m` brings the top adherend back to its place.
#[derive(Clone, Debug, PartialEq)]
pub struct Bond {
    /// Bottom adherend, in place.
    pub bottom: Part,
    /// Top adherend, moved away by the gap.
    pub top: Part,
    /// The adhesive slab: every voxel is set.
    pub slab: Part,
    /// Edge of a voxel, m.
    pub voxel_m: f64,
    /// Low corner of the box, m. Along the normal it lies a whole number of cells below the
    /// slab, so that the slab fills whole cells of a grid that starts here.
    pub box_min_m: [f64; 3],
    /// High corner of the box, m: that of the wood.
    pub box_max_m: [f64; 3],
    /// Where the wood was split, m.
    pub plane_m: f64,
    /// What the detection found; `None` for a plane given by hand.
    pub found: Option<BondLine>,
    /// The faces of undamaged wood, bottom and top; `None` of a bonded specimen.
    pub faces: Option<[Face; 2]>,
    /// How far the top adherend was moved away, m.
    pub gap_m: f64,
    /// Thickness of the slab in cells.
    pub slab_cells: u64,
    /// Edge of a cell, m.
    pub cell_m: f64,
    /// Adhesive voxels removed; of undamaged wood, the volume asked for over that of a voxel.
    pub adhesive_in: f64,
    /// Adhesive voxels of the slab.
    pub adhesive_out: u64,
    /// Pairs of wood voxels that touched across the plane, or do so where the pieces close.
    pub severed: u64,
    /// Voxels in a layer, i.e. of the bond area.
    pub area: u64,
    /// Layers left out at the high sides across the bond, along x, y, z, so that the bond
    /// area is a whole number of cells wide.
    pub trimmed: [usize; 3],
}

/// One part of a bond.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Low corner, m.
    pub origin_m: [f64; 3],
    /// Its voxels.
    pub bits: BitGrid,
}

impl Bond {
    /// Relative change of the adhesive volume by rounding.
    pub fn rounding(&self) -> f64 {
        self.adhesive_out as f64 / self.adhesive_in - 1.0
    }

    /// Thickness of the slab, m.
    pub fn slab_m(&self) -> f64 {
        self.slab_cells as f64 * self.cell_m
    }

    /// Effective penetration of the specimen: adhesive volume over bond area, m.
    pub fn effective_penetration_m(&self) -> f64 {
        self.adhesive_in / self.area as f64 * self.voxel_m
    }
}

/// Builds the bond line before pressing.
///
/// Every wood voxel of the (trimmed) specimen is kept, and belongs to the adherend on its
/// side of the plane.
///
/// # Errors
/// As listed in [`Error`].
pub fn build(specimen: &Specimen, options: &Options) -> Result<Bond, Error> {
    let Options {
        normal,
        voxels_per_cell,
        ..
    } = *options;
    let (n, wood) = (normal.index(), specimen.wood());
    let voxel_m = wood.voxel_m;
    let (kept, trimmed) = whole_cells(wood.bits.dims(), normal, voxels_per_cell);
    let wood = trim(wood, kept);
    let adhesive_in = crop(specimen.adhesive().bits, &kept.map(|d| 0..d)).count();
    if adhesive_in == 0 {
        return Err(Error::NoAdhesive);
    }
    let (plane, found) = place(specimen, options)?;

    let area: u64 = (0..3).filter(|&a| a != n).map(|a| kept[a] as u64).product();
    let cell_m = voxels_per_cell as f64 * voxel_m;
    let adhesive_in = adhesive_in as f64;
    let slab_cells = slab::cells(
        adhesive_in,
        area,
        voxels_per_cell,
        options.tolerance,
        cell_m,
    )?;

    let plane_m = wood.origin_m[n] + plane as f64 * voxel_m;
    let [below, above] = [0..plane, plane..kept[n]].map(|layers| {
        let mut ranges = kept.map(|d| 0..d);
        ranges[n] = layers;
        crop(wood.bits.view(), &ranges)
    });
    let opening = Opening {
        plane_m,
        gap_m: options.gap_m.unwrap_or(slab_cells as f64 * cell_m),
        free_m: free_layers(below.view(), above.view(), plane_m, voxel_m, normal)?,
        severed: severed(wood.bits.view(), normal, plane),
    };
    let mut top_origin_m = wood.origin_m;
    top_origin_m[n] = plane_m;
    let bottom = Part {
        origin_m: wood.origin_m,
        bits: below,
    };
    let top = Part {
        origin_m: top_origin_m,
        bits: above,
    };
    let mut bond = assemble(bottom, top, normal, voxel_m, cell_m, slab_cells, &opening)?;
    (bond.adhesive_in, bond.trimmed, bond.found) = (adhesive_in, trimmed, found);
    Ok(bond)
}

/// Where two closed adherends are opened, and by how much.
pub(crate) struct Opening {
    /// The bond plane, m.
    pub(crate) plane_m: f64,
    /// How far the top adherend is moved away, m.
    pub(crate) gap_m: f64,
    /// From the plane to the outermost wood of the bottom and of the top adherend, m; negative
    /// where it reaches beyond.
    pub(crate) free_m: [f64; 2],
    /// Columns whose wood touches.
    pub(crate) severed: u64,
}

/// Moves the closed top adherend away and puts the slab between; bottom and top are equally
/// wide, a whole number of cells.
pub(crate) fn assemble(
    bottom: Part,
    mut top: Part,
    normal: Axis,
    voxel_m: f64,
    cell_m: f64,
    slab_cells: u64,
    opening: &Opening,
) -> Result<Bond, Error> {
    let n = normal.index();
    let Opening { plane_m, gap_m, .. } = *opening;
    let slab_m = slab_cells as f64 * cell_m;
    let slab_low_m = slab::low_face(plane_m, gap_m, slab_m, opening.free_m, voxel_m)?;
    let mut slab_dims = bottom.bits.dims();
    slab_dims[n] = (slab_m / voxel_m).round() as usize;
    let at = |coordinate: f64| {
        let mut origin = bottom.origin_m;
        origin[n] = coordinate;
        origin
    };
    let cells_below = ((slab_low_m - bottom.origin_m[n]) / cell_m - 1e-9).ceil();
    let area = (0..3).filter(|&a| a != n).map(|a| slab_dims[a] as u64);
    let area = area.product::<u64>();
    let mut closed = slab_dims;
    closed[n] = ((top.origin_m[n] - bottom.origin_m[n]) / voxel_m).round() as usize;
    closed[n] += top.bits.dims()[n];
    let mut box_max_m: [f64; 3] =
        std::array::from_fn(|a| bottom.origin_m[a] + closed[a] as f64 * voxel_m);
    box_max_m[n] += gap_m;
    top.origin_m[n] += gap_m;
    Ok(Bond {
        severed: opening.severed,
        slab: Part {
            origin_m: at(slab_low_m),
            bits: BitGrid::from_rows(slab_dims, |_, _, row| row.fill(u64::MAX)),
        },
        voxel_m,
        box_min_m: at(slab_low_m - cells_below * cell_m),
        box_max_m,
        plane_m,
        found: None,
        faces: None,
        gap_m,
        slab_cells,
        cell_m,
        adhesive_in: 0.0,
        adhesive_out: area * slab_dims[n] as u64,
        area,
        trimmed: [0; 3],
        bottom,
        top,
    })
}

/// Dimensions cut to whole cells across the bond, and what was cut. A stack thinner than a
/// cell (plane strain) stays.
pub(crate) fn whole_cells(
    dims: [usize; 3],
    normal: Axis,
    per_cell: usize,
) -> ([usize; 3], [usize; 3]) {
    let mut kept = dims;
    for (a, d) in kept.iter_mut().enumerate() {
        if a != normal.index() && *d > per_cell {
            *d -= *d % per_cell;
        }
    }
    (kept, std::array::from_fn(|a| dims[a] - kept[a]))
}

fn trim(placed: Placed, kept: [usize; 3]) -> Part {
    Part {
        origin_m: placed.origin_m,
        bits: crop(placed.bits, &kept.map(|d| 0..d)),
    }
}

/// The bond plane as a number of layers from the low face.
fn place(specimen: &Specimen, options: &Options) -> Result<(usize, Option<BondLine>), Error> {
    let wood = specimen.wood();
    match options.plane {
        Plane::Auto => {
            let line = find(specimen, options.normal)?;
            // A middle inside a voxel goes to the face below it: nothing but adhesive or air
            // lies between the two surfaces on average.
            Ok((line.middle() as usize, Some(line)))
        }
        Plane::At(plane_m) => Ok((layer_at(wood, plane_m, options.normal)?, None)),
    }
}

/// The layer of `wood` that begins at the face between voxels nearest to `plane_m`.
pub(crate) fn layer_at(wood: Placed, plane_m: f64, normal: Axis) -> Result<usize, Error> {
    let n = normal.index();
    let layers = ((plane_m - wood.origin_m[n]) / wood.voxel_m).round();
    if layers >= 1.0 && layers < wood.bits.dims()[n] as f64 {
        return Ok(layers as usize);
    }
    Err(Error::PlaneOutside {
        plane_m,
        low_m: wood.origin_m[n],
        high_m: wood.max_m()[n],
        normal,
    })
}

/// Distance (m) from the plane to the outermost wood of the bottom and of the top adherend.
fn free_layers(
    below: BitsRef,
    above: BitsRef,
    plane_m: f64,
    voxel_m: f64,
    normal: Axis,
) -> Result<[f64; 2], Error> {
    let no_wood = |side| Error::NoWood {
        side,
        of: format!("the bond plane at {:.3} um", 1e6 * plane_m),
    };
    let below = below.counts_along(normal.index());
    let above = above.counts_along(normal.index());
    let bottom = below.iter().rev().position(|&n| n > 0);
    let top = above.iter().position(|&n| n > 0);
    Ok([
        bottom.ok_or_else(|| no_wood("below"))? as f64 * voxel_m,
        top.ok_or_else(|| no_wood("above"))? as f64 * voxel_m,
    ])
}

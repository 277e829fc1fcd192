//! The bond line before pressing, from a bonded specimen; the opening of any two adherends.

use particle_file::{BitGrid, Block, Draft, Header, Material};
use units::Axis;

use crate::placed::{corner, layers};
use crate::slab;
use crate::{BondLine, Error, Face, PlacedVoxels, Specimen, find_bond_line, severed};

/// How to part two adherends and place a slab of adhesive between them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Opening {
    /// Axis across the bond.
    pub normal: Axis,
    /// Voxels along the edge of a cell of the later grid, at least one.
    pub voxels_per_cell: usize,
    /// Distance by which to move the top adherend away from its place in the specimen, or from first contact (m); `None`: just
    /// enough for the slab.
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
    pub bottom: BondBody,
    /// Top adherend, moved away by the gap.
    pub top: BondBody,
    /// The adhesive slab: every voxel is set.
    pub slab: BondBody,
    /// Edge of a voxel, m.
    pub voxel_m: f64,
    /// Low corner of the box, m. Along the normal it lies a whole number of cells below the
    /// slab, so that the slab fills whole cells of a grid that starts here.
    pub box_min_m: [f64; 3],
    /// High corner of the box, m: that of the wood.
    pub box_max_m: [f64; 3],
    /// Where the wood was split, m.
    pub plane_m: f64,
    /// The detected bond line; `None` for a plane given by hand.
    pub found: Option<BondLine>,
    /// The bond faces of undamaged wood, bottom and top; `None` for a bonded specimen.
    pub faces: Option<[Face; 2]>,
    /// Distance by which the top adherend was moved away, m.
    pub gap_m: f64,
    /// Thickness of the slab in cells.
    pub slab_cells: u64,
    /// Edge of a cell, m.
    pub cell_m: f64,
    /// Adhesive voxels removed; for undamaged wood, the requested volume over that of a voxel.
    pub adhesive_in: f64,
    /// Adhesive voxels of the slab.
    pub adhesive_out: u64,
    /// Pairs of wood voxels that touch across the bond plane when closed.
    pub severed: u64,
    /// Bond area in voxels.
    pub area: u64,
    /// Layers cut off at the high sides along x, y, z, so that the bond area is a whole number of cells wide.
    pub trimmed: [usize; 3],
}

/// One body of a bond: an adherend or the slab.
#[derive(Clone, Debug, PartialEq)]
pub struct BondBody {
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

    /// The bond file with this header.
    pub fn draft(&self, header: Header) -> Draft<'_> {
        let parts = [
            ("wood-bottom", Material::Rigid, &self.bottom),
            ("wood-top", Material::Rigid, &self.top),
            ("adhesive", Material::Adhesive, &self.slab),
        ];
        parts
            .into_iter()
            .fold(Draft::new(header), |draft, (name, material, part)| {
                let block = Block::new(name, material, part.origin_m, self.voxel_m, &part.bits);
                draft.block(block, &part.bits)
            })
    }

    /// Effective penetration of the specimen: adhesive volume over bond area, m.
    pub fn effective_penetration_m(&self) -> f64 {
        self.adhesive_in / self.area as f64 * self.voxel_m
    }
}

/// Builds the bond line before pressing. The wood is split at `plane_m`, rounded to the nearest face between voxels, or
/// midway between the bond surfaces found by [`find_bond_line`].
///
/// Every wood voxel of the (trimmed) specimen is kept, and belongs to the adherend on its
/// side of the plane.
///
/// # Errors
/// No adhesive, no bond line, no wood on a side, a plane outside the specimen; a slab or gap that does not fit.
pub fn build(specimen: &Specimen, plane_m: Option<f64>, opening: &Opening) -> Result<Bond, Error> {
    let (normal, wood) = (opening.normal, specimen.wood());
    let n = normal.index();
    let (kept, trimmed) = whole_cells(wood.bits.dims(), opening);
    let adhesive_in = corner(specimen.adhesive().bits, kept).count() as f64;
    if adhesive_in == 0.0 {
        return Err(Error::no_adhesive());
    }
    let (plane, found) = match plane_m {
        None => {
            let line = find_bond_line(specimen, normal)?;
            // A middle inside a voxel goes to the face below it: nothing but adhesive or air
            // lies between the two surfaces on average.
            (line.middle() as usize, Some(line))
        }
        Some(plane_m) => (layer_at(wood, plane_m, normal)?, None),
    };
    let bits = corner(wood.bits, kept);
    let [bottom, top] = [0..plane, plane..kept[n]].map(|part| layers(bits.view(), n, part));
    let [mut below, above] = [&bottom, &top].map(|part| part.view().counts_along(n));
    below.reverse();
    let plane_m = wood.origin_m[n] + plane as f64 * wood.voxel_m;
    let no_wood =
        |side| Error::no_wood(format!("{side} the bond plane at {:.3} um", 1e6 * plane_m));
    let free = |counts: &[u64]| Some(counts.iter().position(|&n| n > 0)? as i64);
    let free_layers = [
        free(&below).ok_or_else(|| no_wood("below"))?,
        free(&above).ok_or_else(|| no_wood("above"))?,
    ];
    let closed = Closed {
        origin_m: wood.origin_m,
        voxel_m: wood.voxel_m,
        bottom,
        top,
        top_begins: plane,
        plane,
        free_layers,
        severed: severed(bits.view(), normal, plane),
        void_m: f64::INFINITY,
        adhesive_in,
    };
    Ok(Bond {
        trimmed,
        found,
        ..closed.open(opening)?
    })
}

/// Two closed adherends of equal width. Layers count from the low face of the bottom one.
pub(crate) struct Closed {
    pub(crate) origin_m: [f64; 3],
    pub(crate) voxel_m: f64,
    pub(crate) bottom: BitGrid,
    pub(crate) top: BitGrid,
    /// First layer of the top adherend.
    pub(crate) top_begins: usize,
    /// The bond plane.
    pub(crate) plane: usize,
    /// Free layers between the plane and the outermost wood of each adherend; negative if the wood reaches beyond the plane.
    pub(crate) free_layers: [i64; 2],
    /// Columns whose wood touches.
    pub(crate) severed: u64,
    /// Thickness of the slab (m) that the voids of both adherends can take up.
    pub(crate) void_m: f64,
    /// Voxels of adhesive wanted in the slab.
    pub(crate) adhesive_in: f64,
}

impl Closed {
    /// Moves the top adherend away and places the slab between the two.
    pub(crate) fn open(self, opening: &Opening) -> Result<Bond, Error> {
        let (n, voxel_m, adhesive_in) = (opening.normal.index(), self.voxel_m, self.adhesive_in);
        let cell_m = opening.voxels_per_cell as f64 * voxel_m;
        let mut dims = self.bottom.dims();
        let area: u64 = (0..3).filter(|&a| a != n).map(|a| dims[a] as u64).product();
        let slab_cells = slab::cells(
            adhesive_in,
            area,
            opening.voxels_per_cell,
            opening.tolerance,
            cell_m,
        )?;
        let slab_m = slab_cells as f64 * cell_m;
        if slab_m > self.void_m {
            return Err(Error::new(format!(
                "a slab of {:.3} um is more than all voids of the closed pieces hold ({:.3} um over the bond area), so they could never close; use thicker pieces or less adhesive",
                1e6 * slab_m,
                1e6 * self.void_m
            )));
        }
        let at = |coordinate: f64| {
            let mut origin = self.origin_m;
            origin[n] = coordinate;
            origin
        };
        let place = |layer: usize| self.origin_m[n] + layer as f64 * voxel_m;
        let into_one_another = (-self.free_layers[0] - self.free_layers[1]).max(0);
        let gap_m = (opening.gap_m).unwrap_or(slab_m + into_one_another as f64 * voxel_m);
        let plane_m = place(self.plane);
        let free_m = self.free_layers.map(|layers| layers as f64 * voxel_m);
        let slab_low_m = slab::low_face(plane_m, gap_m, slab_m, free_m, voxel_m)?;
        let cells_below = ((slab_low_m - self.origin_m[n]) / cell_m - 1e-9).ceil();
        let mut closed = dims;
        closed[n] = self.top_begins + self.top.dims()[n];
        let mut box_max_m = [0, 1, 2].map(|a| self.origin_m[a] + closed[a] as f64 * voxel_m);
        box_max_m[n] += gap_m;
        dims[n] = (slab_m / voxel_m).round() as usize;
        Ok(Bond {
            severed: self.severed,
            slab: BondBody {
                origin_m: at(slab_low_m),
                bits: BitGrid::from_rows(dims, |_, _, row| row.fill(u64::MAX)),
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
            adhesive_in,
            adhesive_out: area * dims[n] as u64,
            area,
            trimmed: [0; 3],
            top: BondBody {
                origin_m: at(place(self.top_begins) + gap_m),
                bits: self.top,
            },
            bottom: BondBody {
                origin_m: self.origin_m,
                bits: self.bottom,
            },
        })
    }
}

/// Dimensions cut to whole cells across the bond, and the layers cut off. A stack thinner than a cell (plane strain) is
/// left as it is.
pub(crate) fn whole_cells(dims: [usize; 3], opening: &Opening) -> ([usize; 3], [usize; 3]) {
    let (mut kept, per_cell) = (dims, opening.voxels_per_cell);
    for (a, d) in kept.iter_mut().enumerate() {
        if a != opening.normal.index() && *d > per_cell {
            *d -= *d % per_cell;
        }
    }
    (kept, std::array::from_fn(|a| dims[a] - kept[a]))
}

/// The layer of `wood` that begins at the face between voxels nearest to `plane_m`.
pub(crate) fn layer_at(wood: PlacedVoxels, plane_m: f64, normal: Axis) -> Result<usize, Error> {
    let n = normal.index();
    let layers = ((plane_m - wood.origin_m[n]) / wood.voxel_m).round();
    if layers >= 1.0 && layers < wood.bits.dims()[n] as f64 {
        return Ok(layers as usize);
    }
    Err(Error::new(format!(
        "the bond plane at {:.3} um is outside the specimen, which reaches from {:.3} to {:.3} um along {normal}",
        1e6 * plane_m,
        1e6 * wood.origin_m[n],
        1e6 * wood.max_m()[n]
    )))
}

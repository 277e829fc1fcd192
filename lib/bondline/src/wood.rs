//! A bond before pressing from wood that was never bonded: one piece cut, or two laid up.

use particle_file::{BitGrid, BitsRef};
use units::Axis;

use crate::build::{Opening, Part, assemble, whole_cells};
use crate::faces::{Facing, across, air, depths, describe, without_islands};
use crate::placed::crop;
use crate::{Bond, Error, Placed, slab};

/// What the adherends are made of.
#[derive(Clone, Copy, Debug)]
pub enum Pieces<'a> {
    /// One piece, cut at this coordinate (m), rounded to the nearest face between voxels.
    Cut(Placed<'a>, f64),
    /// Two pieces; the high side of the bottom one and the low side of the top one are glued.
    Two {
        /// Low-coordinate side.
        bottom: Placed<'a>,
        /// High-coordinate side.
        top: Placed<'a>,
    },
}

/// By how much the top piece is turned about the bond normal, right-handed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turn {
    /// Not at all: grain along grain.
    None,
    /// A quarter: cross-laminated, as in plywood.
    Quarter,
    /// A half.
    Half,
    /// Three quarters.
    ThreeQuarters,
}

/// How to lay up undamaged wood.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layup {
    /// Axis across the bond.
    pub normal: Axis,
    /// Adhesive volume over bond area, m.
    pub slab_m: f64,
    /// Voxels along the edge of a cell of the later grid, at least one.
    pub voxels_per_cell: usize,
    /// How far the top piece is moved away from where the two touch (m); `None`: as little as
    /// leaves room for the slab.
    pub gap_m: Option<f64>,
    /// Largest relative change of the adhesive volume by rounding the slab to whole cells.
    pub tolerance: f64,
    /// How the top piece lies on the bottom one.
    pub turn: Turn,
    /// Whether pieces of unequal cross-section are cropped to what they share, from their low
    /// corners; else they are refused.
    pub crop: bool,
    /// Whether wood that floats before a face is left out.
    pub drop_islands: bool,
}

/// Lays up a bond line of undamaged wood before pressing.
///
/// Closed are the pieces where the top one, lowered along the normal, first touches the bottom
/// one: `gap_m` of the bond is the way to there. The slab is flat and touches the highest wood
/// of both.
///
/// # Errors
/// As listed in [`Error`].
pub fn lay_up(pieces: &Pieces, layup: &Layup) -> Result<Bond, Error> {
    let (n, normal) = (layup.normal.index(), layup.normal);
    let (origin_m, voxel_m, [bottom, top]) = parts(pieces, layup)?;
    let (bottom, top) = fitted(bottom, turned(&top, normal, layup.turn), layup)?;
    let (kept, trimmed) = whole_cells(bottom.dims(), normal, layup.voxels_per_cell);
    let face = |piece: &BitGrid, facing| {
        let mut ranges = kept.map(|d| 0..d);
        ranges[n] = 0..piece.dims()[n];
        let piece = crop(piece.view(), &ranges);
        let cleaned = cleaned(piece, layup, facing).ok_or(Error::NoWoodIn {
            piece: name(facing),
        })?;
        Ok((describe(cleaned.view(), normal, facing), cleaned))
    };
    let ((low, bottom), (high, top)) = (face(&bottom, Facing::Up)?, face(&top, Facing::Down)?);

    let area: u64 = (0..3).filter(|&a| a != n).map(|a| kept[a] as u64).product();
    let adhesive_in = layup.slab_m / voxel_m * area as f64;
    let cell_m = layup.voxels_per_cell as f64 * voxel_m;
    let slab_cells = slab::cells(
        adhesive_in,
        area,
        layup.voxels_per_cell,
        layup.tolerance,
        cell_m,
    )?;

    // Layers are counted from the low face of the bottom piece; the top one begins at `touch`.
    let height = bottom.dims()[n];
    let (touch, touching) = touch(bottom.view(), top.view(), normal)?;
    let levels = [height - low.level, touch + high.level];
    let plane = (levels[0] + levels[1]) / 2;
    let layers = |from: usize, to: usize| (to as f64 - from as f64) * voxel_m;
    let slab_m = slab_cells as f64 * cell_m;
    let void = void(&bottom) + void(&top);
    let void_m = void as f64 / area as f64 * voxel_m - layers(touch, height);
    if slab_m > void_m {
        return Err(Error::NoRoom { slab_m, void_m });
    }
    let opening = Opening {
        plane_m: origin_m[n] + plane as f64 * voxel_m,
        gap_m: layup
            .gap_m
            .unwrap_or_else(|| slab_m + layers(touch, height)),
        free_m: [layers(height, plane), layers(plane, touch)],
        severed: touching,
    };
    let mut top_origin_m = origin_m;
    top_origin_m[n] += touch as f64 * voxel_m;
    let bottom = Part {
        origin_m,
        bits: bottom,
    };
    let top = Part {
        origin_m: top_origin_m,
        bits: top,
    };
    let mut bond = assemble(bottom, top, normal, voxel_m, cell_m, slab_cells, &opening)?;
    (bond.adhesive_in, bond.trimmed) = (adhesive_in, trimmed);
    bond.faces = Some([low, high]);
    Ok(bond)
}

fn name(facing: Facing) -> &'static str {
    match facing {
        Facing::Up => "bottom",
        Facing::Down => "top",
    }
}

/// Low corner, voxel edge and wood of the bottom and the top piece.
fn parts(pieces: &Pieces, layup: &Layup) -> Result<([f64; 3], f64, [BitGrid; 2]), Error> {
    let n = layup.normal.index();
    match *pieces {
        Pieces::Cut(wood, plane_m) => {
            let plane = crate::build::layer_at(wood, plane_m, layup.normal)?;
            let dims = wood.bits.dims();
            let cut = [0..plane, plane..dims[n]].map(|layers| {
                let mut ranges = dims.map(|d| 0..d);
                ranges[n] = layers;
                crop(wood.bits, &ranges)
            });
            Ok((wood.origin_m, wood.voxel_m, cut))
        }
        Pieces::Two { bottom, top } => {
            // Edges from the metadata of two scans may differ in their last digits.
            if (top.voxel_m / bottom.voxel_m - 1.0).abs() > 1e-6 {
                return Err(Error::Voxels {
                    bottom_m: bottom.voxel_m,
                    top_m: top.voxel_m,
                });
            }
            let whole = |bits: BitsRef| crop(bits, &bits.dims().map(|d| 0..d));
            let both = [whole(bottom.bits), whole(top.bits)];
            Ok((bottom.origin_m, bottom.voxel_m, both))
        }
    }
}

/// `bits` turned about `normal`, right-handed: a quarter takes the first axis of [`across`] to
/// the second.
fn turned(bits: &BitGrid, normal: Axis, turn: Turn) -> BitGrid {
    let [a, b] = across(normal);
    let from = bits.dims();
    let mut dims = from;
    if matches!(turn, Turn::Quarter | Turn::ThreeQuarters) {
        dims.swap(a, b);
    }
    BitGrid::from_fn(dims, |x, y, z| {
        let at = [x, y, z];
        let mut old = at;
        (old[a], old[b]) = match turn {
            Turn::None => (at[a], at[b]),
            Turn::Quarter => (at[b], from[b] - 1 - at[a]),
            Turn::Half => (from[a] - 1 - at[a], from[b] - 1 - at[b]),
            Turn::ThreeQuarters => (from[a] - 1 - at[b], at[a]),
        };
        bits.get(old[0], old[1], old[2])
    })
}

/// Both pieces at one cross-section, or a refusal.
fn fitted(bottom: BitGrid, top: BitGrid, layup: &Layup) -> Result<(BitGrid, BitGrid), Error> {
    let [a, b] = across(layup.normal);
    let [low, high] = [&bottom, &top].map(|piece| [piece.dims()[a], piece.dims()[b]]);
    if low == high {
        return Ok((bottom, top));
    }
    if !layup.crop {
        return Err(Error::CrossSections {
            axes: [a, b].map(|axis| Axis::ALL[axis]),
            bottom: low,
            top: high,
        });
    }
    let cropped = |piece: BitGrid| {
        let mut ranges = piece.dims().map(|d| 0..d);
        (ranges[a], ranges[b]) = (0..low[0].min(high[0]), 0..low[1].min(high[1]));
        crop(piece.view(), &ranges)
    };
    Ok((cropped(bottom), cropped(top)))
}

/// A piece without islands, if they are to go, and without the air before its face; `None`
/// without wood.
fn cleaned(piece: BitGrid, layup: &Layup, facing: Facing) -> Option<BitGrid> {
    let piece = trimmed(piece, layup.normal, facing)?;
    if !layup.drop_islands {
        return Some(piece);
    }
    let level = describe(piece.view(), layup.normal, facing).level;
    let piece = without_islands(&piece, layup.normal, facing, level);
    trimmed(piece, layup.normal, facing)
}

fn trimmed(piece: BitGrid, normal: Axis, facing: Facing) -> Option<BitGrid> {
    let (n, air) = (normal.index(), air(piece.view(), normal, facing)?);
    let mut ranges = piece.dims().map(|d| 0..d);
    ranges[n] = match facing {
        Facing::Up => 0..piece.dims()[n] - air,
        Facing::Down => air..piece.dims()[n],
    };
    Some(crop(piece.view(), &ranges))
}

/// Voxels that are no wood.
fn void(piece: &BitGrid) -> u64 {
    let voxels: u64 = piece.dims().iter().map(|&d| d as u64).product();
    voxels - piece.count()
}

/// Layer of the bottom piece at which the top one, lowered along the normal, comes to rest, and
/// the number of columns that touch there.
fn touch(bottom: BitsRef, top: BitsRef, normal: Axis) -> Result<(usize, u64), Error> {
    let height = bottom.dims()[normal.index()];
    let low = depths(bottom, normal, Facing::Up);
    let high = depths(top, normal, Facing::Down);
    let apart = || (low.iter().zip(&high)).filter_map(|(l, h)| Some((*l)? + (*h)?));
    // The pieces go into one another by the least of what the columns leave free.
    let least = apart().min().ok_or(Error::NeverMeet)?;
    let touching = apart().filter(|&free| free == least).count() as u64;
    let rest = height.checked_sub(least).ok_or(Error::NeverMeet)?;
    Ok((rest, touching))
}

//! A bond before pressing from undamaged wood: one piece cut, or two pieces laid up.

use particle_file::{BitGrid, BitsRef};
use units::Axis;

use crate::build::{Closed, layer_at, whole_cells};
use crate::faces::{Facing, across, air_layers, depths, measure_face, without_islands};
use crate::placed::{corner, layers};
use crate::{Bond, Error, Opening, PlacedVoxels};

/// The wood of the adherends.
#[derive(Clone, Copy, Debug)]
pub enum Pieces<'a> {
    /// One piece, cut at this coordinate (m), rounded to the nearest face between voxels.
    Cut(PlacedVoxels<'a>, f64),
    /// Two pieces; the high side of the bottom one and the low side of the top one are glued.
    Two {
        /// Low-coordinate side.
        bottom: PlacedVoxels<'a>,
        /// High-coordinate side.
        top: PlacedVoxels<'a>,
    },
}

/// How to lay up undamaged wood.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layup {
    /// Gap and slab.
    pub opening: Opening,
    /// Adhesive volume over bond area, m.
    pub slab_m: f64,
    /// Right-handed quarter turns of the top piece about the bond normal; 1 as in plywood.
    pub quarters: usize,
    /// Whether to crop pieces of unequal cross-section to their common part, aligned at their low corners; else they are
    /// refused.
    pub crop: bool,
    /// Whether to remove loose wood in front of a face.
    pub drop_islands: bool,
}

/// Builds the bond line before pressing from undamaged wood.
///
/// The pieces are closed when the top one, lowered along the normal, first touches the bottom one; `gap_m` of the bond is
/// the distance to there. The slab is flat and touches the outermost wood of both.
///
/// # Errors
/// A plane outside the piece; pieces with different voxels, of unequal width or without wood; pieces that never touch, or
/// whose voids hold less than the slab; a slab or gap that does not fit.
pub fn lay_up(pieces: &Pieces, layup: &Layup) -> Result<Bond, Error> {
    let normal = layup.opening.normal;
    let n = normal.index();
    let (origin_m, voxel_m, bottom, mut top) = split_pieces(pieces, normal)?;
    for _ in 0..layup.quarters {
        top = quarter_turn(&top, normal);
    }
    let (bottom, top) = to_equal_width(bottom, top, layup)?;
    let (kept, trimmed) = whole_cells(bottom.dims(), &layup.opening);
    let face = |piece: &BitGrid, facing, name| {
        let mut dims = kept;
        dims[n] = piece.dims()[n];
        let cleaned = clean(corner(piece.view(), dims), layup, facing);
        let cleaned =
            cleaned.ok_or_else(|| Error::unfit(format!("the {name} piece holds no wood")))?;
        Ok((measure_face(cleaned.view(), normal, facing), cleaned))
    };
    let (low, bottom) = face(&bottom, Facing::Up, "bottom")?;
    let (high, top) = face(&top, Facing::Down, "top")?;

    let area: u64 = (0..3).filter(|&a| a != n).map(|a| kept[a] as u64).product();
    let height = bottom.dims()[n];
    let (touch, severed) = first_contact(bottom.view(), top.view(), normal)?;
    let plane = (height - low.level + touch + high.level) / 2;
    let void_m = (void_voxels(&bottom) + void_voxels(&top)) as f64 / area as f64 * voxel_m;
    let closed = Closed {
        origin_m,
        voxel_m,
        bottom,
        top,
        top_begins: touch,
        plane,
        free_layers: [plane as i64 - height as i64, touch as i64 - plane as i64],
        severed,
        void_m: void_m - (height - touch) as f64 * voxel_m,
        adhesive_in: layup.slab_m / voxel_m * area as f64,
    };
    Ok(Bond {
        trimmed,
        faces: Some([low, high]),
        ..closed.open(&layup.opening)?
    })
}

/// Low corner, voxel edge and wood of the bottom and the top piece.
fn split_pieces(pieces: &Pieces, normal: Axis) -> Result<([f64; 3], f64, BitGrid, BitGrid), Error> {
    let n = normal.index();
    match *pieces {
        Pieces::Cut(wood, plane_m) => {
            let plane = layer_at(wood, plane_m, normal)?;
            let above = plane..wood.bits.dims()[n];
            let [bottom, top] = [0..plane, above].map(|part| layers(wood.bits, n, part));
            Ok((wood.origin_m, wood.voxel_m, bottom, top))
        }
        Pieces::Two { bottom, top } => {
            // Voxel edges in the metadata of two scans may differ in the last digits.
            if (top.voxel_m / bottom.voxel_m - 1.0).abs() > 1e-6 {
                return Err(Error::new(format!(
                    "the voxels of the bottom piece have edges of {:.6} um and those of the top piece {:.6} um: both must be the same, so scale one stack to the other's",
                    1e6 * bottom.voxel_m,
                    1e6 * top.voxel_m
                )));
            }
            let whole = |bits: BitsRef| corner(bits, bits.dims());
            let (below, above) = (whole(bottom.bits), whole(top.bits));
            Ok((bottom.origin_m, bottom.voxel_m, below, above))
        }
    }
}

/// `bits` after a right-handed quarter turn about `normal`, from the first axis of [`across`] to the second.
fn quarter_turn(bits: &BitGrid, normal: Axis) -> BitGrid {
    let [a, b] = across(normal);
    let from = bits.dims();
    let mut dims = from;
    dims.swap(a, b);
    BitGrid::from_fn(dims, |x, y, z| {
        let at = [x, y, z];
        let mut old = at;
        (old[a], old[b]) = (at[b], from[b] - 1 - at[a]);
        bits.get(old[0], old[1], old[2])
    })
}

fn to_equal_width(
    bottom: BitGrid,
    top: BitGrid,
    layup: &Layup,
) -> Result<(BitGrid, BitGrid), Error> {
    let [a, b] = across(layup.opening.normal);
    let [low, high] = [&bottom, &top].map(|piece| [piece.dims()[a], piece.dims()[b]]);
    if low == high {
        return Ok((bottom, top));
    }
    if !layup.crop {
        let [[i, j], [k, l]] = [low, high];
        return Err(Error::new(format!(
            "the bottom piece is {i} x {j} voxels wide along {} and {} and the top piece, as it lies, {k} x {l}: crop them to the same size, or give --crop-to-fit to keep what they share from their low corners",
            Axis::ALL[a],
            Axis::ALL[b]
        )));
    }
    let cropped = |piece: BitGrid| {
        let mut dims = piece.dims();
        (dims[a], dims[b]) = (low[0].min(high[0]), low[1].min(high[1]));
        corner(piece.view(), dims)
    };
    Ok((cropped(bottom), cropped(top)))
}

/// A piece without the air in front of its face and, if asked for, without islands; `None` without wood.
fn clean(piece: BitGrid, layup: &Layup, facing: Facing) -> Option<BitGrid> {
    let piece = without_air(piece, layup.opening.normal, facing)?;
    if !layup.drop_islands {
        return Some(piece);
    }
    let level = measure_face(piece.view(), layup.opening.normal, facing).level;
    let piece = without_islands(piece, layup.opening.normal, facing, level);
    without_air(piece, layup.opening.normal, facing)
}

fn without_air(piece: BitGrid, normal: Axis, facing: Facing) -> Option<BitGrid> {
    let (n, air) = (normal.index(), air_layers(piece.view(), normal, facing)?);
    let height = piece.dims()[n];
    let wood = match facing {
        Facing::Up => 0..height - air,
        Facing::Down => air..height,
    };
    Some(layers(piece.view(), n, wood))
}

fn void_voxels(piece: &BitGrid) -> u64 {
    let voxels: u64 = piece.dims().iter().map(|&d| d as u64).product();
    voxels - piece.count()
}

/// Layer of the bottom piece at which the lowered top piece begins when they touch, and the number of touching columns.
fn first_contact(bottom: BitsRef, top: BitsRef, normal: Axis) -> Result<(usize, u64), Error> {
    let height = bottom.dims()[normal.index()];
    let low = depths(bottom, normal, Facing::Up);
    let high = depths(top, normal, Facing::Down);
    let apart = || (low.iter().zip(&high)).filter_map(|(l, h)| Some((*l)? + (*h)?));
    // The pieces can interlock by the least free depth of all columns.
    match apart().min() {
        Some(least) if least <= height => {
            let touching = apart().filter(|&free| free == least).count() as u64;
            Ok((height - least, touching))
        }
        _ => Err(Error::new(
            "wood of the top piece meets wood of the bottom piece nowhere along the normal",
        )),
    }
}

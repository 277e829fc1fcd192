//! The bond face of a piece of undamaged wood: level, roughness, loose islands.

use std::ops::Range;

use particle_file::{BitGrid, BitsRef};
use units::Axis;

use crate::layers_to_surface;
use crate::placed::layers;

/// The side of a piece that faces the bond.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Facing {
    /// The high side, of the bottom piece.
    Up,
    /// The low side, of the top piece.
    Down,
}

/// The bond surface of a piece. Depths are counted in voxels from the highest wood, into the
/// piece.
///
/// The surface consists of the first wood voxel in each column along the bond normal. A column over a cut lumen counts with
/// the depth of the lumen's floor, as for a profilometer; columns without wood do not count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Face {
    /// First layer with a quarter of the typical wood fraction of the piece ([`layers_to_surface`]), from which penetration is measured.
    pub level: usize,
    /// Mean depth of the first wood voxel of the columns.
    pub mean: f64,
    /// Root mean square deviation of these depths (Sq of ISO 25178-2).
    pub roughness: f64,
    /// Fraction of the columns with wood.
    pub covered: f64,
    /// Wood voxels in front of `level` that are not connected to it.
    pub islands: u64,
}

/// The two axes across `normal`, in an order that makes the three right-handed.
pub(crate) fn across(normal: Axis) -> [usize; 2] {
    [1, 2].map(|step| (normal.index() + step) % 3)
}

/// Layers of air in front of the wood; `None` without wood.
pub(crate) fn air_layers(bits: BitsRef, normal: Axis, facing: Facing) -> Option<usize> {
    let counts = counts_from_bond(bits, normal, facing);
    counts.iter().position(|&n| n > 0)
}

/// Wood voxels in each layer, from the bond into the piece.
fn counts_from_bond(bits: BitsRef, normal: Axis, facing: Facing) -> Vec<u64> {
    let mut counts = bits.counts_along(normal.index());
    if facing == Facing::Up {
        counts.reverse();
    }
    counts
}

/// Depth of the first wood voxel of each column, first axis of [`across`] fastest; `None` for a column without wood.
pub(crate) fn depths(bits: BitsRef, normal: Axis, facing: Facing) -> Vec<Option<usize>> {
    let (dims, n) = (bits.dims(), normal.index());
    let [a, b] = across(normal);
    let mut depths = vec![None; dims[a] * dims[b]];
    bits.for_each(|index| {
        let depth = match facing {
            Facing::Up => dims[n] - 1 - index[n],
            Facing::Down => index[n],
        };
        let first = &mut depths[index[b] * dims[a] + index[a]];
        *first = Some(first.map_or(depth, |least: usize| least.min(depth)));
    });
    depths
}

/// The face of a piece without air in front of it.
pub(crate) fn measure_face(bits: BitsRef, normal: Axis, facing: Facing) -> Face {
    let depths = depths(bits, normal, facing);
    let met: Vec<f64> = depths.iter().flatten().map(|&d| d as f64).collect();
    let count = met.len().max(1) as f64;
    let mean = met.iter().sum::<f64>() / count;
    let square = met.iter().map(|d| (d - mean).powi(2)).sum::<f64>() / count;
    let level = layers_to_surface(&counts_from_bond(bits, normal, facing)).unwrap_or(0);
    Face {
        level,
        mean,
        roughness: square.sqrt(),
        covered: met.len() as f64 / depths.len().max(1) as f64,
        islands: islands(bits, normal, facing, level).count(),
    }
}

/// Islands: wood in front of layer `level` that is not connected to the wood of that layer over faces, edges or corners.
/// Wood connected to the piece deeper down passes through that layer, so only loose wood is found. The grid holds the
/// layers down to `level`.
pub(crate) fn islands(bits: BitsRef, normal: Axis, facing: Facing, level: usize) -> BitGrid {
    let n = normal.index();
    let mut floating = layers(bits, n, layers_in_front(bits, normal, facing, level));
    let dims = floating.dims();
    let base = match facing {
        Facing::Up => 0,
        Facing::Down => dims[n] - 1,
    };
    let mut connected = Vec::new();
    layers(floating.view(), n, base..base + 1)
        .view()
        .for_each(|mut at| {
            at[n] = base;
            connect(&mut floating, at, &mut connected);
        });
    while let Some(at) = connected.pop() {
        for step in 0..27 {
            let step = [step % 3, step / 3 % 3, step / 9];
            let next: [usize; 3] = std::array::from_fn(|i| (at[i] + step[i]).wrapping_sub(1));
            if (0..3).all(|i| next[i] < dims[i]) {
                connect(&mut floating, next, &mut connected);
            }
        }
    }
    floating
}

/// The layers from the bond down to `level`.
fn layers_in_front(bits: BitsRef, normal: Axis, facing: Facing, level: usize) -> Range<usize> {
    let all = bits.dims()[normal.index()];
    let count = (level + 1).min(all);
    match facing {
        Facing::Up => all - count..all,
        Facing::Down => 0..count,
    }
}

fn connect(floating: &mut BitGrid, at: [usize; 3], connected: &mut Vec<[usize; 3]>) {
    let [x, y, z] = at;
    if floating.get(x, y, z) {
        floating.set(x, y, z, false);
        connected.push(at);
    }
}

pub(crate) fn without_islands(
    mut bits: BitGrid,
    normal: Axis,
    facing: Facing,
    level: usize,
) -> BitGrid {
    let floating = islands(bits.view(), normal, facing, level);
    let first = layers_in_front(bits.view(), normal, facing, level).start;
    floating.view().for_each(|mut at| {
        at[normal.index()] += first;
        bits.set(at[0], at[1], at[2], false);
    });
    bits
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A piece 6 layers high along y with a step, a groove and a speck before it.
    fn piece() -> BitGrid {
        BitGrid::from_fn([8, 6, 4], |x, y, z| match y {
            0..3 => x != 5,
            3 => x < 4,
            5 => (x, z) == (7, 3),
            _ => false,
        })
    }

    #[test]
    fn depths_levels_and_islands_of_a_step_are_counted_by_hand() {
        let grid = piece();
        let face = measure_face(grid.view(), Axis::Y, Facing::Up);
        // Depths by column: two layers for x 0..4, three for 4, 6 and 7, zero at the speck; x = 5 has no wood.
        assert_eq!((face.level, face.islands), (2, 1));
        assert_eq!(face.covered, 28.0 / 32.0);
        let mean = (16.0 * 2.0 + 11.0 * 3.0) / 28.0;
        assert!((face.mean - mean).abs() < 1e-12);
        let square: f64 = 16.0 * (2.0 - mean).powi(2) + 11.0 * (3.0 - mean).powi(2) + mean * mean;
        assert!((face.roughness - (square / 28.0).sqrt()).abs() < 1e-12);
        let clean = without_islands(grid.clone(), Axis::Y, Facing::Up, face.level);
        assert_eq!(clean.count(), grid.count() - 1);
        assert_eq!(air_layers(clean.view(), Axis::Y, Facing::Up), Some(2));
        // From below the piece is flat except for the groove.
        let below = measure_face(grid.view(), Axis::Y, Facing::Down);
        assert_eq!((below.level, below.mean, below.roughness), (0, 0.0, 0.0));
    }

    #[test]
    fn an_overhang_that_is_joined_is_no_island() {
        // A post with a lip that overhangs the groove, connected over a corner.
        let grid = BitGrid::from_fn([6, 6, 1], |x, y, _| {
            y < 2 || (x, y) == (2, 2) || (x, y) == (3, 3)
        });
        let level = measure_face(grid.view(), Axis::Y, Facing::Up).level;
        assert_eq!(level, 4);
        assert_eq!(islands(grid.view(), Axis::Y, Facing::Up, level).count(), 0);
    }
}

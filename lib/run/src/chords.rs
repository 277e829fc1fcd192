//! Lumen width at the bond: chords of the voids, in voxels and cells.

use std::collections::BTreeMap;

use physics::{Scene, VoxelBlock};

use crate::omissions::Remark;

/// Depth from the bond surface in which chords are measured, voxels.
const LAYERS: usize = 32;
/// Cells across a lumen below which the error of the implicit scheme exceeds 10 % in places
/// (docs/results/verification.md: three cells; docs/results/tradeoff.md: bond line).
const FEWEST_CELLS: f64 = 5.0;

/// Lumen width and, if few cells span a lumen, a proposed cell size. Empty for boxes and for wood without lumens.
pub(crate) fn remarks(scene: &Scene) -> Vec<Remark> {
    let sides = [(scene.bottom, true), (scene.top, false)];
    // Boxes have no lumens.
    let blocks = sides.map(
        |(body, up)| match scene.bodies.get(body?)?.blocks.as_slice() {
            [block] if block.dims() != [1; 3] => Some((block, up)),
            _ => None,
        },
    );
    let mut lengths = Lengths::default();
    for (block, up) in blocks.into_iter().flatten() {
        for (length, n) in across_grain(block, up) {
            *lengths.entry(length).or_default() += n;
        }
    }
    let block = blocks.into_iter().flatten().next();
    let (Some(chord), Some((block, _))) = (median(&lengths), block) else {
        return Vec::new();
    };
    let (voxel, cell) = (block.voxel()[0], scene.grid.cell_m);
    let cells = chord as f64 * voxel / cell;
    let mut out = vec![Remark {
        what: "lumens at the bond",
        why: format!(
            "{chord} voxels across the grain, {cells:.1} cells (median by volume of {} chords)",
            lengths.values().sum::<u64>()
        ),
    }];
    if cells < FEWEST_CELLS && cell > 1.01 * voxel {
        // An influence length given in cells would shrink with the cell, so the proposal fixes it in um.
        let length = scene.wall.influence_length();
        let same_walls = match length > 0.0 && length.is_finite() {
            true => format!(" and contact.influence_length = \"{:.6} um\"", 1e6 * length),
            false => String::new(),
        };
        let um = 1e6 * voxel;
        out.push(Remark {
            what: "proposed",
            why: format!(
                "cells of one voxel, grid.cell = \"{um:.6} um\"{same_walls}: with fewer than {FEWEST_CELLS} cells across, pressure and flow are off by 10 % and more"
            ),
        });
    }
    out
}

/// Number of chords by length (voxels).
type Lengths = BTreeMap<usize, u64>;

/// Median chord weighted by volume, so that the many short chords of pits and rays do not dominate.
fn median(lengths: &Lengths) -> Option<usize> {
    let volume = |(&length, &n): (&usize, &u64)| length as u64 * n;
    let all: u64 = lengths.iter().map(volume).sum();
    let mut below = 0;
    let half = lengths.iter().find(|&run| {
        below += volume(run);
        2 * below >= all
    });
    half.map(|(&length, _)| length)
}

/// Chords of the voids near the bond surface, from wood to wood and across the grain. The surface is the upper face of the
/// block if `up`, else the lower one. The grain is the direction in the bond plane with the longer voids.
fn across_grain(block: &VoxelBlock, up: bool) -> Lengths {
    let [nx, ny, nz] = block.dims();
    let depth = LAYERS.min(ny);
    let layers = if up { ny - depth..ny } else { 0..depth };
    let mut found = [Stretches::default(), Stretches::default()];
    for j in layers {
        for k in 0..nz {
            found[0].add_line(nx, |i| block.solid(i, j, k));
        }
        for i in 0..nx {
            found[1].add_line(nz, |k| block.solid(i, j, k));
        }
    }
    let [x, z] = found;
    if x.mean() <= z.mean() {
        x.chords
    } else {
        z.chords
    }
}

/// Stretches of void along lines of voxels.
#[derive(Default)]
struct Stretches {
    /// Stretches with wood at both ends.
    chords: Lengths,
    /// Void voxels and stretches, those at the edge of the block included.
    total: [u64; 2],
}

impl Stretches {
    fn add_line(&mut self, length: usize, solid: impl Fn(usize) -> bool) {
        let mut start = 0;
        for end in 0..=length {
            if end < length && !solid(end) {
                continue;
            }
            if end > start {
                self.total[0] += (end - start) as u64;
                self.total[1] += 1;
                if start > 0 && end < length {
                    *self.chords.entry(end - start).or_default() += 1;
                }
            }
            start = end + 1;
        }
    }

    /// Mean length, voxels; infinite if there is no void.
    fn mean(&self) -> f64 {
        match self.total {
            [_, 0] => f64::INFINITY,
            [voxels, stretches] => voxels as f64 / stretches as f64,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lumens seven voxels wide along z or x; walls of five voxels with pits of one, which outnumber the lumens; end walls that
    /// close a lumen here and there. Voids deep below the bond and at the edge of the block do not count.
    #[test]
    fn the_median_chord_across_the_grain_at_the_bond() {
        for along_z in [true, false] {
            let wood = |i: usize, j: usize, k: usize| {
                let (across, along) = if along_z { (i, k) } else { (k, i) };
                let deep = j < 20;
                !deep && (across % 12 < 5 && across % 12 != 2 || along % 50 == 20)
            };
            let block = VoxelBlock::from_fn([0.0; 3], [1e-6; 3], [90, 60, 90], wood);
            let chords = across_grain(&block, true);
            assert_eq!(median(&chords), Some(7));
            assert_eq!(chords.values().sum::<u64>(), 32 * 88 * (7 + 8));
        }
    }

    #[test]
    fn solid_wood_and_open_space_have_no_chords() {
        for solid in [true, false] {
            let block = VoxelBlock::from_fn([0.0; 3], [1e-6; 3], [8; 3], |_, _, _| solid);
            assert_eq!(median(&across_grain(&block, false)), None);
        }
    }
}

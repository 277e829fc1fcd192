//! Pressure from the mean volume change of each cell instead of each point's own.
//!
//! A point's own J takes up every error of its velocity gradient and never gives it back: in
//! narrow lumens J scatters by per cents, which at K = 1 GPa is tens of MPa of noise. With this
//! option the points of a cell share, after every step, the volume-weighted mean
//! J_c = sum V0 J / sum V0, which keeps the liquid's volume to rounding. Cells are those of the
//! grid, between nodes; averaging J over them is the constant-pressure element's cure of locking
//! (Nagtegaal, Parks & Rice, 10.1016/0045-7825(74)90032-2).

use rayon::prelude::*;

use crate::fields::point::{J, VOLUME};
use crate::lattice::HALO;
use crate::nodes::Block;
use crate::real::Real;
use crate::stress::Stress;
use crate::tiles::{Points, Scratch, Tile};
use crate::topology::Grid;

/// Entry of the halo that stands for a point's cell: its lowest node.
#[inline]
fn cell_of(points: &Points, p: usize, axes: usize) -> usize {
    const STRIDE: [usize; 3] = [1, HALO, HALO * HALO];
    let d = points.place[p].0;
    let above: usize = (0..axes).filter(|&a| d[a] >= 0.0).map(|a| STRIDE[a]).sum();
    usize::from(points.base[p]) + above
}

/// Replaces the volume rate of every point by that of its cell, the flux through the cell's
/// faces; the scratch holds the nodal velocities. The mean over the points themselves would
/// do only while they lie evenly: where they do not, the nodes have null-space modes that no point
/// senses, by which liquid is compressed without pressure.
#[inline(never)] // `make leave-out` counts its instructions by its name
pub(crate) fn share_rate(tile: &Tile, scratch: &mut Scratch, axes: usize) {
    const STRIDE: [usize; 3] = [1, HALO, HALO * HALO];
    let scale = 1.0 / (1 << (axes - 1)) as Real;
    for p in 0..tile.points.len() {
        let low = cell_of(&tile.points, p, axes);
        let mut rate = 0.0;
        for corner in 0..1_usize << axes {
            let node: usize = (0..axes).map(|a| (corner >> a & 1) * STRIDE[a]).sum();
            let v = &scratch.field[low + node].0;
            for a in 0..axes {
                rate += if corner >> a & 1 == 1 { v[a] } else { -v[a] };
            }
        }
        let own = scratch.gradient.trace(p);
        // A third to each axis, also in plane strain, so that the deviator stays.
        scratch.gradient.stretch(p, (rate * scale - own) / 3.0);
    }
}

/// Gives all points of a cell the same J, and with it the same pressure.
pub(crate) fn equalise(grid: &mut Grid, stress: &Stress) {
    let axes = grid.lattice.axes();
    grid.tiles.par_iter_mut().for_each(|tile| sum(tile, axes));
    let tiles = &grid.tiles;
    grid.blocks
        .par_iter_mut()
        .for_each(|block| gather(block, tiles));
    let blocks = &grid.blocks;
    grid.tiles
        .par_iter_mut()
        .for_each(|tile| apply(tile, blocks, axes, stress));
}

fn sum(tile: &mut Tile, axes: usize) {
    tile.cells.fill([0.0; 2]);
    for p in 0..tile.points.len() {
        let (volume, j) = (tile.points.place[p].0[VOLUME], tile.points.motion[p].0[J]);
        let cell = &mut tile.cells[cell_of(&tile.points, p, axes)];
        cell[0] += volume;
        cell[1] += volume * j;
    }
}

/// Sums over the tiles, in the order of the block's spans. Mirrored entries hold nothing:
/// no point lies beyond a mirror.
fn gather(block: &mut Block, tiles: &[Tile]) {
    block.cells.fill([0.0; 2]);
    for span in &block.spans {
        let cells = &tiles[span.other as usize].cells[span.entries()];
        for (sum, [volume, j]) in block.cells[span.nodes()].iter_mut().zip(cells) {
            sum[0] += volume;
            sum[1] += j;
        }
    }
}

fn apply(tile: &mut Tile, blocks: &[Block], axes: usize, stress: &Stress) {
    for span in &tile.spans {
        let block = &blocks[span.other as usize];
        tile.cells[span.entries()].copy_from_slice(&block.cells[span.nodes()]);
    }
    for p in 0..tile.points.len() {
        let [volume, sum] = tile.cells[cell_of(&tile.points, p, axes)];
        let j = &mut tile.points.motion[p].0[J];
        let before = stress.pressure(*j);
        *j = sum / volume;
        let change = before - stress.pressure(*j);
        for normal in &mut tile.points.stress[p].0[..3] {
            *normal += change;
        }
    }
}

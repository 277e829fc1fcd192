//! Values of the nodes for the points of a tile: copied from its halo, mirrored where a side mirrors.

use crate::fields::node;
use crate::lanes::Lanes8;
use crate::nodes::Block;
use crate::tiles::{NOWHERE, Tile, unlink};

/// Copies the nodal velocities of a tile's halo to `field`.
pub(crate) fn gather_velocity(tile: &Tile, blocks: &[Block], field: &mut Vec<Lanes8>) {
    copy(tile, field, |block, node| blocks[block].velocity[node]);
}

/// Copies w_l of the velocity filter of a tile's halo to `field`, twice: for two points at a time.
pub(crate) fn gather_filtered(tile: &Tile, blocks: &[Block], field: &mut Vec<Lanes8>) {
    copy(tile, field, |block, node| {
        let w = blocks[block].filtered(node);
        Lanes8::of(w, w)
    });
}

#[inline(always)]
fn copy(tile: &Tile, field: &mut Vec<Lanes8>, of: impl Fn(usize, usize) -> Lanes8) {
    field.clear();
    field.extend(tile.links.iter().map(|&link| {
        if link == NOWHERE {
            return Lanes8::ZERO;
        }
        let (block, node) = unlink(link);
        of(block, node)
    }));
    for (value, &flip) in field.iter_mut().zip(&tile.flips) {
        for a in (0..3).filter(|a| flip & (1 << a) != 0) {
            value.0[a] = -value.0[a];
            value.0[node::SECOND + a] = -value.0[node::SECOND + a];
        }
    }
}

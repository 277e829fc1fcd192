//! Values of the nodes for the points of a tile: copied to its halo, mirrored where a side mirrors.

use crate::fields::node;
use crate::lanes::Lanes8;
use crate::nodes::Block;
use crate::tiles::{NOWHERE, Tile, unlink};

/// Copies the nodal velocities to the halo of a tile.
pub(crate) fn gather_velocity(tile: &mut Tile, blocks: &[Block]) {
    for (value, &link) in tile.local.iter_mut().zip(&tile.links) {
        if link != NOWHERE {
            let (block, node) = unlink(link);
            *value = blocks[block].velocity[node];
        }
    }
    for (value, &flip) in tile.local.iter_mut().zip(&tile.flips) {
        for a in (0..3).filter(|a| flip & (1 << a) != 0) {
            value.0[a] = -value.0[a];
            value.0[node::SECOND + a] = -value.0[node::SECOND + a];
        }
    }
}

/// Copies w_l of the velocity filter to the halo of a tile, twice: for two points at a time.
pub(crate) fn gather_filtered(tile: &mut Tile, blocks: &[Block]) {
    for (value, &link) in tile.filter_in.iter_mut().zip(&tile.links) {
        if link != NOWHERE {
            let (block, node) = unlink(link);
            let w = blocks[block].filtered(node);
            *value = Lanes8::of(w, w);
        }
    }
    for (value, &flip) in tile.filter_in.iter_mut().zip(&tile.flips) {
        for a in (0..3).filter(|a| flip & (1 << a) != 0) {
            value.0[a] = -value.0[a];
            value.0[4 + a] = -value.0[4 + a];
        }
    }
}

//! Values of the nodes for the points of a tile: copied to its halo, mirrored where a side mirrors.

use crate::fields::node;
use crate::lanes::Lanes8;
use crate::nodes::Block;
use crate::tiles::Tile;

/// Copies the nodal velocities of a tile's halo to `field`.
pub(crate) fn gather_velocity(tile: &Tile, blocks: &[Block], field: &mut Vec<Lanes8>) {
    copy(tile, blocks, field, |block, node| block.velocity[node]);
}

/// Copies w_l of the velocity filter of a tile's halo to `field`, twice: for two points at a time.
pub(crate) fn gather_filtered(tile: &Tile, blocks: &[Block], field: &mut Vec<Lanes8>) {
    copy(tile, blocks, field, |block, node| {
        let w = block.filtered(node);
        Lanes8::of(w, w)
    });
}

#[inline(always)]
fn copy(
    tile: &Tile,
    blocks: &[Block],
    field: &mut Vec<Lanes8>,
    of: impl Fn(&Block, usize) -> Lanes8,
) {
    field.clear();
    field.resize(tile.local.len(), Lanes8::ZERO);
    for span in &tile.spans {
        let block = &blocks[span.other as usize];
        for (value, node) in field[span.entries()].iter_mut().zip(span.nodes()) {
            *value = of(block, node);
            for a in span.mirrored() {
                value.0[a] = -value.0[a];
                value.0[node::SECOND + a] = -value.0[node::SECOND + a];
            }
        }
    }
}

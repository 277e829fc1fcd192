//! Values of the nodes for the points of a tile: copied to its halo, mirrored where a side mirrors.

use crate::fields::node;
use crate::lanes::Lanes8;
use crate::nodes::Block;
use crate::tiles::Tile;

/// Copies the nodal velocities of a tile's halo to `field`.
pub(crate) fn gather_velocity(tile: &Tile, blocks: &[Block], field: &mut Vec<Lanes8>) {
    copy(tile, field, |block| &blocks[block].velocity, |v| v);
}

/// Copies w_l of the velocity filter of a tile's halo to `field`, twice: for two points at a time.
pub(crate) fn gather_filtered(tile: &Tile, blocks: &[Block], field: &mut Vec<Lanes8>) {
    copy(
        tile,
        field,
        |block| blocks[block].filtered(),
        |w| Lanes8::of(w, w),
    );
}

/// What no span covers is out of every point's reach: it keeps what was there before.
#[inline(always)]
fn copy<'a, T: Copy + 'a>(
    tile: &Tile,
    field: &mut Vec<Lanes8>,
    nodes: impl Fn(usize) -> &'a [T],
    of: impl Fn(T) -> Lanes8,
) {
    field.resize(tile.local.len(), Lanes8::ZERO);
    for span in &tile.spans {
        let nodes = &nodes(span.other as usize)[span.nodes()];
        let values = &mut field[span.entries()];
        span.each(values, nodes, |value, &node| *value = of(node));
        if span.flip != 0 {
            for a in span.mirrored() {
                for value in &mut *values {
                    value.0[a] = -value.0[a];
                    value.0[node::SECOND + a] = -value.0[node::SECOND + a];
                }
            }
        }
    }
}

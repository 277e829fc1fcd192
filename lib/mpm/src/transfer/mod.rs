//! Transfers between points and nodes.
//!
//! Every kernel works on one tile. A point's window of 3 x 3 x 3 nodes is summed axis by axis,
//! z outermost, so that a point costs about 90 eight-lane operations; the lanes are fields.

mod filter;
mod g2p;
mod kernels;
mod p2g;

use filter::Filter;
use g2p::G2p;
pub(crate) use kernels::{AnyFlow, Kernels};
use p2g::P2g;

use crate::lattice::HALO;

/// Halo entries from the first to the last node of a window.
pub(crate) const fn window(dimensions: usize) -> usize {
    let plane = 2 * HALO + 3;
    if dimensions == 3 {
        2 * HALO * HALO + plane
    } else {
        plane
    }
}

/// Window layers along z.
pub(crate) const fn layers(dimensions: usize) -> usize {
    if dimensions == 3 { 3 } else { 1 }
}

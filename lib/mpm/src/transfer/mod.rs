//! Transfers between points and nodes.
//!
//! Every kernel works on one tile. A point's window of 3 x 3 x 3 nodes is summed axis by axis,
//! z outermost, so that a point costs about 90 eight-lane operations; the lanes are fields.

mod filter;
mod g2p;
mod kernels;
mod p2g;

pub(crate) use kernels::{AnyFlow, Kernels};

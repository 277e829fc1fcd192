//! Loss of water: diffusion between pores and uptake by walls (docs/methods.md section 3.11).

mod solve;
mod walls;

pub(crate) use solve::{Node, solve};
pub(crate) use walls::AbsorbingWalls;

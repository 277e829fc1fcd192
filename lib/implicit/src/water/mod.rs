//! Water that goes from the liquid into the walls: what a step moves between pores and into walls.

mod solve;
mod walls;

pub(crate) use solve::{Node, solve};
pub(crate) use walls::Walls;

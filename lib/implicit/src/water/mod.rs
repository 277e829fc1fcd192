//! Water that goes from the liquid into the walls: what a step moves between pores and into walls, and the account of it.

mod account;
mod exchange;
mod solve;
mod walls;

pub(crate) use account::Account;
pub(crate) use exchange::{Exchange, Medium};
pub(crate) use walls::Walls;

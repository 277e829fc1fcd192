//! The explicit scheme: the paper's multimaterial material point method (MPM).
//!
//! A step reads as in `step.rs`: points to nodes, contact with the rigid bodies
//! and sides, momentum update, contact again, velocity filter, nodes to points, stress.
//! Equations and order: Sulsky, Chen & Schreyer (10.1016/0045-7825(94)90112-0), XPIC:
//! Hammerquist & Nairn (10.1016/j.cma.2017.01.035), contact: Nairn, Hammerquist & Smith
//! (10.1016/j.cma.2018.04.032).
//!
//! Liquid points live in tiles of 4 x 4 x 4 nodes, each point with its nearest node and its
//! offset from it; nodes live in blocks of the same size, which exist only where liquid is.
//! Lengths inside are in cells, masses in (density x cell^3), velocities in m/s.
//!
//! Modules use one another in one direction, each only those named before it:
//! `real`, `fields`, `lanes`, `simd`, `settings`, `stages` | `lattice`, `runs`, `shape`, `window`, `contact`, `walls` |
//! `tiles`, `nodes`, `topology`, `halo` | `material`, `transfer`, `cell_mean`, `collide`, `density` |
//! `plan`, `explicit`, `start`, `checks`, `step`, `saved`, `scheme`.

// Loops over axes and lanes index several short arrays at once.
#![allow(clippy::needless_range_loop)]
// Casts and conversions of `Real` are idle in one of its two precisions.
#![allow(clippy::unnecessary_cast, clippy::useless_conversion)]

mod cell_mean;
mod checks;
mod collide;
mod contact;
mod density;
mod explicit;
mod fields;
mod gradient;
mod halo;
mod lanes;
mod lattice;
mod material;
mod nodes;
mod plan;
mod real;
mod runs;
mod saved;
mod scheme;
mod settings;
mod shape;
mod simd;
mod stages;
mod start;
mod step;
mod stress;
mod tiles;
mod topology;
mod transfer;
mod walls;
mod window;

pub use explicit::Explicit;
pub use plan::{Limit, Plan};
pub use settings::{PressureFrom, Settings, ShapeFunction, VelocityUpdate};

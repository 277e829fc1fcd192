//! From a specimen to the bond line before pressing (paper section 2.1, Fig. 2): the adhesive
//! is removed, the wood is split at the bond plane, the top adherend is moved away and a
//! rectangular slab with the volume of the removed adhesive takes the space between.
//!
//! Everything happens in the axes of the stack; only the layers are counted along the bond
//! normal. "Bottom" is the low-coordinate side.

mod build;
mod error;
mod placed;
mod plane;
mod slab;

pub use build::{Bond, Options, Plane, build};
pub use error::Error;
pub use placed::{Placed, Specimen};
pub use plane::{BondLine, Profile, find, surface};

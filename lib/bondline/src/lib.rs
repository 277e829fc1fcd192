//! From a specimen to the bond line before pressing (paper section 2.1, Fig. 2): the adhesive
//! is removed, the wood is split at the bond plane, the top adherend is moved away and a
//! rectangular slab with the volume of the removed adhesive takes the space between.
//!
//! For undamaged wood, one piece cut or two laid up, [`lay_up`] does the same with a slab of given thickness.
//!
//! All coordinates are those of the stack; layers count along the bond normal. "Bottom" is the low-coordinate side.

mod build;
mod error;
mod faces;
mod lay_up;
mod open_voids;
mod placed;
mod plane;
mod room;
mod severed;
mod slab;

pub use build::{Bond, Opening, build};
pub use error::Error;
pub use faces::Face;
pub use lay_up::{Layup, Pieces, lay_up};
pub use open_voids::open_voids;
pub use placed::{PlacedVoxels, Specimen};
pub use plane::{BondLine, find_bond_line, layers_to_surface};
pub use room::{Press, Room};
pub use severed::{severed, severed_doubt};

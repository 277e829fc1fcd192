//! From a specimen to the bond line before pressing (paper section 2.1, Fig. 2): the adhesive
//! is removed, the wood is split at the bond plane, the top adherend is moved away and a
//! rectangular slab with the volume of the removed adhesive takes the space between.
//!
//! Undamaged wood, one piece cut or two laid up, comes to the same by [`lay_up`], its slab by
//! thickness.
//!
//! Everything happens in the axes of the stack; only the layers are counted along the bond
//! normal. "Bottom" is the low-coordinate side.

mod build;
mod cut;
mod error;
mod faces;
mod open;
mod placed;
mod plane;
mod slab;
mod wood;

pub use build::{Bond, Opening, build};
pub use cut::{doubt, severed};
pub use error::Error;
pub use faces::Face;
pub use open::open_voids;
pub use placed::{Placed, Specimen};
pub use plane::{BondLine, find, surface};
pub use wood::{Layup, Pieces, lay_up};

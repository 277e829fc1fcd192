//! Label stacks: images of a specimen in, sets of voxels out, and back to TIFF.
//!
//! [`Stack`] opens TIFF in its many variants, folders of slices, `.npy` and `.mhd`;
//! [`segment`] sorts its voxels into [`Phases`], page by page; [`TiffWriter`] writes labels.
//! A stack is indexed (z = page, y = row, x = column), x fastest.

mod coder;
mod crop;
mod error;
mod folder;
mod label;
mod mhd;
mod npy;
mod phases;
mod raw;
mod sample;
mod segment;
mod source;
mod stack;
pub mod synthetic;
mod tiff;
mod voxel_size;

pub use crop::Crop;
pub use error::Error;
pub use label::Label;
pub use phases::{Grey, Labels, Phase, Phases};
pub use sample::{PageFormat, Sample};
pub use segment::{Segmented, segment};
pub use source::Source;
pub use stack::Stack;
pub use tiff::TiffWriter;
pub use voxel_size::{VoxelEdge, VoxelSize};

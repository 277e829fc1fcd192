//! Label stacks: images of a specimen in, sets of voxels out, states of a run as voxels, and back
//! to TIFF.
//!
//! [`Stack`] opens TIFF in its many variants, folders of slices, `.npy` and `.mhd`;
//! [`segment`] sorts its voxels into [`Phases`], page by page. [`LabelVolume`] is
//! the other way: what a particle file holds, liquid by its volume, as labels; [`TiffWriter`] writes them.
//! A stack is indexed (z = page, y = row, x = column), x fastest.

mod coder;
mod crop;
mod error;
mod folder;
mod label;
mod label_volume;
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
mod volume_fractions;
mod voxel_size;

pub use crop::Crop;
pub use error::Error;
pub use label::Label;
pub use label_volume::{ADHESIVE, LabelVolume, VOID, WOOD};
pub use phases::{Grey, Labels, Phase, Phases};
pub use sample::{PageFormat, Sample};
pub use segment::{Segmented, segment};
pub use source::Source;
pub use stack::Stack;
pub use tiff::TiffWriter;
pub use volume_fractions::VolumeFractions;
pub use voxel_size::{VoxelEdge, VoxelSize};

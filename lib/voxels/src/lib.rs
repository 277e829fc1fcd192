//! Label stacks: images of a specimen in, sets of voxels out, states of a run as voxels, and back
//! to TIFF.
//!
//! [`Stack`] opens TIFF in its many variants, folders of slices (BMP, PNG, JPEG too), `.npy`,
//! `.npz`, MetaImage, NRRD, NIfTI and raw volumes; [`Histogram`] counts grey values, proposes thresholds and tells the noise;
//! [`segment`] sorts its voxels into [`Phases`], page by page. [`LabelVolume`] is
//! the other way: what a particle file holds, liquid by its volume, as labels; [`TiffWriter`] writes them.
//! A stack is indexed (z = page, y = row, x = column), x fastest.

mod beside;
mod bmp;
mod coder;
mod colours;
mod crop;
mod cuts;
mod denoise;
mod despeckle;
mod error;
mod fields;
mod folder;
mod foreign;
mod histogram;
mod images;
mod kind;
mod label;
mod label_volume;
mod lattice;
mod levels;
mod mhd;
mod names;
mod nifti;
mod noise;
mod npy;
mod npz;
mod nrrd;
mod otsu;
mod phases;
mod pixels;
mod raw;
mod sample;
mod segment;
mod series;
mod source;
mod stack;
mod surface;
mod swapped;
mod tiff;
mod volume;
mod volume_fractions;
mod voxel_size;

pub use crop::Crop;
pub use despeckle::Despeckled;
pub use error::Error;
pub use folder::holds_slices;
pub use histogram::Histogram;
pub use label::Label;
pub use label_volume::{ADHESIVE, LabelVolume, VOID, WOOD};
pub use lattice::pieces;
pub use noise::Doubt;
pub use otsu::{GreyLevels, Proposal};
pub use phases::{Grey, Labels, Phase, Phases};
pub use raw::{Dims, RawType};
pub use sample::{PageFormat, Sample};
pub use segment::{Segmented, check, segment};
pub use source::Source;
pub use stack::Stack;
pub use surface::Surface;
pub use swapped::swapped_in_file;
pub use tiff::TiffWriter;
pub use volume_fractions::VolumeFractions;
pub use voxel_size::{VoxelEdge, VoxelSize, doubt_of_file};

//! The pages of a stack, whatever its format.

use std::fmt;
use std::sync::Arc;

use crate::Error;
use crate::colours::Shown;
use crate::sample::PageFormat;
use crate::source::Source;
use crate::voxel_size::VoxelSize;

/// What the reader of a format makes of its files.
#[derive(Debug)]
pub(crate) struct Volume {
    pub(crate) sources: Vec<Source>,
    pub(crate) format: PageFormat,
    pub(crate) pages: usize,
    pub(crate) voxel_size: Option<VoxelSize>,
    /// What the values of each page show, in formats that say so.
    pub(crate) shown: Vec<Arc<Shown>>,
    /// The source of each page, in formats that have pages in several.
    pub(crate) source_of: Vec<usize>,
    /// Whether compression changes values, so that labels do not survive it.
    pub(crate) lossy: bool,
    /// Copies of a page in memory while it is read.
    pub(crate) copies: usize,
    pub(crate) pixels: Box<dyn Pixels>,
}

/// Reads the pixels of pages.
pub(crate) trait Pixels: fmt::Debug + Send + Sync {
    /// Reads page `z` of its volume, from 0, into `page`, which is empty: rows from y = 0, pixels from x = 0, channels
    /// interleaved, samples in native byte order.
    fn read(&self, volume: &Volume, z: usize, page: &mut Vec<u8>) -> Result<(), Error>;
}

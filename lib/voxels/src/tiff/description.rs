//! The description of a TIFF, in each of the ways in which it is written.

use std::collections::BTreeSet;

use crate::source::Source;
use crate::voxel_size::VoxelSize;

/// What the first page says about the whole file.
#[derive(Debug, Default)]
pub(crate) struct Description {
    pub(crate) planes: Option<u64>,
    /// Whether it gives a size of a voxel, be it no length, so that resolution tags do not.
    pub(crate) states_size: bool,
    pub(crate) voxel_size: Option<VoxelSize>,
    /// Which planes stand where, if that is told; else they stand in file order.
    pub(crate) blocks: Vec<Block>,
}

/// Planes that follow one another in a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Block {
    pub(super) plane: u64,
    /// Their file in the folder of the description; none is the file that holds it.
    pub(super) file: Option<String>,
    /// The directory of the first.
    pub(super) directory: u64,
    /// How many they are; none for all that the file holds from there.
    pub(super) planes: Option<u64>,
}

impl Description {
    /// The files that the planes of `source` are in, its own in place of none; there are none where its blocks name one
    /// at most, which is the description's own, whatever it is called by now.
    pub(crate) fn files(&mut self, source: &Source) -> Vec<String> {
        let own = source.path().file_name().unwrap_or_default();
        let own = own.to_string_lossy().into_owned();
        let named = |blocks: &[Block]| -> BTreeSet<String> {
            let files = blocks.iter().filter_map(|block| block.file.clone());
            files.collect()
        };
        if named(&self.blocks).len() < 2 {
            return Vec::new();
        }
        for block in self.blocks.iter_mut() {
            block.file.get_or_insert_with(|| own.clone());
        }
        named(&self.blocks).into_iter().collect()
    }
}

/// Refuses hyperstacks: of channels, slices and frames only one may be more than 1.
pub(super) fn one_axis(counts: [u64; 3]) -> Result<(), String> {
    if counts.iter().filter(|n| **n > 1).count() > 1 {
        let [c, z, t] = counts;
        return Err(format!(
            "it declares {c} channels, {z} slices and {t} frames; one series of planes is accepted"
        ));
    }
    Ok(())
}

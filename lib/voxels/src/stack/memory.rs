//! Memory that reading a stack takes, held against what there is.

use super::{Pages, Stack};
use crate::Error;

impl Stack {
    /// Memory that the threads take at most to read pages: each page, and what it is decoded from.
    pub(crate) fn reading_bytes(&self) -> u64 {
        let copies = match &self.pages {
            Pages::Raw(_) => 1,
            Pages::Tiff(pages) if pages.are_plain() => 1,
            Pages::Tiff(_) | Pages::Images(_) => 3,
        };
        let page = self.format().volume_bytes(copies).unwrap_or(u64::MAX);
        let threads = rayon::current_num_threads().min(self.dims()[2]);
        page.saturating_mul(threads as u64)
    }

    /// Refuses a stack of which `bytes` would be made that are not to be had here.
    pub(crate) fn fits(&self, bytes: u64) -> Result<(), Error> {
        machine::shortage(bytes).map_or(Ok(()), |short| {
            let [x, y, z] = self.dims();
            let what = format!(
                "reading its {x} x {y} x {z} voxels needs {short}: keep less of it by xct2particles --crop, or take fewer --threads or a larger machine"
            );
            Err(Error::file(&self.name, what))
        })
    }
}

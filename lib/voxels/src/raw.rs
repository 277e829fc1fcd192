//! Volumes that are pages one after another.

use std::fs::File;
use std::os::unix::fs::FileExt;

use crate::Error;
use crate::sample::{PageFormat, swap_bytes};
use crate::source::Source;

/// Pages one after another in a file, x fastest.
#[derive(Debug)]
pub(crate) struct RawVolume {
    /// The file that holds the pixels comes last, after its header file if it has one.
    sources: Vec<Source>,
    /// Where the pixels are instead, once unpacked or put in order.
    unpacked: Option<Source>,
    format: PageFormat,
    pages: usize,
    page_bytes: usize,
    offset: u64,
    big_endian: bool,
}

impl RawVolume {
    /// Pixels of `pages` pages from byte `offset` of the last source.
    ///
    /// # Errors
    /// A volume without voxels, or larger or smaller than its file.
    pub(crate) fn new(
        sources: Vec<Source>,
        format: PageFormat,
        pages: usize,
        offset: u64,
        big_endian: bool,
    ) -> Result<Self, Error> {
        let name = sources.last().map_or("", Source::name);
        let len = sources.last().map_or(0, Source::len);
        let declared = format.page_bytes().filter(|n| *n > 0 && pages > 0);
        let Some(page_bytes) = declared else {
            let what = format!("{pages} pages of {format} are declared, which is no volume");
            return Err(Error::file(name, what));
        };
        let end = u64::try_from(page_bytes)
            .ok()
            .and_then(|n| n.checked_mul(pages as u64)?.checked_add(offset));
        if end.is_none_or(|end| end > len) {
            let held = len.saturating_sub(offset) / page_bytes as u64;
            let what = format!(
                "{pages} pages of {format} are declared but the file ends in page {}: it is truncated",
                held + 1
            );
            return Err(Error::file(name, what));
        }
        if let Some(more) = end.and_then(|end| len.checked_sub(end)).filter(|n| *n > 0) {
            let what = format!(
                "{more} bytes stand behind the {pages} pages of {format} that are declared: its size or its type is not the one declared"
            );
            return Err(Error::file(name, what));
        }
        Ok(Self {
            sources,
            unpacked: None,
            format,
            pages,
            page_bytes,
            offset,
            big_endian,
        })
    }

    /// As [`RawVolume::new`], of pixels that `file` holds in place of the last source.
    pub(crate) fn unpacked(
        sources: Vec<Source>,
        file: File,
        format: PageFormat,
        pages: usize,
        offset: u64,
        big_endian: bool,
    ) -> Result<Self, Error> {
        let Some(source) = sources.last() else {
            return Err(Error::Usage("no stack is given".into()));
        };
        let unpacked = source.with_content(file);
        let unpacked = unpacked.map_err(|e| Error::io(source, e))?;
        let volume = Self::new(vec![unpacked], format, pages, offset, big_endian)?;
        Ok(volume.of_sources(sources))
    }

    /// The volume whose pixels are made of `sources`, which stand for it from now on.
    pub(crate) fn of_sources(mut self, sources: Vec<Source>) -> Self {
        self.unpacked = self.unpacked.or(self.sources.pop());
        Self { sources, ..self }
    }

    pub(crate) fn format(&self) -> PageFormat {
        self.format
    }

    pub(crate) fn pages(&self) -> usize {
        self.pages
    }

    pub(crate) fn sources(&self) -> &[Source] {
        &self.sources
    }

    pub(crate) fn into_sources(self) -> Vec<Source> {
        self.sources
    }

    /// Reads page `z` in native byte order.
    pub(crate) fn read(&self, z: usize, page: &mut Vec<u8>) -> Result<(), Error> {
        let pixels = self.unpacked.as_ref().or(self.sources.last());
        let Some(source) = pixels.filter(|_| z < self.pages) else {
            return Err(Error::Usage(format!("there is no page {}", z + 1)));
        };
        page.resize(self.page_bytes, 0);
        let at = self.offset + z as u64 * self.page_bytes as u64;
        source
            .file()
            .and_then(|file| file.read_exact_at(page, at))
            .map_err(|e| Error::page(source, z, e))?;
        if self.big_endian != cfg!(target_endian = "big") {
            swap_bytes(page, self.format.sample.bytes());
        }
        Ok(())
    }
}

//! Volumes that are pages one after another, and how a file of nothing but these is to be read.

use std::os::unix::fs::FileExt;
use std::str::FromStr;

use crate::Error;
use crate::sample::{PageFormat, Sample, to_native};
use crate::source::Source;
use crate::volume::{Pixels, Volume};

/// Pages one after another in a file, x fastest.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Raw {
    pub(crate) format: PageFormat,
    pub(crate) pages: usize,
    /// Byte at which they begin.
    pub(crate) offset: u64,
    pub(crate) big_endian: bool,
}

impl Raw {
    /// Refuses a volume without voxels, or larger or smaller than its file.
    pub(crate) fn check(&self, file: &Source) -> Result<(), Error> {
        let Self { format, pages, .. } = self;
        let refused = |what: String| Err(Error::file(file, what));
        let Some(page_bytes) = format.page_bytes().filter(|n| *n > 0 && *pages > 0) else {
            return refused(format!(
                "{pages} pages of {format} are declared, which is no volume"
            ));
        };
        let end = (format.volume_bytes(*pages)).and_then(|n| n.checked_add(self.offset));
        match end.and_then(|end| file.len().checked_sub(end)) {
            Some(0) => Ok(()),
            Some(more) => refused(format!(
                "{more} bytes stand behind the {pages} pages of {format} that are declared: its size or its type is not the one declared"
            )),
            None => refused(format!(
                "{pages} pages of {format} are declared but the file ends in page {}: it is truncated",
                file.len().saturating_sub(self.offset) / page_bytes as u64 + 1
            )),
        }
    }

    /// The pages in the last of `sources`, or in `unpacked` in its place.
    pub(crate) fn volume(
        self,
        sources: Vec<Source>,
        unpacked: Option<Source>,
    ) -> Result<Volume, Error> {
        let unpacked = unpacked.map_or(Ok(None), |file| self.check(&file).map(|()| Some(file)))?;
        if let (None, Some(file)) = (&unpacked, sources.last()) {
            self.check(file)?;
        }
        Ok(Volume {
            sources,
            format: self.format,
            pages: self.pages,
            voxel_size: None,
            shown: Vec::new(),
            source_of: Vec::new(),
            lossy: false,
            copies: 1,
            pixels: Box::new((self, unpacked)),
        })
    }
}

/// Where there is a source, the pixels are in it instead of the last of the volume.
impl Pixels for (Raw, Option<Source>) {
    fn read(&self, volume: &Volume, z: usize, page: &mut Vec<u8>) -> Result<(), Error> {
        let (raw, unpacked) = self;
        let Some(source) = unpacked.as_ref().or(volume.sources.last()) else {
            return Ok(());
        };
        page.resize(raw.format.page_bytes().unwrap_or(0), 0);
        let at = raw.offset + z as u64 * page.len() as u64;
        (source.file())
            .and_then(|file| file.read_exact_at(page, at))
            .map_err(|e| Error::page(source, z, e))?;
        to_native(page, raw.format.sample, raw.big_endian);
        Ok(())
    }
}

/// Numbers of voxels along x (columns), y (rows), z (pages): `400x394x400`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dims(pub [usize; 3]);

impl FromStr for Dims {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let number = |n: &str| n.trim().parse().ok().filter(|n: &usize| *n > 0);
        let dims: Option<Vec<usize>> = text.split('x').map(number).collect();
        let dims = dims.and_then(|dims| dims.try_into().ok()).map(Self);
        dims.ok_or_else(|| {
            format!("'{text}' is no size; accepted is XxYxZ in voxels, as in 400x394x400")
        })
    }
}

/// Number type of a raw file and its byte order: `u8`, `u16`, `u16be`, `f32` ...
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RawType {
    pub(crate) sample: Sample,
    pub(crate) big_endian: bool,
}

impl FromStr for RawType {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let (name, big_endian) = match text.strip_suffix("be") {
            Some(name) => (name, true),
            None => (text.strip_suffix("le").unwrap_or(text), false),
        };
        let sample = Sample::named(name).ok_or_else(|| {
            format!(
                "'{text}' is no number type; accepted are u8, i8, u16, i16, u32, i32, u64, i64, f32 and f64, little-endian, or with be behind it"
            )
        })?;
        Ok(Self { sample, big_endian })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_and_types_as_people_write_them() {
        assert_eq!("3x4x50".parse(), Ok(Dims([3, 4, 50])));
        for bad in ["3x4", "3x4x0", "3x4x5x6", "", "axbxc", "-1x2x3"] {
            assert!(bad.parse::<Dims>().is_err(), "{bad}");
        }
        let kind: RawType = "u16be".parse().unwrap();
        assert!(kind.sample == Sample::U16 && kind.big_endian);
        assert_eq!("f32".parse::<RawType>(), "f32le".parse());
        assert!("u12".parse::<RawType>().is_err());
    }
}

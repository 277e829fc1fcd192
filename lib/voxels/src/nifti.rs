//! NIfTI-1 and -2 in one file, plain or gzipped (`.nii`, `.nii.gz`)
//! (<https://nifti.nimh.nih.gov/nifti-1>, <https://nifti.nimh.nih.gov/nifti-2>). Stored values are
//! labels: slope and intercept are not applied.

use std::io::Read;

use crate::Error;
use crate::error::damaged;
use crate::kind::{NIFTI_HEADERS, is_gzip, nifti_version};
use crate::pixels::{self, Coding, Described};
use crate::raw::Raw;
use crate::sample::{PageFormat, Sample};
use crate::source::Source;
use crate::volume::Volume;
use crate::voxel_size::VoxelSize;

pub(crate) fn open(source: Source) -> Result<Volume, Error> {
    let begin = source.window(0, 2).map_err(|e| Error::io(&source, e))?;
    let coding = match is_gzip(&begin) {
        true => Coding::Gzip,
        false => Coding::Raw,
    };
    let mut head = Vec::new();
    (pixels::reader(&source, 0, coding))
        .and_then(|content| content.take(NIFTI_HEADERS[1] as u64).read_to_end(&mut head))
        .map_err(|e| Error::file(&source, damaged(e)))?;
    let wrong = |what: &str| Error::file(&source, what);
    let Some((version, big_endian)) = nifti_version(&head) else {
        return Err(wrong(
            "it is gzipped but no NIfTI image inside; accepted are .nii.gz files: unpack others with gunzip",
        ));
    };
    if head.len() < NIFTI_HEADERS[version] {
        return Err(wrong("its header is truncated"));
    }
    let fields = Fields {
        head: &head,
        second: version == 1,
        big_endian,
    };
    let described = fields.described(coding).map_err(|what| wrong(&what))?;
    described.open(source)
}

/// The fields of a header by where they stand.
struct Fields<'a> {
    head: &'a [u8],
    second: bool,
    big_endian: bool,
}

impl Fields<'_> {
    fn number<const N: usize>(&self, at: usize) -> [u8; N] {
        let mut bytes = [0; N];
        bytes.copy_from_slice(&self.head[at..at + N]);
        if self.big_endian {
            bytes.reverse();
        }
        bytes
    }

    /// Number `i` of `dim`, which is how many axes there are, then the voxels along them.
    fn dim(&self, i: usize) -> i64 {
        match self.second {
            true => i64::from_le_bytes(self.number(16 + 8 * i)),
            false => i16::from_le_bytes(self.number(40 + 2 * i)).into(),
        }
    }

    fn pixdim(&self, i: usize) -> f64 {
        match self.second {
            true => f64::from_le_bytes(self.number(104 + 8 * i)),
            false => f32::from_le_bytes(self.number(76 + 4 * i)).into(),
        }
    }

    fn described(&self, coding: Coding) -> Result<Described, String> {
        let magic = if self.second { 4 } else { 344 };
        if self.head[magic + 1] == b'i' {
            return Err("its pixels stand in an .img file beside it; accepted is NIfTI in one file: save it as .nii or .nii.gz".into());
        }
        let axes = self.dim(0);
        let single = |i: i64| self.dim(i as usize) == 1;
        let volume = (3..=7).contains(&axes) && (4..=axes).all(single);
        let [x, y, z] = [1, 2, 3].map(|i| usize::try_from(self.dim(i)).ok().filter(|n| *n > 0));
        let (true, Some(width), Some(height), Some(pages)) = (volume, x, y, z) else {
            return Err("it is no volume of three axes".into());
        };
        let kind = i16::from_le_bytes(self.number(if self.second { 12 } else { 70 }));
        const RGB24: i16 = 128;
        let channels = if kind == RGB24 { 3 } else { 1 };
        let sample = match kind {
            RGB24 => Some(Sample::U8),
            kind => Sample::of_nifti(kind),
        };
        let sample = sample.ok_or_else(|| {
            format!("its data type is {kind}; accepted are integers of 8 to 64 bits, floats of 32 and 64 bits and RGB24")
        })?;
        let offset = match self.second {
            true => i64::from_le_bytes(self.number(168)),
            // Truncated, as a float that is a number of bytes allows; not a number becomes 0.
            false => f32::from_le_bytes(self.number(108)) as i64,
        };
        let offset = u64::try_from(offset).ok().filter(|n| *n >= 348);
        Ok(Described {
            raw: Raw {
                format: PageFormat::new([width, height], sample, channels),
                pages,
                offset: 0,
                big_endian: self.big_endian,
            },
            at_end: false,
            coding,
            // Deflate cannot seek, so the header is unpacked with the pixels.
            skip: offset.ok_or("its pixels begin inside its header")?,
            files: Vec::new(),
            voxel_size: self.voxel_size(),
        })
    }

    fn voxel_size(&self) -> Option<VoxelSize> {
        let units = match self.second {
            true => i32::from_le_bytes(self.number(500)) as u8,
            false => self.head[123],
        };
        let unit = ["", "m", "mm", "um"].get(usize::from(units & 7))?;
        let edges = [1, 2, 3].map(|i| self.pixdim(i).abs());
        VoxelSize::in_units(edges, [unit; 3], "NIfTI pixdim")
    }
}

//! NIfTI-1 and -2 in one file, plain or gzipped (`.nii`, `.nii.gz`)
//! (<https://nifti.nimh.nih.gov/nifti-1>, <https://nifti.nimh.nih.gov/nifti-2>). Stored values are
//! labels: slope and intercept are not applied.

use std::io::Read;

use crate::Error;
use crate::pixels::{self, Coding, Pixels, Start};
use crate::raw::RawVolume;
use crate::sample::{PageFormat, Sample};
use crate::source::Source;
use crate::voxel_size::VoxelSize;

/// Length of a header of version 1 and 2, which is also its first field.
const HEADERS: [usize; 2] = [348, 540];

/// Whether a file that begins so is NIfTI; a gzipped one is told by [`pixels::is_gzip`], for
/// nothing else is read gzipped.
pub(crate) fn is_nifti(head: &[u8]) -> bool {
    Fields::new(head).is_some()
}

pub(crate) fn open(source: Source) -> Result<(RawVolume, Option<VoxelSize>), Error> {
    let length = HEADERS[1];
    let plain = source
        .window(0, length)
        .map_err(|e| Error::io(&source, e))?;
    let packed = pixels::is_gzip(&plain);
    let head = if packed {
        let mut head = Vec::new();
        pixels::reader(&source, 0, Coding::Gzip)?
            .take(length as u64)
            .read_to_end(&mut head)
            .map_err(|e| Error::io(&source, e))?;
        head
    } else {
        plain
    };
    let wrong = |what: &str| Error::file(&source, what);
    let fields = Fields::new(&head).ok_or_else(|| {
        wrong("it is gzipped but no NIfTI image inside; accepted are .nii.gz files: unpack others with gunzip")
    })?;
    if head.len() < HEADERS[usize::from(fields.second)] {
        return Err(wrong("its header is truncated"));
    }
    let (mut pixels, voxel_size) = fields.header().map_err(|what| wrong(&what))?;
    if packed {
        pixels.coding = Coding::Gzip;
    }
    Ok((pixels.open(source, Vec::new())?, voxel_size))
}

/// The fields of a header by where they stand.
struct Fields<'a> {
    head: &'a [u8],
    second: bool,
    big_endian: bool,
}

impl<'a> Fields<'a> {
    fn new(head: &'a [u8]) -> Option<Self> {
        let length: [u8; 4] = head.get(..4)?.try_into().ok()?;
        let found = |length: u32| HEADERS.iter().position(|&n| n == length as usize);
        let (version, big_endian) = match found(u32::from_le_bytes(length)) {
            Some(version) => (version, false),
            None => (found(u32::from_be_bytes(length))?, true),
        };
        let magic = if version == 0 { 344..348 } else { 4..8 };
        let known: [&[u8]; 4] = [b"n+1\0", b"ni1\0", b"n+2\0", b"ni2\0"];
        let known = head.len() >= HEADERS[0] && known.contains(&&head[magic]);
        known.then_some(Self {
            head,
            second: version == 1,
            big_endian,
        })
    }

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

    fn header(&self) -> Result<(Pixels, Option<VoxelSize>), String> {
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
        let (sample, channels) = sample_of(kind)?;
        let offset = match self.second {
            true => i64::from_le_bytes(self.number(168)),
            // Truncated, as a float that is a number of bytes allows; not a number becomes 0.
            false => f32::from_le_bytes(self.number(108)) as i64,
        };
        let offset = u64::try_from(offset).ok().filter(|n| *n >= 348);
        let pixels = Pixels {
            format: PageFormat {
                width,
                height,
                sample,
                channels,
            },
            pages,
            big_endian: self.big_endian,
            coding: Coding::Raw,
            start: Start::At(0),
            // Deflate cannot seek, so the header is unpacked with the pixels.
            skip: offset.ok_or("its pixels begin inside its header")?,
        };
        Ok((pixels, self.voxel_size()))
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

fn sample_of(kind: i16) -> Result<(Sample, usize), String> {
    Ok(match kind {
        2 => (Sample::U8, 1),
        256 => (Sample::I8, 1),
        512 => (Sample::U16, 1),
        4 => (Sample::I16, 1),
        768 => (Sample::U32, 1),
        8 => (Sample::I32, 1),
        1280 => (Sample::U64, 1),
        1024 => (Sample::I64, 1),
        16 => (Sample::F32, 1),
        64 => (Sample::F64, 1),
        128 => (Sample::U8, 3),
        _ => {
            return Err(format!(
                "its data type is {kind}; accepted are integers of 8 to 64 bits, floats of 32 and 64 bits and RGB24"
            ));
        }
    })
}

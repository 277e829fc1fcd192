//! Label stacks as TIFF.

use std::io::{self, ErrorKind, Write};

use ::tiff::tags::Tag;

use crate::voxel_size::micrometres;

const ASCII: u16 = 2;
const SHORT: u16 = 3;
const LONG: u16 = 4;
const RATIONAL: u16 = 5;
const LONG8: u16 = 16;
const ENTRIES: u64 = 14;

/// Writes 8-bit labels as a multi-page TIFF, page by page, to a stream.
///
/// All directories come first, then all pages in one piece: ImageJ reads only the first
/// directory of its stacks and takes the planes from what follows, other programs read the
/// chain. The description carries the voxel size in ImageJ's way. Files of 4 GiB and more
/// are BigTIFF.
pub struct TiffWriter<W> {
    out: W,
    page_bytes: u64,
    pages_left: u64,
}

impl<W: Write> TiffWriter<W> {
    /// Writes the header of a stack of `[nx, ny, nz]` voxels of edge `voxel_edge` (m), with a `note` in the image
    /// description if it is not empty, e.g. `note=synthetic`.
    ///
    /// # Errors
    /// Dimensions that TIFF cannot hold, or the failed write.
    pub fn new(out: W, dims: [usize; 3], voxel_edge: f64, note: &str) -> io::Result<Self> {
        let layout = Layout::new(dims, voxel_edge, note, false)
            .filter(|layout| layout.end <= u64::from(u32::MAX))
            .or_else(|| Layout::new(dims, voxel_edge, note, true));
        let [nx, ny, nz] = dims;
        let layout = layout.ok_or_else(|| {
            wrong(format!(
                "a stack of {nx} x {ny} x {nz} voxels does not fit a TIFF file"
            ))
        })?;
        Self::with_layout(out, &layout)
    }

    fn with_layout(mut out: W, layout: &Layout) -> io::Result<Self> {
        out.write_all(&layout.header())?;
        for z in 0..layout.pages {
            out.write_all(&layout.directory(z))?;
        }
        out.write_all(&layout.values)?;
        Ok(Self {
            out,
            page_bytes: layout.page_bytes,
            pages_left: layout.pages,
        })
    }

    /// Writes the labels of the next page, x fastest.
    ///
    /// # Errors
    /// A page of another size, one page too many, or the failed write.
    pub fn write_page(&mut self, labels: &[u8]) -> io::Result<()> {
        if labels.len() as u64 != self.page_bytes || self.pages_left == 0 {
            let what = "the page does not belong to the stack that was announced";
            return Err(wrong(what.into()));
        }
        self.pages_left -= 1;
        self.out.write_all(labels)
    }

    /// Ends the file.
    ///
    /// # Errors
    /// Pages that are still missing, or the failed write.
    pub fn finish(mut self) -> io::Result<()> {
        match self.pages_left {
            0 => self.out.flush(),
            n => Err(wrong(format!("{n} pages were not written"))),
        }
    }
}

fn wrong(what: String) -> io::Error {
    io::Error::new(ErrorKind::InvalidInput, what)
}

/// Where everything stands in the file.
struct Layout {
    width: u32,
    height: u32,
    page_bytes: u64,
    pages: u64,
    big: bool,
    /// Pixels per micrometre as a fraction, then the description: what all directories point to.
    values: Vec<u8>,
    description: u64,
    /// Byte at which the values begin, behind the directories.
    values_at: u64,
    /// Bytes of the whole file; it ends with the pixels.
    end: u64,
}

impl Layout {
    fn new(dims: [usize; 3], voxel_edge: f64, note: &str, big: bool) -> Option<Self> {
        let side = |n: usize| u32::try_from(n).ok().filter(|n| *n > 0);
        let (width, height, pages) = (side(dims[0])?, side(dims[1])?, u64::from(side(dims[2])?));
        let page_bytes = u64::from(width) * u64::from(height);
        let edge_um = micrometres(voxel_edge);
        let line_end = if note.is_empty() { "" } else { "\n" };
        let description = format!(
            "ImageJ=1.11a\nimages={pages}\nslices={pages}\nunit=um\nspacing={edge_um}\nloop=false\n{note}{line_end}\0"
        );
        let mut values = pixels_per_micrometre(edge_um)
            .map(u32::to_le_bytes)
            .concat();
        values.extend(description.as_bytes());
        values.resize(values.len().next_multiple_of(8), 0);
        let values_at = directory_at(big, pages);
        let pixels = page_bytes.checked_mul(pages)?;
        Some(Self {
            width,
            height,
            page_bytes,
            pages,
            big,
            description: description.len() as u64,
            values_at,
            end: pixels.checked_add(values_at + values.len() as u64)?,
            values,
        })
    }

    fn header(&self) -> Vec<u8> {
        let version: &[u8] = match self.big {
            true => b"II\x2b\0\x08\0\0\0",
            false => b"II\x2a\0",
        };
        [
            version,
            self.offset(&directory_at(self.big, 0).to_le_bytes()),
        ]
        .concat()
    }

    /// The bytes of an offset or count that its flavour has; a classic file ends below 4 GiB.
    fn offset<'a>(&self, bytes: &'a [u8; 8]) -> &'a [u8] {
        &bytes[..if self.big { 8 } else { 4 }]
    }

    fn directory(&self, z: u64) -> Vec<u8> {
        let offset = if self.big { LONG8 } else { LONG };
        let strip = self.end - (self.pages - z) * self.page_bytes;
        // A rational fits the value field of a BigTIFF entry only.
        let fraction = self
            .values
            .first_chunk()
            .map_or(0, |n| u64::from_le_bytes(*n));
        let resolution = if self.big { fraction } else { self.values_at };
        let tags: [(Tag, u16, u64, u64); ENTRIES as usize] = [
            (Tag::NewSubfileType, LONG, 1, 0),
            (Tag::ImageWidth, LONG, 1, self.width.into()),
            (Tag::ImageLength, LONG, 1, self.height.into()),
            (Tag::BitsPerSample, SHORT, 1, 8),
            (Tag::Compression, SHORT, 1, 1),
            (Tag::PhotometricInterpretation, SHORT, 1, 1),
            (
                Tag::ImageDescription,
                ASCII,
                self.description,
                self.values_at + 8,
            ),
            (Tag::StripOffsets, offset, 1, strip),
            (Tag::SamplesPerPixel, SHORT, 1, 1),
            (Tag::RowsPerStrip, LONG, 1, self.height.into()),
            (Tag::StripByteCounts, offset, 1, self.page_bytes),
            (Tag::XResolution, RATIONAL, 1, resolution),
            (Tag::YResolution, RATIONAL, 1, resolution),
            (Tag::ResolutionUnit, SHORT, 1, 1), // the unit stands in the description
        ];
        let count_width = if self.big { 8 } else { 2 };
        let mut bytes = ENTRIES.to_le_bytes()[..count_width].to_vec();
        for (tag, kind, count, value) in tags {
            bytes.extend([tag.to_u16(), kind].map(u16::to_le_bytes).concat());
            bytes.extend(self.offset(&count.to_le_bytes()));
            bytes.extend(self.offset(&value.to_le_bytes()));
        }
        let next = if z + 1 == self.pages {
            0
        } else {
            directory_at(self.big, z + 1)
        };
        bytes.extend(self.offset(&next.to_le_bytes()));
        bytes
    }
}

fn directory_at(big: bool, z: u64) -> u64 {
    match big {
        true => 16 + z * (8 + 20 * ENTRIES + 8),
        false => 8 + z * (2 + 12 * ENTRIES + 4),
    }
}

/// 1/edge as a fraction of 32-bit integers, exact to a picometre up to 4 mm.
fn pixels_per_micrometre(edge_um: f64) -> [u32; 2] {
    let picometres = (edge_um * 1e6).round();
    match picometres <= f64::from(u32::MAX) {
        true => [1_000_000, picometres as u32],
        false => [1, edge_um.round() as u32],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Stack;

    /// Our reader takes pages as ImageJ does, others go from directory to directory.
    #[test]
    fn what_is_written_is_read() {
        for big in [false, true] {
            let layout = Layout::new([5, 4, 3], 1.45e-6, "", big).unwrap();
            let mut bytes = Vec::new();
            let mut writer = TiffWriter::with_layout(&mut bytes, &layout).unwrap();
            for z in 0..3_u8 {
                let page: Vec<u8> = (20 * z..20 * z + 20).collect();
                writer.write_page(&page).unwrap();
            }
            assert!(writer.write_page(&[0; 20]).is_err());
            writer.finish().unwrap();
            assert_eq!(bytes.len() as u64, layout.end);
            let mut decoder = tiff::decoder::Decoder::new(io::Cursor::new(&bytes)).unwrap();
            for z in 0..3_u8 {
                assert_eq!(decoder.dimensions().unwrap(), (5, 4));
                let mut page = [0; 20];
                decoder.read_image_bytes(&mut page).unwrap();
                assert_eq!((page[0], decoder.more_images()), (20 * z, z < 2));
                if z < 2 {
                    decoder.next_image().unwrap();
                }
            }
            let folder = tempfile::tempdir().unwrap();
            let path = folder.path().join("a.tif");
            std::fs::write(&path, bytes).unwrap();
            let stack = Stack::open(&[path]).unwrap();
            assert_eq!(stack.dims(), [5, 4, 3]);
            let edge = stack.voxel_size().unwrap().cube_edge().unwrap();
            assert!((edge - 1.45e-6).abs() < 1e-18, "{edge}");
            let mut page = Vec::new();
            stack.read_page(2, &mut page).unwrap();
            assert_eq!(page, (40..60).collect::<Vec<u8>>());
        }
    }

    #[test]
    fn missing_pages_are_noticed() {
        let writer = TiffWriter::new(Vec::new(), [2, 2, 2], 1e-6, "").unwrap();
        assert!(writer.finish().is_err());
        assert!(TiffWriter::new(Vec::new(), [0, 2, 2], 1e-6, "").is_err());
    }
}

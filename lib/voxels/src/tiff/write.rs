//! Label stacks as TIFF.

use std::io::{self, Write};

use super::ifd::tag;
use crate::voxel_size::micrometres;

const BYTE_ORDER: &[u8] = b"II";
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
    /// Writes the header of a stack of `[nx, ny, nz]` voxels of edge `voxel_edge` (m).
    ///
    /// # Errors
    /// Dimensions that TIFF cannot hold, or the failed write.
    pub fn new(out: W, dims: [usize; 3], voxel_edge: f64) -> io::Result<Self> {
        Self::with_note(out, dims, voxel_edge, "")
    }

    /// As [`TiffWriter::new`], with a line for the image description, e.g. `note=synthetic`.
    ///
    /// # Errors
    /// As [`TiffWriter::new`].
    pub fn with_note(out: W, dims: [usize; 3], voxel_edge: f64, note: &str) -> io::Result<Self> {
        let layout = Layout::new(dims, voxel_edge, note, false)
            .filter(|layout| layout.end <= u64::from(u32::MAX))
            .or_else(|| Layout::new(dims, voxel_edge, note, true));
        let layout = layout.ok_or_else(|| {
            let [nx, ny, nz] = dims;
            let what = format!("a stack of {nx} x {ny} x {nz} voxels does not fit a TIFF file");
            io::Error::new(io::ErrorKind::InvalidInput, what)
        })?;
        Self::with_layout(out, &layout)
    }

    fn with_layout(mut out: W, layout: &Layout) -> io::Result<Self> {
        out.write_all(&layout.header())?;
        for z in 0..layout.pages {
            out.write_all(&layout.directory(z))?;
        }
        out.write_all(&layout.values())?;
        Ok(Self {
            out,
            page_bytes: layout.page_bytes(),
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
            return Err(io::Error::new(io::ErrorKind::InvalidInput, what));
        }
        self.pages_left -= 1;
        self.out.write_all(labels)
    }

    /// Ends the file.
    ///
    /// # Errors
    /// Pages that are still missing, or the failed write.
    pub fn finish(mut self) -> io::Result<()> {
        if self.pages_left > 0 {
            let what = format!("{} pages were not written", self.pages_left);
            return Err(io::Error::new(io::ErrorKind::InvalidInput, what));
        }
        self.out.flush()
    }
}

/// Where everything stands in the file.
struct Layout {
    width: u32,
    height: u32,
    pages: u64,
    big: bool,
    description: Vec<u8>,
    /// Pixels per micrometre as a fraction.
    resolution: [u32; 2],
    /// Byte at which the values behind the directories begin: resolution, description.
    values_at: u64,
    /// Byte at which the pixels begin.
    data_at: u64,
    /// Bytes of the whole file.
    end: u64,
}

impl Layout {
    fn new(dims: [usize; 3], voxel_edge: f64, note: &str, big: bool) -> Option<Self> {
        let side = |n: usize| u32::try_from(n).ok().filter(|n| *n > 0);
        let (width, height, pages) = (side(dims[0])?, side(dims[1])?, u64::from(side(dims[2])?));
        let edge_um = micrometres(voxel_edge);
        let end = if note.is_empty() { "" } else { "\n" };
        let description = format!(
            "ImageJ=1.11a\nimages={pages}\nslices={pages}\nunit=um\nspacing={edge_um}\nloop=false\n{note}{end}\0"
        );
        let mut layout = Self {
            width,
            height,
            pages,
            big,
            description: description.into_bytes(),
            resolution: pixels_per_micrometre(edge_um),
            values_at: 0,
            data_at: 0,
            end: 0,
        };
        layout.values_at = layout.directory_at(pages);
        layout.data_at = layout.values_at + layout.values().len() as u64;
        layout.end = layout
            .page_bytes()
            .checked_mul(pages)?
            .checked_add(layout.data_at)?;
        Some(layout)
    }

    fn page_bytes(&self) -> u64 {
        u64::from(self.width) * u64::from(self.height)
    }

    fn directory_at(&self, z: u64) -> u64 {
        let (header, directory) = if self.big {
            (16, 8 + 20 * ENTRIES + 8)
        } else {
            (8, 2 + 12 * ENTRIES + 4)
        };
        header + z * directory
    }

    fn header(&self) -> Vec<u8> {
        let mut bytes = BYTE_ORDER.to_vec();
        if self.big {
            bytes.extend([43, 0, 8, 0, 0, 0]);
        } else {
            bytes.extend([42, 0]);
        }
        self.put_offset(&mut bytes, self.directory_at(0));
        bytes
    }

    /// An offset in the width of the flavour; a classic file ends below 4 GiB.
    fn put_offset(&self, bytes: &mut Vec<u8>, value: u64) {
        let width = if self.big { 8 } else { 4 };
        bytes.extend(&value.to_le_bytes()[..width]);
    }

    fn directory(&self, z: u64) -> Vec<u8> {
        let offset = if self.big { LONG8 } else { LONG };
        let strip = self.data_at + z * self.page_bytes();
        // A rational fits the value field of a BigTIFF entry only.
        let fraction = u64::from(self.resolution[0]) | u64::from(self.resolution[1]) << 32;
        let resolution = if self.big { fraction } else { self.values_at };
        let length = self.description.len() as u64;
        let tags: [(u16, u16, u64, u64); ENTRIES as usize] = [
            (tag::NEW_SUBFILE_TYPE, LONG, 1, 0),
            (tag::IMAGE_WIDTH, LONG, 1, self.width.into()),
            (tag::IMAGE_LENGTH, LONG, 1, self.height.into()),
            (tag::BITS_PER_SAMPLE, SHORT, 1, 8),
            (tag::COMPRESSION, SHORT, 1, 1),
            (tag::PHOTOMETRIC, SHORT, 1, 1),
            (tag::IMAGE_DESCRIPTION, ASCII, length, self.values_at + 8),
            (tag::STRIP_OFFSETS, offset, 1, strip),
            (tag::SAMPLES_PER_PIXEL, SHORT, 1, 1),
            (tag::ROWS_PER_STRIP, LONG, 1, self.height.into()),
            (tag::STRIP_BYTE_COUNTS, offset, 1, self.page_bytes()),
            (tag::X_RESOLUTION, RATIONAL, 1, resolution),
            (tag::Y_RESOLUTION, RATIONAL, 1, resolution),
            (tag::RESOLUTION_UNIT, SHORT, 1, 1), // the unit stands in the description
        ];
        let mut bytes = Vec::new();
        let count_width = if self.big { 8 } else { 2 };
        bytes.extend(&ENTRIES.to_le_bytes()[..count_width]);
        for (tag, kind, count, value) in tags {
            bytes.extend(tag.to_le_bytes());
            bytes.extend(kind.to_le_bytes());
            self.put_offset(&mut bytes, count);
            self.put_offset(&mut bytes, value);
        }
        let last = z + 1 == self.pages;
        self.put_offset(&mut bytes, if last { 0 } else { self.directory_at(z + 1) });
        bytes
    }

    /// Resolution and description, which all directories point to.
    fn values(&self) -> Vec<u8> {
        let mut bytes: Vec<u8> = self.resolution.map(u32::to_le_bytes).concat();
        bytes.extend(&self.description);
        bytes.resize(bytes.len().next_multiple_of(8), 0);
        bytes
    }
}

/// 1/edge as a fraction of 32-bit integers, exact to a picometre up to 4 mm.
fn pixels_per_micrometre(edge_um: f64) -> [u32; 2] {
    let picometres = (edge_um * 1e6).round();
    if picometres <= f64::from(u32::MAX) {
        [1_000_000, picometres as u32]
    } else {
        [1, edge_um.round() as u32]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Stack;

    fn read_back(big: bool) -> (Stack, tempfile::TempDir) {
        let dims = [5, 4, 3];
        let layout = Layout::new(dims, 1.45e-6, "", big).unwrap();
        let mut bytes = Vec::new();
        let mut writer = TiffWriter::with_layout(&mut bytes, &layout).unwrap();
        for z in 0..3_u8 {
            let page: Vec<u8> = (0..20).map(|i| i + 20 * z).collect();
            writer.write_page(&page).unwrap();
        }
        assert!(writer.write_page(&[0; 20]).is_err());
        writer.finish().unwrap();
        assert_eq!(bytes.len() as u64, layout.end);
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.tif");
        std::fs::write(&path, bytes).unwrap();
        (Stack::open(&[path]).unwrap(), folder)
    }

    #[test]
    fn what_is_written_is_read() {
        for big in [false, true] {
            let (stack, _folder) = read_back(big);
            assert_eq!(stack.dims(), [5, 4, 3]);
            let edge = stack.voxel_size().unwrap().cube_edge().unwrap();
            assert!((edge - 1.45e-6).abs() < 1e-18, "{edge}");
            let mut page = Vec::new();
            stack.read_page(2, &mut page).unwrap();
            assert_eq!(page, (40..60).collect::<Vec<u8>>());
        }
    }

    /// Readers other than ours go from directory to directory.
    #[test]
    fn every_directory_but_the_last_names_the_next() {
        for big in [false, true] {
            let (_, folder) = read_back(big);
            let file = std::fs::File::open(folder.path().join("a.tif")).unwrap();
            let mut decoder = tiff::decoder::Decoder::new(std::io::BufReader::new(file)).unwrap();
            for z in 0..3_u8 {
                assert_eq!(decoder.dimensions().unwrap(), (5, 4));
                let first = match decoder.read_image().unwrap() {
                    tiff::decoder::DecodingResult::U8(page) => page[0],
                    other => panic!("{other:?}"),
                };
                assert_eq!((first, decoder.more_images()), (20 * z, z < 2));
                if z < 2 {
                    decoder.next_image().unwrap();
                }
            }
        }
    }

    #[test]
    fn missing_pages_are_noticed() {
        let writer = TiffWriter::new(Vec::new(), [2, 2, 2], 1e-6).unwrap();
        assert!(writer.finish().is_err());
        assert!(TiffWriter::new(Vec::new(), [0, 2, 2], 1e-6).is_err());
    }
}

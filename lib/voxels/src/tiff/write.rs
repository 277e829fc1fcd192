//! Label stacks as TIFF.

use std::io::{self, ErrorKind, Write};

use ::tiff::tags::Tag;

use crate::voxel_size::micrometres;

const ASCII: u16 = 2;
const SHORT: u16 = 3;
const LONG: u16 = 4;
const RATIONAL: u16 = 5;
const LONG8: u16 = 16;

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
    pub fn new(mut out: W, dims: [usize; 3], voxel_edge: f64, note: &str) -> io::Result<Self> {
        let [nx, ny, nz] = dims;
        let head = head(dims, voxel_edge, note, false)
            .or_else(|| head(dims, voxel_edge, note, true))
            .ok_or_else(|| {
                wrong(format!(
                    "a stack of {nx} x {ny} x {nz} voxels does not fit a TIFF file"
                ))
            })?;
        out.write_all(&head)?;
        Ok(Self {
            out,
            page_bytes: nx as u64 * ny as u64,
            pages_left: nz as u64,
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

/// All that stands before the pixels: the header, a directory for each page and the values that all of them
/// point to. None where the sizes or, unless it is `big`, the places in the file are no numbers of 32 bits.
fn head(dims: [usize; 3], voxel_edge: f64, note: &str, big: bool) -> Option<Vec<u8>> {
    const ENTRIES: u64 = 14;
    let side = |n: usize| u32::try_from(n).ok().filter(|n| *n > 0).map(u64::from);
    let [width, height, pages] = [side(dims[0])?, side(dims[1])?, side(dims[2])?];
    // Bytes of counts and offsets; where the first directory is, and how long each.
    let (wide, begin, directory) = match big {
        true => (8, 16, 8 + 20 * ENTRIES + 8),
        false => (4, 8, 2 + 12 * ENTRIES + 4),
    };
    let edge_um = micrometres(voxel_edge);
    let line_end = if note.is_empty() { "" } else { "\n" };
    let description = format!(
        "ImageJ=1.11a\nimages={pages}\nslices={pages}\nunit=um\nspacing={edge_um}\nloop=false\n{note}{line_end}\0"
    );
    let fraction = pixels_per_micrometre(edge_um).map(u32::to_le_bytes);
    let mut values = [fraction.as_flattened(), description.as_bytes()].concat();
    values.resize(values.len().next_multiple_of(8), 0);
    let values_at = begin + pages * directory;
    let pixels_at = values_at + values.len() as u64;
    let page_bytes = width * height;
    let end = page_bytes.checked_mul(pages)?.checked_add(pixels_at)?;
    if !big && end > u64::from(u32::MAX) {
        return None;
    }
    let offset = if big { LONG8 } else { LONG };
    // A rational fits the value field of a BigTIFF entry only.
    let resolution = if big {
        u64::from_le_bytes(*values.first_chunk()?)
    } else {
        values_at
    };
    let mut bytes = if big {
        &b"II\x2b\0\x08\0\0\0"[..]
    } else {
        b"II\x2a\0"
    }
    .to_vec();
    bytes.extend(&u64::to_le_bytes(begin)[..wide]);
    for z in 0..pages {
        let tags: [(Tag, u16, u64, u64); ENTRIES as usize] = [
            (Tag::NewSubfileType, LONG, 1, 0),
            (Tag::ImageWidth, LONG, 1, width),
            (Tag::ImageLength, LONG, 1, height),
            (Tag::BitsPerSample, SHORT, 1, 8),
            (Tag::Compression, SHORT, 1, 1),
            (Tag::PhotometricInterpretation, SHORT, 1, 1),
            (
                Tag::ImageDescription,
                ASCII,
                description.len() as u64,
                values_at + 8,
            ),
            (Tag::StripOffsets, offset, 1, pixels_at + z * page_bytes),
            (Tag::SamplesPerPixel, SHORT, 1, 1),
            (Tag::RowsPerStrip, LONG, 1, height),
            (Tag::StripByteCounts, offset, 1, page_bytes),
            (Tag::XResolution, RATIONAL, 1, resolution),
            (Tag::YResolution, RATIONAL, 1, resolution),
            (Tag::ResolutionUnit, SHORT, 1, 1), // the unit stands in the description
        ];
        bytes.extend(&ENTRIES.to_le_bytes()[..if big { 8 } else { 2 }]);
        for (tag, kind, count, value) in tags {
            bytes.extend([tag.to_u16(), kind].map(u16::to_le_bytes).as_flattened());
            for n in [count, value] {
                bytes.extend(&n.to_le_bytes()[..wide]);
            }
        }
        let next = if z + 1 == pages {
            0
        } else {
            begin + (z + 1) * directory
        };
        bytes.extend(&next.to_le_bytes()[..wide]);
    }
    Some([bytes, values].concat())
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
            let pages: Vec<u8> = (0..60).collect();
            let mut bytes = Vec::new();
            let mut writer = TiffWriter::new(&mut bytes, [5, 4, 3], 1.45e-6, "").unwrap();
            (pages.chunks(20)).for_each(|page| writer.write_page(page).unwrap());
            assert!(writer.write_page(&[0; 20]).is_err());
            writer.finish().unwrap();
            if big {
                let head = head([5, 4, 3], 1.45e-6, "", true).unwrap();
                bytes = [head, pages].concat();
            }
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

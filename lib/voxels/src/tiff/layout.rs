//! How the pixels of one page are stored, checked against the file before anything is
//! allocated.

use std::sync::Arc;

use ::tiff::tags::Tag;
use particle_file::limits;

use super::encoding::{Compression, sample_of, shown};
use super::ifd::{Directory, IMAGE_DEPTH};
use crate::colours::Shown;
use crate::sample::PageFormat;

const TOO_LARGE: &str = "it declares more pixels than can be counted";

/// A page as it is stored.
#[derive(Clone, Debug)]
pub(crate) struct PageLayout {
    pub(crate) format: PageFormat,
    pub(crate) shown: Arc<Shown>,
    /// Value of tag 274; rows are read as they are stored, whatever it is.
    pub(crate) orientation: u64,
    /// Stored bits per sample; below 8 only with unsigned samples, one channel.
    pub(crate) bits: u16,
    pub(crate) compression: Compression,
    /// Value of tag 317; 1 is none.
    pub(crate) predictor: u16,
    /// Channels are stored one after another instead of interleaved.
    pub(crate) planar: bool,
    /// Columns and rows of a chunk; the last strip may have fewer rows.
    pub(crate) chunk: [usize; 2],
    tiled: bool,
    pub(crate) big_endian: bool,
    /// Offset and length in bytes of each chunk in the file, plane by plane.
    pub(crate) chunks: Vec<(u64, u64)>,
}

impl PageLayout {
    /// Reads and checks the layouts of the planes of a directory in a file of `file_len` bytes: one,
    /// or as many as its tag ImageDepth says (SGI's: the strips of plane after plane, or all planes
    /// in one strip).
    pub(crate) fn read_planes(page: &Directory, file_len: u64) -> Result<Vec<Self>, String> {
        let first = |tag, default| Ok::<_, String>(page.uint(tag)?.unwrap_or(default));
        if first(Tag::NewSubfileType, 0)? & 1 != 0 {
            let what = "it is a reduced copy (thumbnail) of another page; remove it from the stack";
            return Err(what.into());
        }
        if first(Tag::FillOrder, 1)? != 1 {
            let what = "its bits are stored in reverse (FillOrder 2); accepted is FillOrder 1";
            return Err(what.into());
        }
        let (sample, bits, channels) = sample_of(page)?;
        let side = |tag, name| match page.uint(tag)? {
            Some(n) if n > 0 && n <= u64::from(u32::MAX) => Ok(n as usize),
            Some(n) => Err(format!("its {name} is {n}, which is no size")),
            None => Err(format!("its {name} is not given")),
        };
        let size = [
            side(Tag::ImageWidth, "width")?,
            side(Tag::ImageLength, "height")?,
        ];
        let format = PageFormat::new(size, sample, channels);
        let compression = Compression::parse(first(Tag::Compression, 1)?)?;
        let mut layout = Self {
            orientation: first(Tag::Orientation, 1)?,
            shown: Arc::new(shown(page, sample, bits)?),
            bits,
            predictor: compression.predictor(first(Tag::Predictor, 1)?, sample, bits)?,
            compression,
            planar: channels > 1 && first(Tag::PlanarConfiguration, 1)? == 2,
            chunk: size,
            tiled: false,
            format,
            big_endian: page.is_big_endian(),
            chunks: Vec::new(),
        };
        let depth = first(IMAGE_DEPTH, 1)?;
        if depth == 0 || depth > limits::PER_AXIS {
            return Err(format!("its tag ImageDepth declares {depth} planes"));
        }
        layout.read_chunks(page, depth)?;
        if depth == 1 {
            layout.check_chunks(file_len)?;
            return Ok(vec![layout]);
        }
        layout.cut_into_planes(depth as usize, file_len)
    }

    fn read_chunks(&mut self, page: &Directory, depth: u64) -> Result<(), String> {
        let side = |tag| {
            let side = page.uint(tag)?.filter(|n| *n > 0 && *n <= 1 << 24);
            side.map(|n| n as usize)
                .ok_or("its tiles have no size".to_owned())
        };
        let (offsets, counts) = match page.uints(Tag::TileOffsets)? {
            Some(offsets) => {
                self.chunk = [side(Tag::TileWidth)?, side(Tag::TileLength)?];
                self.tiled = true;
                (offsets, Tag::TileByteCounts)
            }
            None => {
                let rows = page.uint(Tag::RowsPerStrip)?;
                let rows = rows.unwrap_or(u64::MAX).clamp(1, self.format.height as u64);
                self.chunk[1] = rows as usize;
                let offsets = page.uints(Tag::StripOffsets)?;
                let offsets = offsets.ok_or("it has neither strips nor tiles of pixels")?;
                (offsets, Tag::StripByteCounts)
            }
        };
        let expected = self.chunks_per_plane() * self.planes() as u64;
        let in_one_piece = depth > 1 && offsets.len() == 1 && expected == 1;
        let expected = expected.checked_mul(depth).ok_or(TOO_LARGE)?;
        if offsets.len() as u64 != expected && !in_one_piece {
            return Err(format!(
                "it has {} strips or tiles but its size needs {expected}",
                offsets.len()
            ));
        }
        self.chunks = match page.uints(counts)? {
            Some(counts) if counts.len() == offsets.len() => {
                offsets.into_iter().zip(counts).collect()
            }
            None if self.compression == Compression::None => {
                let sized = |(i, offset)| Some((offset, self.chunk_bytes(i)?));
                let chunks: Option<_> = offsets.into_iter().enumerate().map(sized).collect();
                chunks.ok_or(TOO_LARGE)?
            }
            _ => return Err("the lengths of its strips or tiles are not given".into()),
        };
        Ok(())
    }

    fn cut_into_planes(mut self, depth: usize, file_len: u64) -> Result<Vec<Self>, String> {
        if self.planes() > 1 || self.tiled {
            return Err("it holds several planes by the tag ImageDepth, in tiles or by colour; accepted are strips of whole pixels: save it with a page for each plane".into());
        }
        let [(offset, stored)] = self.chunks[..] else {
            let planes = self.chunks.chunks(self.chunks_per_plane() as usize);
            let plane = |chunks: &[(u64, u64)]| {
                let mut plane = self.clone();
                plane.chunks = chunks.to_vec();
                plane.check_chunks(file_len).map(|()| plane)
            };
            return planes.map(plane).collect();
        };
        if self.compression != Compression::None {
            return Err(format!(
                "its {depth} planes by the tag ImageDepth are compressed in one piece; accepted are strips of one plane, or no compression: save it with a page for each plane"
            ));
        }
        let bytes = self.plane_bytes().ok_or(TOO_LARGE)?.1 as u64;
        let all = bytes.checked_mul(depth as u64);
        if all.is_none_or(|all| all > stored) {
            return Err(format!(
                "its tag ImageDepth declares {depth} planes of {bytes} bytes, but {stored} bytes are stored: its size or the file is corrupt"
            ));
        }
        self.chunk[1] = self.format.height;
        self.chunks = vec![(offset, bytes)];
        self.check_chunks(file_len)?;
        (0..depth)
            .map(|k| self.following_plane(k, file_len))
            .collect()
    }

    /// Planes that are stored one after another.
    pub(crate) fn planes(&self) -> usize {
        if self.planar { self.format.channels } else { 1 }
    }

    /// Samples of a pixel that stand side by side in a plane.
    pub(crate) fn samples_side_by_side(&self) -> usize {
        self.format.channels / self.planes()
    }

    /// Stored bytes of `width` pixels of a plane; rows are padded to whole bytes.
    pub(crate) fn row_bytes(&self, width: usize) -> Option<usize> {
        let bits = self.samples_side_by_side() * usize::from(self.bits);
        Some(width.checked_mul(bits)?.div_ceil(8))
    }

    /// Stored bytes of a row and of a plane once decompressed.
    pub(crate) fn plane_bytes(&self) -> Option<(usize, usize)> {
        let row = self.row_bytes(self.format.width)?;
        Some((row, row.checked_mul(self.format.height)?))
    }

    fn chunks_per_plane(&self) -> u64 {
        let PageFormat { width, height, .. } = self.format;
        let [columns, rows] = self.chunk;
        // All are below 2^32.
        width.div_ceil(columns) as u64 * height.div_ceil(rows) as u64
    }

    /// Rows of chunk `i`; tiles are stored whole, the last strip is not.
    pub(crate) fn chunk_rows(&self, i: usize) -> usize {
        let strip = (i as u64 % self.chunks_per_plane()) as usize;
        match self.tiled {
            true => self.chunk[1],
            false => self.chunk[1].min(self.format.height - strip * self.chunk[1]),
        }
    }

    /// Bytes of chunk `i` once decompressed.
    fn chunk_bytes(&self, i: usize) -> Option<u64> {
        let bytes = self.row_bytes(self.chunk[0])?;
        Some(bytes.checked_mul(self.chunk_rows(i))? as u64)
    }

    /// Checks that the file can hold what the page declares, and joins strips that follow
    /// one another.
    fn check_chunks(&mut self, file_len: u64) -> Result<(), String> {
        for i in 0..self.chunks.len() {
            let (offset, stored) = self.chunks[i];
            if offset.checked_add(stored).is_none_or(|end| end > file_len) {
                return Err(format!(
                    "its pixels at byte {offset}, {stored} long, reach beyond the end of the file at byte {file_len}: the file is truncated"
                ));
            }
            if self.is_left_out(stored) {
                continue;
            }
            let declared = self.chunk_bytes(i).ok_or(TOO_LARGE)?;
            if declared > stored.saturating_mul(self.compression.max_ratio()) {
                return Err(format!(
                    "it is declared as {} with strips or tiles of {declared} bytes, but {stored} bytes are stored for one: its size or the file is corrupt",
                    self.format
                ));
            }
            if self.is_plain() {
                self.chunks[i].1 = declared;
            }
        }
        if self.is_plain() {
            self.chunks.dedup_by(|next, run| {
                let follows = run.0 + run.1 == next.0;
                run.1 += if follows { next.1 } else { 0 };
                follows
            });
        }
        let [width, _] = self.chunk;
        if self.tiled && width * usize::from(self.bits) % 8 != 0 {
            return Err(format!(
                "its tiles of {width} pixels of {} bits do not end at whole bytes",
                self.bits
            ));
        }
        let plane = self
            .plane_bytes()
            .and_then(|(_, n)| n.checked_mul(self.planes()));
        let page = self.format.page_bytes();
        plane
            .and(page)
            .filter(|_| plane > Some(0))
            .map(|_| ())
            .ok_or(TOO_LARGE.into())
    }

    /// Whether a chunk with so many bytes is a tile that its writer left out: all 0. A strip without
    /// bytes is what writers leave that were ended before.
    pub(crate) fn is_left_out(&self, stored: u64) -> bool {
        stored == 0 && self.tiled
    }

    /// Whether the pixels stand in the file as they are.
    pub(crate) fn is_plain(&self) -> bool {
        self.compression == Compression::None && !self.tiled
    }

    /// The layout of plane `k` of planes that follow this page in the file without
    /// directories of their own.
    pub(crate) fn following_plane(&self, k: usize, file_len: u64) -> Result<Self, String> {
        let (true, [(offset, bytes)]) = (self.is_plain(), &self.chunks[..]) else {
            let what = "planes that follow one another need uncompressed pixels in one piece";
            return Err(what.into());
        };
        let begin = offset.saturating_add(bytes.saturating_mul(k as u64));
        if begin.saturating_add(*bytes) > file_len {
            return Err(format!(
                "its pixels reach beyond the end of the file at byte {file_len}: the file is truncated"
            ));
        }
        let mut plane = self.clone();
        plane.chunks = vec![(begin, *bytes)];
        Ok(plane)
    }
}

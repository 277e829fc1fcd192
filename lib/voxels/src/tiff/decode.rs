//! From a page's layout to its pixels.

use std::fs::File;
use std::io::Cursor;
use std::os::unix::fs::FileExt;

use ::tiff::decoder::{Decoder, Limits};

use super::ifd::tag;
use super::layout::{Cut, PageLayout};
use crate::sample::{Sample, swap_bytes, unpack_bits};

/// Reads the page into `page`, which is empty: rows without padding, channels interleaved, one sample per
/// pixel and channel in native byte order.
pub(crate) fn read(file: &File, layout: &PageLayout, page: &mut Vec<u8>) -> Result<(), String> {
    let (row_bytes, plane_bytes) = layout.plane_bytes().unwrap_or_default();
    page.resize(plane_bytes * layout.planes(), 0);
    if layout.is_plain() {
        let mut rest = page.as_mut_slice();
        for &(offset, bytes) in &layout.chunks {
            let (run, behind) = rest.split_at_mut(bytes as usize);
            file.read_exact_at(run, offset).map_err(|e| e.to_string())?;
            rest = behind;
        }
        if layout.big_endian != cfg!(target_endian = "big") {
            swap_bytes(page, layout.format.sample.bytes());
        }
    } else {
        let chunks = layout.chunks.chunks(layout.chunks.len() / layout.planes());
        for (plane, chunks) in page.chunks_mut(plane_bytes).zip(chunks) {
            decode_plane(file, layout, chunks, plane)?;
        }
    }
    if layout.bits < 8 {
        let (bits, width) = (layout.bits.into(), layout.format.width);
        let rows = page.chunks_exact(row_bytes);
        *page = rows.flat_map(|row| unpack_bits(row, bits, width)).collect();
    }
    if layout.planar {
        *page = interleave(page, layout.format.sample.bytes(), layout.planes());
    }
    Ok(())
}

/// Decodes a plane with the `tiff` crate, from a copy of its chunks in memory under a
/// directory of our own that calls the samples plain greys: whatever the original says about
/// photometric interpretation, colour maps or planes cannot touch the stored values.
///
/// Tiles are handed over as the strips of a high page and put in their places here: the
/// crate reads tiles row by row and gives up on LZW codes that end with a row
/// (<https://github.com/image-rs/image-tiff/issues/395>).
fn decode_plane(
    file: &File,
    layout: &PageLayout,
    chunks: &[(u64, u64)],
    plane: &mut [u8],
) -> Result<(), String> {
    let stored: Vec<(u64, u64)> = (chunks.iter().copied())
        .filter(|&(_, bytes)| !layout.is_left_out(bytes))
        .collect();
    if stored.is_empty() {
        return Ok(());
    }
    let bytes = as_grey_tiff(file, layout, &stored)?;
    // The sizes are checked; the crate's own limits would refuse large pages.
    let decoder = Decoder::new(Cursor::new(bytes)).map(|d| d.with_limits(Limits::unlimited()));
    let decode = |pixels: &mut [u8]| {
        decoder
            .and_then(|mut decoder| decoder.read_image_bytes(pixels))
            .map_err(|e| {
                format!("its pixels do not decode ({e}): the file is truncated or corrupt")
            })
    };
    let Some((tile_row, tile)) = layout.tile_bytes() else {
        return decode(plane);
    };
    let mut pixels = vec![0; tile * chunks.len()];
    let mut left = stored.len();
    decode(&mut pixels[..tile * left])?;
    // Each to its place, from the last.
    for (i, &(_, bytes)) in chunks.iter().enumerate().rev() {
        if layout.is_left_out(bytes) {
            pixels[tile * i..tile * (i + 1)].fill(0);
        } else {
            left -= 1;
            pixels.copy_within(tile * left..tile * (left + 1), tile * i);
        }
    }
    let row = plane.len() / layout.format.height;
    let across = row.div_ceil(tile_row);
    let rows_of_tiles = plane.chunks_mut(row * (tile / tile_row));
    for (rows, tiles) in rows_of_tiles.zip(pixels.chunks(tile * across)) {
        for (y, row) in rows.chunks_exact_mut(row).enumerate() {
            for (part, tile) in row.chunks_mut(tile_row).zip(tiles.chunks(tile)) {
                part.copy_from_slice(&tile[y * tile_row..][..part.len()]);
            }
        }
    }
    Ok(())
}

const SHORT: u16 = 3;
const LONG: u16 = 4;
const LONG8: u16 = 16;

/// The tags of a page of so many `chunks` as strips but for their places: number, type and value.
fn tags(layout: &PageLayout, chunks: usize) -> Vec<(u16, u16, u64)> {
    let sample_format = match layout.format.sample {
        Sample::U8 | Sample::U16 | Sample::U32 | Sample::U64 => 1,
        Sample::I8 | Sample::I16 | Sample::I32 | Sample::I64 => 2,
        Sample::F32 | Sample::F64 => 3,
    };
    let format = &layout.format;
    let (width, height, rows) = match layout.cut {
        Cut::Strips(rows) => (format.width as u64, format.height as u64, rows),
        Cut::Tiles(w, h) => (w.into(), u64::from(h) * chunks as u64, h),
    };
    let samples = layout.samples_side_by_side() as u64;
    vec![
        (tag::IMAGE_WIDTH, LONG, width),
        (tag::IMAGE_LENGTH, LONG, height),
        (tag::BITS_PER_SAMPLE, SHORT, layout.bits.into()),
        (tag::COMPRESSION, SHORT, layout.compression.code().into()),
        (tag::PHOTOMETRIC, SHORT, 1), // black is zero
        (tag::SAMPLES_PER_PIXEL, SHORT, samples),
        (tag::ROWS_PER_STRIP, LONG, rows.into()),
        (tag::PREDICTOR, SHORT, layout.predictor.into()),
        (tag::SAMPLE_FORMAT, SHORT, sample_format),
    ]
}

/// A BigTIFF of one page with these chunks as strips.
fn as_grey_tiff(
    file: &File,
    layout: &PageLayout,
    chunks: &[(u64, u64)],
) -> Result<Vec<u8>, String> {
    let mut tags = tags(layout, chunks.len());
    // Header (16), count (8), entries (20 each), next (8), offsets, lengths, chunks.
    let entries = tags.len() + 2;
    let arrays = 16 + 8 + 20 * entries as u64 + 8;
    let n = chunks.len() as u64;
    let mut at = arrays + 16 * n;
    let big = layout.big_endian;
    let mut out = Bytes {
        bytes: Vec::new(),
        big,
    };
    out.bytes.extend(if big { b"MM" } else { b"II" });
    out.put(43, 2);
    out.put(8, 2);
    out.put(0, 2);
    out.put(16, 8);
    out.put(entries as u64, 8);
    // One chunk's offset and length stand in the entry itself, as the format demands.
    let one = |value, place| if n == 1 { value } else { place };
    let first = chunks.first().map_or(0, |c| c.1);
    tags.push((tag::STRIP_OFFSETS, LONG8, one(at, arrays)));
    tags.push((tag::STRIP_BYTE_COUNTS, LONG8, one(first, arrays + 8 * n)));
    tags.sort_unstable();
    for (tag, kind, value) in tags {
        out.put(tag.into(), 2);
        out.put(kind.into(), 2);
        out.put(if kind == LONG8 { n } else { 1 }, 8);
        let width = match kind {
            SHORT => 2,
            LONG => 4,
            _ => 8,
        };
        out.put(value, width);
        out.put(0, 8 - width);
    }
    out.put(0, 8);
    for &(_, stored) in chunks {
        out.put(at, 8);
        at += stored;
    }
    for &(_, stored) in chunks {
        out.put(stored, 8);
    }
    let mut bytes = out.bytes;
    for &(offset, stored) in chunks {
        let start = bytes.len();
        bytes.resize(start + stored as usize, 0);
        file.read_exact_at(&mut bytes[start..], offset)
            .map_err(|e| e.to_string())?;
    }
    Ok(bytes)
}

/// Bytes of a TIFF in the making.
struct Bytes {
    bytes: Vec<u8>,
    big: bool,
}

impl Bytes {
    /// Appends the low `width` bytes of `value`.
    fn put(&mut self, value: u64, width: usize) {
        if self.big {
            self.bytes.extend(&value.to_be_bytes()[8 - width..]);
        } else {
            self.bytes.extend(&value.to_le_bytes()[..width]);
        }
    }
}

/// Pixels from planes.
fn interleave(planes: &[u8], sample_bytes: usize, channels: usize) -> Vec<u8> {
    let plane_bytes = planes.len() / channels;
    (0..plane_bytes)
        .step_by(sample_bytes)
        .flat_map(|at| (0..channels).map(move |c| c * plane_bytes + at))
        .flat_map(|at| &planes[at..at + sample_bytes])
        .copied()
        .collect()
}

//! From a page's layout to its pixels.

use std::fs::File;
use std::io::Cursor;
use std::os::unix::fs::FileExt;

use ::tiff::decoder::{Decoder, Limits};
use ::tiff::tags::Tag;

use super::layout::{Cut, PageLayout};
use crate::sample::{Sample, to_native, unpack_bits};

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
        to_native(page, layout.format.sample, layout.big_endian);
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

/// A BigTIFF of one page with these chunks as strips.
fn as_grey_tiff(
    file: &File,
    layout: &PageLayout,
    chunks: &[(u64, u64)],
) -> Result<Vec<u8>, String> {
    const LONG8: u64 = 16;
    let number = |value: u64, width: usize| match layout.big_endian {
        true => value.to_be_bytes()[8 - width..].to_vec(),
        false => value.to_le_bytes()[..width].to_vec(),
    };
    let n = chunks.len() as u64;
    // Header (16), count (8), entries (20 each), next (8), offsets, lengths, chunks.
    let mut tags = tags(layout, n);
    let entries = tags.len() as u64 + 2;
    let arrays = 16 + 8 + 20 * entries + 8;
    let mut at = arrays + 16 * n;
    // One chunk's offset and length stand in the entry itself, as the format demands.
    let one = |value, place| if n == 1 { value } else { place };
    tags.push((Tag::StripOffsets.to_u16(), n, one(at, arrays)));
    tags.push((
        Tag::StripByteCounts.to_u16(),
        n,
        one(chunks[0].1, arrays + 8 * n),
    ));
    tags.sort_unstable();
    let mut bytes = if layout.big_endian { b"MM" } else { b"II" }.to_vec();
    for (value, width) in [(43, 2), (8, 2), (0, 2), (16, 8), (entries, 8)] {
        bytes.extend(number(value, width));
    }
    for (tag, count, value) in tags {
        for (value, width) in [(tag.into(), 2), (LONG8, 2), (count, 8), (value, 8)] {
            bytes.extend(number(value, width));
        }
    }
    bytes.extend(number(0, 8));
    for &(_, stored) in chunks {
        bytes.extend(number(at, 8));
        at += stored;
    }
    for &(_, stored) in chunks {
        bytes.extend(number(stored, 8));
    }
    for &(offset, stored) in chunks {
        let start = bytes.len();
        bytes.resize(start + stored as usize, 0);
        let read = file.read_exact_at(&mut bytes[start..], offset);
        read.map_err(|e| e.to_string())?;
    }
    Ok(bytes)
}

/// The tags of a page of so many `chunks` as strips but for their places: number, count and value.
fn tags(layout: &PageLayout, chunks: u64) -> Vec<(u16, u64, u64)> {
    let sample_format = match layout.format.sample {
        Sample::U8 | Sample::U16 | Sample::U32 | Sample::U64 => 1,
        Sample::I8 | Sample::I16 | Sample::I32 | Sample::I64 => 2,
        Sample::F32 | Sample::F64 => 3,
    };
    let (width, height) = (layout.format.width as u64, layout.format.height as u64);
    let (width, height, rows) = match layout.cut {
        Cut::Strips(rows) => (width, height, rows),
        Cut::Tiles(w, h) => (w.into(), u64::from(h) * chunks, h),
    };
    let tags = [
        (Tag::ImageWidth, width),
        (Tag::ImageLength, height),
        (Tag::BitsPerSample, layout.bits.into()),
        (Tag::Compression, layout.compression as u64),
        (Tag::PhotometricInterpretation, 1), // black is zero
        (Tag::SamplesPerPixel, layout.samples_side_by_side() as u64),
        (Tag::RowsPerStrip, rows.into()),
        (Tag::Predictor, layout.predictor.into()),
        (Tag::SampleFormat, sample_format),
    ];
    tags.map(|(tag, value)| (tag.to_u16(), 1, value)).to_vec()
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

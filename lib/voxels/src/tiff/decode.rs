//! From a page's layout to its pixels. Plain strips are read directly. Everything else goes through the `tiff` crate as a page of
//! plain grey strips in memory, so that the crate decompresses, undoes predictors and orders bytes, and does not meet what it
//! misreads: MINISWHITE, palettes, planar RGB, several planes in a page, and LZW tiles whose rows end between two codes
//! (image-rs/image-tiff issue 395).

use std::fs::File;
use std::io::Cursor;
use std::os::unix::fs::FileExt;

use ::tiff::decoder::{Decoder, Limits};
use ::tiff::tags::Tag;

use super::layout::PageLayout;
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

/// Decodes a plane with the `tiff` crate, chunk by chunk, from a copy in memory under a directory of our
/// own that calls the samples plain greys in one strip: whatever the original says about
/// photometric interpretation, colour maps or planes cannot touch the stored values.
///
/// Tiles are strips of their own, too: the crate reads tiles row by row and
/// gives up on LZW codes that end with a row (<https://github.com/image-rs/image-tiff/issues/395>).
fn decode_plane(
    file: &File,
    layout: &PageLayout,
    chunks: &[(u64, u64)],
    plane: &mut [u8],
) -> Result<(), String> {
    let row = plane.len() / layout.format.height;
    let chunk_row = layout.row_bytes(layout.chunk[0]).unwrap_or_default();
    let across = row.div_ceil(chunk_row);
    let mut pixels = Vec::new();
    for (i, &chunk) in chunks.iter().enumerate() {
        if layout.is_left_out(chunk.1) {
            continue;
        }
        let size = [layout.chunk[0], layout.chunk_rows(i)];
        pixels.resize(chunk_row * size[1], 0);
        decode(file, layout, chunk, size, &mut pixels)?;
        let rows = plane.chunks_exact_mut(row);
        let rows = rows.skip(i / across * layout.chunk[1]);
        for (row, stored) in rows.zip(pixels.chunks(chunk_row)) {
            let part = row
                .chunks_mut(chunk_row)
                .nth(i % across)
                .unwrap_or_default();
            part.copy_from_slice(&stored[..part.len()]);
        }
    }
    Ok(())
}

/// Decodes a chunk of so many columns and rows, as the only strip of a BigTIFF of one page.
fn decode(
    file: &File,
    layout: &PageLayout,
    (offset, stored): (u64, u64),
    [width, height]: [usize; 2],
    pixels: &mut [u8],
) -> Result<(), String> {
    const LONG8: u64 = 16;
    let sample_format = match layout.format.sample {
        Sample::U8 | Sample::U16 | Sample::U32 | Sample::U64 => 1,
        Sample::I8 | Sample::I16 | Sample::I32 | Sample::I64 => 2,
        Sample::F32 | Sample::F64 => 3,
    };
    // Header (16), count (8), entries (20 each), next (8), the chunk.
    const ENTRIES: u64 = 11;
    let at = 16 + 8 + 20 * ENTRIES + 8;
    let tags: [(Tag, u64); ENTRIES as usize] = [
        (Tag::ImageWidth, width as u64),
        (Tag::ImageLength, height as u64),
        (Tag::BitsPerSample, layout.bits.into()),
        (Tag::Compression, layout.compression as u64),
        (Tag::PhotometricInterpretation, 1), // black is zero
        (Tag::StripOffsets, at),
        (Tag::SamplesPerPixel, layout.samples_side_by_side() as u64),
        (Tag::RowsPerStrip, height as u64),
        (Tag::StripByteCounts, stored),
        (Tag::Predictor, layout.predictor.into()),
        (Tag::SampleFormat, sample_format),
    ];
    let entry =
        |(tag, value): (Tag, u64)| [(tag.to_u16().into(), 2), (LONG8, 2), (1, 8), (value, 8)];
    let head = [(43, 2), (8, 2), (0, 2), (16, 8), (ENTRIES, 8)].into_iter();
    let numbers = head.chain(tags.into_iter().flat_map(entry)).chain([(0, 8)]);
    let mut bytes = if layout.big_endian { b"MM" } else { b"II" }.to_vec();
    numbers.for_each(|(value, width)| match layout.big_endian {
        true => bytes.extend(&value.to_be_bytes()[8 - width..]),
        false => bytes.extend(&value.to_le_bytes()[..width]),
    });
    bytes.resize((at + stored) as usize, 0);
    let read = file.read_exact_at(&mut bytes[at as usize..], offset);
    read.map_err(|e| e.to_string())?;
    // The sizes are checked; the crate's own limits would refuse large pages.
    let decoder = Decoder::new(Cursor::new(bytes)).map(|d| d.with_limits(Limits::unlimited()));
    let decoded = decoder.and_then(|mut decoder| decoder.read_image_bytes(pixels));
    decoded.map_err(|e| format!("its pixels do not decode ({e}): the file is truncated or corrupt"))
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

//! Uncompressed BMP: the indices of a palette, or RGB, of 24 or 32 bits.
//!
//! Our own, for stored values are labels: the `image` crate gives the colours of a palette, and
//! where it is asked for indices of fewer than 8 bits it panics (0.25.10).

use crate::colours::Shown;
use crate::sample::{PageFormat, Sample, unpack_bits};
use crate::source::Source;

/// Bytes that hold the fields of the oldest and of later headers.
const HEAD: usize = 34;
/// Where later headers hold which bits of a pixel are red, green and blue.
const MASKS: u64 = 54;
/// Blue, green, red and a byte that is opacity or unused.
const BGRX: [u8; 12] = [0, 0, 0xff, 0, 0, 0xff, 0, 0, 0xff, 0, 0, 0];

/// Where the pixels of a file are and how they are stored.
struct Header {
    format: PageFormat,
    /// Bits of a pixel.
    bits: usize,
    /// The first row stored is the highest, not the lowest.
    from_top: bool,
    offset: u64,
    /// Bytes from the beginning to the palette.
    palette: u64,
    /// Bytes of one of its colours.
    colour: usize,
}

impl Header {
    fn read(source: &Source) -> Result<Self, String> {
        let head = source.window(0, HEAD).map_err(|e| e.to_string())?;
        if head.len() < HEAD {
            return Err("its header is truncated".into());
        }
        let short = |at: usize| u16::from_le_bytes([head[at], head[at + 1]]);
        let long = |at: usize| u32::from(short(at)) | u32::from(short(at + 2)) << 16;
        let (width, height, bits, compression) = match long(14) {
            12 => (i32::from(short(18)), i32::from(short(20)), short(24), 0),
            40.. => (long(18) as i32, long(22) as i32, short(28), long(30)),
            n => return Err(format!("its header of {n} bytes is of no known version")),
        };
        let masks = source.window(MASKS, BGRX.len());
        let masks = masks.map_err(|e| e.to_string())?;
        let plain = match (bits, compression) {
            (1 | 2 | 4 | 8 | 24 | 32, 0) => true,
            // By masks, which are those of plain pixels.
            (32, 3 | 6) => masks == BGRX,
            _ => false,
        };
        if !plain {
            return Err(format!(
                "its pixels have {bits} bits and compression {compression}; accepted is BMP of 1, 4, 8, 24 or 32 bits without compression"
            ));
        }
        if width <= 0 || height == 0 {
            return Err(format!("it is {width} x {height}, which is no page"));
        }
        Ok(Self {
            format: PageFormat {
                width: width as usize,
                height: height.unsigned_abs() as usize,
                sample: Sample::U8,
                channels: if bits >= 24 { 3 } else { 1 },
            },
            bits: bits.into(),
            from_top: height < 0,
            offset: long(10).into(),
            palette: 14 + u64::from(long(14)),
            colour: if long(14) == 12 { 3 } else { 4 },
        })
    }

    fn shown(&self, source: &Source) -> Result<Shown, String> {
        if self.bits >= 24 {
            return Ok(Shown::RGB);
        }
        let room = self.offset.saturating_sub(self.palette);
        let bytes = room.min((self.colour << self.bits) as u64) as usize;
        let stored = source.window(self.palette, bytes);
        let stored = stored.map_err(|e| e.to_string())?;
        let colours = stored.chunks_exact(self.colour);
        Ok(Shown::opaque(colours.map(|bgr| [bgr[2], bgr[1], bgr[0]])))
    }

    /// Stored bytes of a row: whole words of 32 bits.
    fn row(&self) -> usize {
        (self.format.width * self.bits).div_ceil(32) * 4
    }
}

/// The format of the file and what its values show; its pixels are read where there is a `page` for them.
pub(crate) fn read(
    source: &Source,
    page: Option<&mut Vec<u8>>,
) -> Result<(PageFormat, Shown), String> {
    let header = Header::read(source)?;
    let (row, format) = (header.row(), header.format);
    let bytes = row * format.height;
    if header.offset.saturating_add(bytes as u64) > source.len() {
        return Err(format!(
            "it is {format}, but the file ends before: it is truncated"
        ));
    }
    let shown = header.shown(source)?;
    let Some(page) = page else {
        return Ok((format, shown));
    };
    let stored = source.window(header.offset, bytes);
    let mut stored = stored.map_err(|e| e.to_string())?;
    if !header.from_top {
        let rows: Vec<&[u8]> = stored.chunks_exact(row).rev().collect();
        stored = rows.concat();
    }
    if header.bits == 32 && stored.chunks_exact(4).any(|pixel| pixel[3] != stored[3]) {
        return Err("some of its pixels are transparent: save it without transparency".into());
    }
    for row in stored.chunks_exact(row) {
        match header.bits {
            bits @ (24 | 32) => {
                let pixels = row.chunks_exact(bits / 8).take(format.width);
                pixels.for_each(|bgr| page.extend(bgr[..3].iter().rev()));
            }
            bits => page.extend(unpack_bits(row, bits, format.width)),
        }
    }
    Ok((format, shown))
}

//! Uncompressed BMP: the indices of a palette, or RGB, of 24 or 32 bits.
//!
//! Our own, for stored values are labels: the `image` crate gives the colours of a palette, and
//! where it is asked for indices of fewer than 8 bits it panics (0.25.10).

use crate::colours::Shown;
use crate::images::Read;
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
    fn read(source: &Source) -> Result<Self, Box<dyn std::error::Error>> {
        let head = source.window(0, HEAD)?;
        if head.len() < HEAD {
            return Err("its header is truncated".into());
        }
        let short = |at: usize| u16::from_le_bytes([head[at], head[at + 1]]);
        let long = |at: usize| u32::from(short(at)) | u32::from(short(at + 2)) << 16;
        let (width, height, bits, compression) = match long(14) {
            12 => (i32::from(short(18)), i32::from(short(20)), short(24), 0),
            40.. => (long(18) as i32, long(22) as i32, short(28), long(30)),
            n => return Err(format!("its header of {n} bytes is of no known version").into()),
        };
        let plain = match (bits, compression) {
            (1 | 2 | 4 | 8 | 24 | 32, 0) => true,
            // By masks, which are those of plain pixels.
            (32, 3 | 6) => source.window(MASKS, BGRX.len())? == BGRX,
            _ => false,
        };
        if !plain {
            return Err(format!(
                "its pixels have {bits} bits and compression {compression}; accepted is BMP of 1, 4, 8, 24 or 32 bits without compression"
            )
            .into());
        }
        if width <= 0 || height == 0 {
            return Err(format!("it is {width} x {height}, which is no page").into());
        }
        let size = [width, height].map(|n| n.unsigned_abs() as usize);
        Ok(Self {
            format: PageFormat::new(size, Sample::U8, if bits >= 24 { 3 } else { 1 }),
            bits: bits.into(),
            from_top: height < 0,
            offset: long(10).into(),
            palette: 14 + u64::from(long(14)),
            colour: if long(14) == 12 { 3 } else { 4 },
        })
    }

    fn shown(&self, source: &Source) -> std::io::Result<Shown> {
        if self.bits >= 24 {
            return Ok(Shown::RGB);
        }
        let room = self.offset.saturating_sub(self.palette);
        let bytes = room.min((self.colour << self.bits) as u64) as usize;
        let stored = source.window(self.palette, bytes)?;
        let colours = stored.chunks_exact(self.colour);
        Ok(Shown::opaque(colours.map(|bgr| [bgr[2], bgr[1], bgr[0]])))
    }
}

/// Reads the pixels too where there is a `page` for them.
pub(crate) fn read(source: &Source, page: Option<&mut Vec<u8>>) -> Read {
    let header = Header::read(source)?;
    let format = header.format;
    // Whole words of 32 bits.
    let row = (format.width * header.bits).div_ceil(32) * 4;
    let bytes = row * format.height;
    if header.offset.saturating_add(bytes as u64) > source.len() {
        return Err(format!("it is {format}, but the file ends before: it is truncated").into());
    }
    let shown = header.shown(source)?;
    let Some(page) = page else {
        return Ok((format, shown));
    };
    let stored = source.window(header.offset, bytes)?;
    if header.bits == 32 && stored.chunks_exact(4).any(|pixel| pixel[3] != stored[3]) {
        return Err("some of its pixels are transparent: save it without transparency".into());
    }
    for y in 0..format.height {
        let y = match header.from_top {
            true => y,
            false => format.height - 1 - y,
        };
        let row = &stored[y * row..][..row];
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

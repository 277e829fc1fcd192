//! The numbers that pixels are stored as.

use std::fmt;

/// The number type of a stored sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sample {
    /// Unsigned, 8 bits; also what 1-, 2- and 4-bit pixels are unpacked to.
    U8,
    /// Unsigned, 16 bits.
    U16,
    /// Unsigned, 32 bits.
    U32,
    /// Unsigned, 64 bits.
    U64,
    /// Signed, 8 bits.
    I8,
    /// Signed, 16 bits.
    I16,
    /// Signed, 32 bits.
    I32,
    /// Signed, 64 bits.
    I64,
    /// IEEE single precision.
    F32,
    /// IEEE double precision.
    F64,
}

impl Sample {
    /// Bytes of one sample.
    pub fn bytes(self) -> usize {
        match self {
            Sample::U8 | Sample::I8 => 1,
            Sample::U16 | Sample::I16 => 2,
            Sample::U32 | Sample::I32 | Sample::F32 => 4,
            Sample::U64 | Sample::I64 | Sample::F64 => 8,
        }
    }

    /// Whether it is an integer.
    pub(crate) fn is_whole(self) -> bool {
        !matches!(self, Sample::F32 | Sample::F64)
    }

    /// The value of one sample in native byte order; `bytes` holds at least
    /// [`Sample::bytes`]. Integers beyond 2^53 are rounded, which no label reaches.
    pub(crate) fn value(self, bytes: &[u8]) -> f64 {
        fn take<const N: usize>(bytes: &[u8]) -> [u8; N] {
            let mut array = [0; N];
            array.copy_from_slice(&bytes[..N]);
            array
        }
        match self {
            Sample::U8 => f64::from(bytes[0]),
            Sample::I8 => f64::from(i8::from_ne_bytes(take(bytes))),
            Sample::U16 => f64::from(u16::from_ne_bytes(take(bytes))),
            Sample::I16 => f64::from(i16::from_ne_bytes(take(bytes))),
            Sample::U32 => f64::from(u32::from_ne_bytes(take(bytes))),
            Sample::I32 => f64::from(i32::from_ne_bytes(take(bytes))),
            Sample::U64 => u64::from_ne_bytes(take(bytes)) as f64,
            Sample::I64 => i64::from_ne_bytes(take(bytes)) as f64,
            Sample::F32 => f64::from(f32::from_ne_bytes(take(bytes))),
            Sample::F64 => f64::from_ne_bytes(take(bytes)),
        }
    }

    /// The sample, in native byte order, of a number that is written as text; none where it does
    /// not fit.
    pub(crate) fn parse(self, text: &str) -> Option<Vec<u8>> {
        fn whole<N: TryFrom<i128>>(text: &str) -> Option<N> {
            let number = text.parse().ok().or_else(|| {
                let number: f64 = text.parse().ok()?;
                (number.fract() == 0.0).then_some(number as i128)
            });
            N::try_from(number?).ok()
        }
        Some(match self {
            Sample::U8 => whole::<u8>(text)?.to_ne_bytes().to_vec(),
            Sample::I8 => whole::<i8>(text)?.to_ne_bytes().to_vec(),
            Sample::U16 => whole::<u16>(text)?.to_ne_bytes().to_vec(),
            Sample::I16 => whole::<i16>(text)?.to_ne_bytes().to_vec(),
            Sample::U32 => whole::<u32>(text)?.to_ne_bytes().to_vec(),
            Sample::I32 => whole::<i32>(text)?.to_ne_bytes().to_vec(),
            Sample::U64 => whole::<u64>(text)?.to_ne_bytes().to_vec(),
            Sample::I64 => whole::<i64>(text)?.to_ne_bytes().to_vec(),
            Sample::F32 => text.parse::<f32>().ok()?.to_ne_bytes().to_vec(),
            Sample::F64 => text.parse::<f64>().ok()?.to_ne_bytes().to_vec(),
        })
    }
}

impl fmt::Display for Sample {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Sample::U8 => "unsigned 8 bits",
            Sample::U16 => "unsigned 16 bits",
            Sample::U32 => "unsigned 32 bits",
            Sample::U64 => "unsigned 64 bits",
            Sample::I8 => "signed 8 bits",
            Sample::I16 => "signed 16 bits",
            Sample::I32 => "signed 32 bits",
            Sample::I64 => "signed 64 bits",
            Sample::F32 => "32-bit float",
            Sample::F64 => "64-bit float",
        })
    }
}

/// What every page of a stack shares.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PageFormat {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Number type of a sample.
    pub sample: Sample,
    /// Samples per pixel: 1, or 3 for `R:G:B` labels.
    pub channels: usize,
}

impl PageFormat {
    /// Bytes of one pixel.
    pub(crate) fn pixel_bytes(&self) -> usize {
        self.sample.bytes() * self.channels
    }

    /// Bytes of one page, if that is a number.
    pub(crate) fn page_bytes(&self) -> Option<usize> {
        self.width
            .checked_mul(self.height)?
            .checked_mul(self.pixel_bytes())
    }

    /// Bytes of so many pages, if that is a number.
    pub(crate) fn volume_bytes(&self, pages: usize) -> Option<u64> {
        u64::try_from(self.page_bytes()?.checked_mul(pages)?).ok()
    }
}

impl fmt::Display for PageFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} x {}, {}", self.width, self.height, self.sample)?;
        if self.channels > 1 {
            write!(f, " x {}", self.channels)?;
        }
        Ok(())
    }
}

/// A byte for each of `width` pixels of a row of 1, 2, 4 or 8 bits each, the first pixel highest in
/// its byte.
pub(crate) fn unpack_bits(row: &[u8], bits: usize, width: usize) -> impl Iterator<Item = u8> {
    let mask = u8::MAX >> (8 - bits);
    (0..width).map(move |x| {
        let at = x * bits;
        row[at / 8] >> (8 - bits - at % 8) & mask
    })
}

/// Reverses the bytes of every sample: from the other byte order to the native one.
pub(crate) fn swap_bytes(bytes: &mut [u8], sample_bytes: usize) {
    // The length as a constant lets the compiler use byte shuffles.
    fn swap<const N: usize>(bytes: &mut [u8]) {
        bytes
            .as_chunks_mut::<N>()
            .0
            .iter_mut()
            .for_each(|s| s.reverse());
    }
    match sample_bytes {
        2 => swap::<2>(bytes),
        4 => swap::<4>(bytes),
        8 => swap::<8>(bytes),
        _ => {}
    }
}

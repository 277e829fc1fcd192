//! The numbers that pixels are stored as.

use std::fmt;
use std::str::FromStr;

macro_rules! samples {
    ($($name:ident $number:ident $parse:ident $nifti:literal $names:literal $says:literal)*) => {
        /// The number type of a stored sample; pixels of 1, 2 and 4 bits are unpacked to `U8`.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Sample {
            $(#[doc = $says] $name,)*
        }

        impl Sample {
            /// Bytes of one sample.
            pub fn bytes(self) -> usize {
                match self {
                    $(Sample::$name => size_of::<$number>(),)*
                }
            }

            /// That of a name in `--type`, MetaImage or NRRD.
            pub(crate) fn named(name: &str) -> Option<Self> {
                match () {
                    $(() if $names.split('|').any(|own| own == name) => Some(Sample::$name),)*
                    () => None,
                }
            }

            /// That of a code in NIfTI.
            pub(crate) fn of_nifti(code: i16) -> Option<Self> {
                match code {
                    $($nifti => Some(Sample::$name),)*
                    _ => None,
                }
            }

            /// The value of one sample in native byte order; `bytes` holds at least
            /// [`Sample::bytes`]. Integers beyond 2^53 are rounded, which no label reaches.
            pub(crate) fn value(self, bytes: &[u8]) -> f64 {
                match self {
                    $(Sample::$name => <$number>::from_ne_bytes(first(bytes)) as f64,)*
                }
            }

            /// The sample, in native byte order, of a number that is written as text; none where it
            /// does not fit.
            pub(crate) fn parse(self, text: &str) -> Option<Vec<u8>> {
                match self {
                    $(Sample::$name => $parse::<$number>(text).map(|n| n.to_ne_bytes().to_vec()),)*
                }
            }
        }

        impl fmt::Display for Sample {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(match self {
                    $(Sample::$name => $says,)*
                })
            }
        }
    };
}

// MetaImage's LONG has four bytes wherever it is written.
samples! {
    U8 u8 whole 2 "u8|MET_UCHAR|uchar|unsigned char|uint8" "unsigned 8 bits"
    U16 u16 whole 512 "u16|MET_USHORT|ushort|unsigned short|uint16" "unsigned 16 bits"
    U32 u32 whole 768 "u32|MET_UINT|MET_ULONG|uint|unsigned int|uint32" "unsigned 32 bits"
    U64 u64 whole 1280 "u64|MET_ULONG_LONG|ulonglong|unsigned long long|uint64" "unsigned 64 bits"
    I8 i8 whole 256 "i8|MET_CHAR|signed char|int8" "signed 8 bits"
    I16 i16 whole 4 "i16|MET_SHORT|short|signed short|int16" "signed 16 bits"
    I32 i32 whole 8 "i32|MET_INT|MET_LONG|int|signed int|int32" "signed 32 bits"
    I64 i64 whole 1024 "i64|MET_LONG_LONG|longlong|long long|signed long long|int64" "signed 64 bits"
    F32 f32 real 16 "f32|MET_FLOAT|float" "32-bit float"
    F64 f64 real 64 "f64|MET_DOUBLE|double" "64-bit float"
}

impl Sample {
    pub(crate) fn is_whole(self) -> bool {
        !matches!(self, Sample::F32 | Sample::F64)
    }
}

fn first<const N: usize>(bytes: &[u8]) -> [u8; N] {
    let mut array = [0; N];
    array.copy_from_slice(&bytes[..N]);
    array
}

/// An integer, be it written with decimals that are 0.
fn whole<N: TryFrom<i128>>(text: &str) -> Option<N> {
    let number = text.parse().ok().or_else(|| {
        let number: f64 = text.parse().ok()?;
        (number.fract() == 0.0).then_some(number as i128)
    });
    N::try_from(number?).ok()
}

fn real<N: FromStr>(text: &str) -> Option<N> {
    text.parse().ok()
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
    pub(crate) fn new([width, height]: [usize; 2], sample: Sample, channels: usize) -> Self {
        Self {
            width,
            height,
            sample,
            channels,
        }
    }

    pub(crate) fn pixel_bytes(&self) -> usize {
        self.sample.bytes() * self.channels
    }

    /// The numbers of a row of pixels of one sample.
    pub(crate) fn values(self, row: &[u8]) -> impl Iterator<Item = f64> {
        let pixels = row.chunks_exact(self.sample.bytes());
        pixels.map(move |pixel| self.sample.value(pixel))
    }

    /// Bytes of one page, if that is a number.
    pub(crate) fn page_bytes(&self) -> Option<usize> {
        let pixels = self.width.checked_mul(self.height)?;
        pixels.checked_mul(self.pixel_bytes())
    }

    /// Bytes of so many pages, if that is a number.
    pub(crate) fn volume_bytes(&self, pages: usize) -> Option<u64> {
        u64::try_from(self.page_bytes()?.checked_mul(pages)?).ok()
    }
}

impl fmt::Display for PageFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} x {}, {}", self.width, self.height, self.sample)?;
        match self.channels {
            1 => Ok(()),
            n => write!(f, " x {n}"),
        }
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

/// From one byte order to the native one.
pub(crate) fn to_native(bytes: &mut [u8], sample: Sample, big_endian: bool) {
    if big_endian != cfg!(target_endian = "big") {
        let samples = bytes.chunks_exact_mut(sample.bytes());
        samples.for_each(<[u8]>::reverse);
    }
}

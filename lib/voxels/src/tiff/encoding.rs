//! How samples are encoded: number type, compression, predictor.

use ::tiff::tags::Tag;

use super::ifd::Directory;
use crate::colours::Shown;
use crate::sample::Sample;

/// How pixels are packed into chunks, by its code in TIFF tag 259.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Compression {
    None = 1,
    Lzw = 5,
    Deflate = 8,
    PackBits = 32773,
    Zstd = 50000,
}

impl Compression {
    pub(crate) fn parse(code: u64) -> Result<Self, String> {
        let name = match code {
            1 => return Ok(Self::None),
            5 => return Ok(Self::Lzw),
            8 | 32946 => return Ok(Self::Deflate),
            32773 => return Ok(Self::PackBits),
            50000 => return Ok(Self::Zstd),
            2..=4 => " (CCITT fax)",
            6 | 7 => " (JPEG, which does not keep labels)",
            _ => "",
        };
        Err(format!(
            "compression {code}{name} is not accepted; accepted are none, LZW, Deflate, PackBits and zstd"
        ))
    }

    /// The predictor (tag 317) that is undone, if it makes sense for the samples: 2 is the
    /// difference of neighbours, 3 that of the bytes of floats.
    pub(crate) fn predictor(self, code: u64, sample: Sample, bits: u16) -> Result<u16, String> {
        match (self, code) {
            // They know no predictor, whatever the tag says.
            (Self::None | Self::PackBits, _) | (_, 1) => Ok(1),
            (_, 2) if bits >= 8 => Ok(2),
            (_, 3) if matches!(sample, Sample::F32 | Sample::F64) => Ok(3),
            _ => Err(format!(
                "predictor {code} is not accepted for samples of {bits} bits; accepted are 1, for 8 bits and more 2, for floats 3"
            )),
        }
    }

    /// More pixel bytes per stored byte than the method can ever reach. Deflate copies 258
    /// bytes with 2 bits; an LZW code of 12 bits stands for up to 3837 bytes; PackBits
    /// repeats a byte 128 times with 2 bytes; a zstd block of 4 bytes fills 128 KiB.
    pub(crate) fn max_ratio(self) -> u64 {
        match self {
            Self::None => 1,
            Self::Lzw => 2_560,
            Self::Deflate => 1_032,
            Self::PackBits => 64,
            Self::Zstd => 32_768,
        }
    }
}

/// What the values of a page of one channel or of colours show.
pub(crate) fn shown(page: &Directory, sample: Sample, bits: u16) -> Result<Shown, String> {
    let code = page.uint(Tag::PhotometricInterpretation)?.unwrap_or(1);
    Ok(match (code, page.uints(Tag::ColorMap)?) {
        (3, Some(map)) => {
            // Some programs write 8 bits of each colour instead of 16.
            let shift = if map.iter().all(|n| *n < 256) { 0 } else { 8 };
            let third = map.len() / 3;
            let colour = |i| [0, 1, 2].map(|c| (map[c * third + i] >> shift) as u8);
            Shown::opaque((0..third).map(colour))
        }
        (0 | 1, _) if sample == Sample::U8 => Shown::grey(bits, code == 0),
        (code, _) => Shown::Other(code),
    })
}

/// Sample type after unpacking, stored bits, channels.
pub(crate) fn sample_of(page: &Directory) -> Result<(Sample, u16, usize), String> {
    let channels = page.uint(Tag::SamplesPerPixel)?.unwrap_or(1) as usize;
    if ![1, 3].contains(&channels) {
        return Err(format!(
            "it has {channels} samples per pixel; accepted are 1 and 3 (R:G:B)"
        ));
    }
    let uniform = |tag: Tag, default| match page.uints(tag)? {
        None => Ok(default),
        Some(values) => match values.first() {
            Some(&first) if values.iter().all(|v| *v == first) => Ok(first),
            _ => Err(format!("tag {} differs between its channels", tag.to_u16())),
        },
    };
    let bits = uniform(Tag::BitsPerSample, 1)?;
    let (letter, kind) = match uniform(Tag::SampleFormat, 1)? {
        1 | 4 => ("u", "unsigned"),
        2 => ("i", "signed"),
        3 => ("f", "floating-point"),
        _ => ("", "unsigned"),
    };
    let sample = match (letter, bits) {
        ("u", 1 | 2 | 4) if channels == 1 => Some(Sample::U8),
        _ => Sample::named(&format!("{letter}{bits}")),
    };
    let sample = sample.ok_or_else(|| {
        format!(
            "its samples are {kind} of {bits} bits; accepted are unsigned of 1, 2, 4, 8, 16, 32 and 64, signed of 8 to 64, floats of 32 and 64 bits"
        )
    })?;
    if channels == 3 && page.uint(Tag::PhotometricInterpretation)? == Some(6) {
        return Err("its colours are YCbCr, which does not keep labels; accepted is RGB".into());
    }
    Ok((sample, bits as u16, channels))
}

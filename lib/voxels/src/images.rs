//! Slices as BMP, PNG and JPEG, a file for each page.

use std::io::{BufRead, BufReader, Seek};
use std::iter;
use std::sync::Arc;

use image::codecs::jpeg::JpegDecoder;
use image::{ColorType, ImageDecoder};

use crate::colours::Shown;
use crate::sample::{PageFormat, Sample, swap_bytes, unpack_bits};
use crate::source::Source;
use crate::{Error, bmp, colours};

/// What a file of one page is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum ImageFormat {
    Bmp,
    Png,
    Jpeg,
}

impl ImageFormat {
    fn of(head: &[u8]) -> Option<Self> {
        match head {
            [b'B', b'M', _, _, _, _, 0, 0, 0, 0, ..] => Some(ImageFormat::Bmp),
            [0x89, b'P', b'N', b'G', b'\r', b'\n', 0x1a, b'\n', ..] => Some(ImageFormat::Png),
            [0xff, 0xd8, 0xff, ..] => Some(ImageFormat::Jpeg),
            _ => None,
        }
    }
}

pub(crate) fn is_image(head: &[u8]) -> bool {
    ImageFormat::of(head).is_some()
}

/// Images that make the pages of a stack.
#[derive(Debug)]
pub(crate) struct ImagePages {
    sources: Vec<Source>,
    format: PageFormat,
    shown: Vec<Arc<Shown>>,
    lossy: bool,
}

/// Opens images of one page each, in this order.
///
/// # Errors
/// A file that is none of the three, has transparency, or is of another size or type than the
/// first.
pub(crate) fn open(sources: Vec<Source>) -> Result<ImagePages, Error> {
    let mut format: Option<PageFormat> = None;
    let mut shown: Vec<Arc<Shown>> = Vec::new();
    let mut lossy = false;
    for (i, source) in sources.iter().enumerate() {
        let (own, colours) = read(source, None).map_err(|what| Error::file(source, what))?;
        let head = source.window(0, 16).map_err(|e| Error::io(source, e))?;
        lossy |= ImageFormat::of(&head) == Some(ImageFormat::Jpeg);
        let first = *format.get_or_insert(own);
        if own != first {
            let what =
                format!("it is {own} but page 1 is {first}; the pages of a stack must be alike");
            return Err(Error::page(source, i, what));
        }
        let same = shown.last().filter(|last| ***last == colours).cloned();
        shown.push(same.unwrap_or_else(|| Arc::new(colours)));
    }
    match format {
        Some(format) => Ok(ImagePages {
            sources,
            format,
            shown,
            lossy,
        }),
        None => Err(Error::Usage("no stack is given".into())),
    }
}

impl ImagePages {
    pub(crate) fn len(&self) -> usize {
        self.sources.len()
    }

    pub(crate) fn format(&self) -> PageFormat {
        self.format
    }

    pub(crate) fn shown(&self) -> Vec<Arc<Shown>> {
        self.shown.clone()
    }

    /// Whether their compression changes values.
    pub(crate) fn lossy(&self) -> bool {
        self.lossy
    }

    pub(crate) fn sources(&self) -> &[Source] {
        &self.sources
    }

    /// Page `z` as it stands in messages.
    pub(crate) fn page_name(&self, z: usize) -> String {
        format!("{}, page {} of {}", self.sources[z], z + 1, self.len())
    }

    pub(crate) fn read(&self, z: usize, page: &mut Vec<u8>) -> Result<(), Error> {
        let Some(source) = self.sources.get(z) else {
            return Err(Error::Usage(format!("there is no page {}", z + 1)));
        };
        let wrong = |what| Error::page(source, z, what);
        let (format, _) = read(source, Some(page)).map_err(wrong)?;
        match format == self.format {
            true => Ok(()),
            false => Err(wrong("it has changed since the stack was opened".into())),
        }
    }
}

/// The format of an image and what its values show; its pixels are read where there is a `page` for them.
fn read(source: &Source, page: Option<&mut Vec<u8>>) -> Result<(PageFormat, Shown), String> {
    let head = source.window(0, 16).map_err(|e| e.to_string())?;
    let kind = ImageFormat::of(&head).ok_or("it is no BMP, PNG or JPEG as the other slices are")?;
    let content = source.reader_from(0).map_err(|e| e.to_string())?;
    let content = BufReader::new(content);
    let said = |e: image::ImageError| e.to_string();
    match kind {
        ImageFormat::Bmp => bmp::read(source, page),
        ImageFormat::Jpeg if page.is_some() && !ends_as_jpeg(source)? => {
            Err("its last scan has no end: it is truncated".into())
        }
        ImageFormat::Jpeg => decoded(JpegDecoder::new(content).map_err(said)?, page),
        ImageFormat::Png => png(content, page),
    }
}

/// Whether the last scan of a JPEG is followed by its end. The decoder makes up what is missing; within a scan
/// neither of the two markers can stand.
fn ends_as_jpeg(source: &Source) -> Result<bool, String> {
    const SCAN: [u8; 2] = [0xff, 0xda];
    const END: [u8; 2] = [0xff, 0xd9];
    let bytes = source.window(0, source.len() as usize);
    let bytes = bytes.map_err(|e| e.to_string())?;
    let last = |marker: [u8; 2]| bytes.windows(2).rposition(|pair| pair == marker);
    Ok(last(END) > last(SCAN))
}

fn decoded(
    decoder: impl ImageDecoder,
    page: Option<&mut Vec<u8>>,
) -> Result<(PageFormat, Shown), String> {
    let (width, height) = decoder.dimensions();
    let channels = match decoder.color_type() {
        ColorType::L8 => 1,
        ColorType::Rgb8 => 3,
        other => return Err(pixels_refused(&format!("{other:?}"))),
    };
    let format = format_of(width, height, Sample::U8, channels)?;
    if let Some(page) = page {
        page.resize(format.page_bytes().unwrap_or(0), 0);
        decoder.read_image(page).map_err(|e| e.to_string())?;
    }
    Ok((
        format,
        if channels == 1 {
            Shown::GREY
        } else {
            Shown::RGB
        },
    ))
}

/// Stored samples as they are: no palette, no gamma, no scaling of fewer than 8 bits.
fn png(
    content: impl BufRead + Seek,
    page: Option<&mut Vec<u8>>,
) -> Result<(PageFormat, Shown), String> {
    let mut decoder = png::Decoder::new(content);
    decoder.set_transformations(png::Transformations::IDENTITY);
    let mut reader = decoder.read_info().map_err(|e| e.to_string())?;
    let info = reader.info();
    let (width, height) = info.size();
    let (color, depth) = (info.color_type, info.bit_depth);
    if let Some(frames) = (info.animation_control)
        .map(|a| a.num_frames)
        .filter(|n| *n > 1)
    {
        return Err(format!(
            "it is an animation of {frames} frames; accepted is one image a file: save each frame as a slice"
        ));
    }
    let channels = match color {
        png::ColorType::Grayscale | png::ColorType::Indexed => 1,
        png::ColorType::Rgb => 3,
        other => return Err(pixels_refused(&format!("{other:?}"))),
    };
    let sample = match depth {
        png::BitDepth::Sixteen => Sample::U16,
        _ => Sample::U8,
    };
    let format = format_of(width, height, sample, channels)?;
    let shown = png_shown(info);
    let Some(page) = page else {
        return Ok((format, shown));
    };
    let stored = reader.output_buffer_size().ok_or("it is too large")?;
    page.resize(stored, 0);
    reader.next_frame(page).map_err(|e| e.to_string())?;
    match depth {
        png::BitDepth::Sixteen if cfg!(target_endian = "little") => swap_bytes(page, 2),
        png::BitDepth::Sixteen | png::BitDepth::Eight => {}
        bits => {
            let bits = bits as usize;
            let rows = page.chunks_exact((format.width * bits).div_ceil(8).max(1));
            *page = rows
                .take(format.height)
                .flat_map(|row| unpack_bits(row, bits, format.width))
                .collect();
        }
    }
    Ok((format, shown))
}

fn png_shown(info: &png::Info) -> Shown {
    let colours = info.palette.as_deref().unwrap_or_default();
    let opacity = info.trns.as_deref().unwrap_or_default();
    let opacity = opacity.iter().copied().chain(iter::repeat(colours::OPAQUE));
    match (info.color_type, info.bit_depth as u16) {
        (png::ColorType::Rgb, _) => Shown::RGB,
        (png::ColorType::Indexed, _) => Shown::Palette(
            (colours.as_chunks().0.iter().zip(opacity))
                .map(|([r, g, b], opacity)| [*r, *g, *b, opacity])
                .collect(),
        ),
        (_, 16) => Shown::GREY,
        (_, bits) => Shown::Grey {
            bits,
            inverted: false,
        },
    }
}

fn format_of(
    width: u32,
    height: u32,
    sample: Sample,
    channels: usize,
) -> Result<PageFormat, String> {
    let format = PageFormat {
        width: width as usize,
        height: height as usize,
        sample,
        channels,
    };
    let counted = format.page_bytes().is_some_and(|n| n > 0);
    counted
        .then_some(format)
        .ok_or_else(|| format!("it is {format}, which is no page"))
}

fn pixels_refused(found: &str) -> String {
    format!(
        "its pixels are {found}; accepted are grey, palette and RGB: save it without transparency"
    )
}

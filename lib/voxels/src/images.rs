//! Slices as BMP, PNG and JPEG, a file for each page.

use std::io::Cursor;
use std::iter;
use std::sync::Arc;

use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

use crate::colours::{self, Shown};
use crate::error::damaged;
use crate::kind::Kind;
use crate::sample::{PageFormat, Sample, to_native, unpack_bits};
use crate::source::Source;
use crate::volume::{Pixels, Volume};
use crate::{Error, bmp};

/// The format of an image and what its values show, or what is wrong with it.
pub(crate) type Read = Result<(PageFormat, Shown), Box<dyn std::error::Error>>;

/// Opens images of one page each, in this order; all have the size and type of the first.
pub(crate) fn open(sources: Vec<Source>) -> Result<Volume, Error> {
    let mut format: Option<PageFormat> = None;
    let mut shown: Vec<Arc<Shown>> = Vec::new();
    let mut lossy = false;
    for (i, source) in sources.iter().enumerate() {
        let (kind, own, colours) = read(source, None).map_err(|what| Error::file(source, what))?;
        lossy |= kind == Kind::Jpeg;
        let first = *format.get_or_insert(own);
        if own != first {
            let what =
                format!("it is {own} but page 1 is {first}; the pages of a stack must be alike");
            return Err(Error::page(source, i, what));
        }
        let same = shown.last().filter(|last| ***last == colours).cloned();
        shown.push(same.unwrap_or_else(|| Arc::new(colours)));
    }
    let format = format.ok_or_else(|| Error::Usage("no stack is given".into()))?;
    Ok(Volume {
        format,
        pages: sources.len(),
        voxel_size: None,
        shown,
        source_of: (0..sources.len()).collect(),
        lossy,
        copies: 3,
        pixels: Box::new(Images),
        sources,
    })
}

#[derive(Debug)]
struct Images;

impl Pixels for Images {
    fn read(&self, volume: &Volume, z: usize, page: &mut Vec<u8>) -> Result<(), Error> {
        let wrong = |what| Error::page(&volume.sources[z], z, what);
        match read(&volume.sources[z], Some(page)).map_err(wrong)? {
            (_, format, _) if format == volume.format => Ok(()),
            _ => Err(wrong("it has changed since the stack was opened".into())),
        }
    }
}

/// What an image is; its pixels are read where there is a `page` for them.
fn read(
    source: &Source,
    page: Option<&mut Vec<u8>>,
) -> Result<(Kind, PageFormat, Shown), Box<dyn std::error::Error>> {
    let kind = Kind::of(&source.window(0, 16)?).filter(|kind| kind.is_image());
    let kind = kind.ok_or("it is no BMP, PNG or JPEG as the other slices are")?;
    let (format, shown) = match kind {
        Kind::Bmp => bmp::read(source, page)?,
        Kind::Png => png(&source.window(0, source.len() as usize)?, page)?,
        _ => jpeg(&source.window(0, source.len() as usize)?, page)?,
    };
    Ok((kind, format, shown))
}

/// Brightness: colours that its compression has changed are no labels.
fn jpeg(bytes: &[u8], page: Option<&mut Vec<u8>>) -> Read {
    if page.is_some() && !ends_as_jpeg(bytes) {
        return Err("its last scan has no end: it is truncated".into());
    }
    let options = DecoderOptions::default().set_strict_mode(false);
    let options = options.set_max_width(usize::MAX).set_max_height(usize::MAX);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    decoder.decode_headers().map_err(damaged)?;
    let info = decoder.info().ok_or("it has no frame")?;
    let size = [info.width.into(), info.height.into()];
    let format = format_of(size, Sample::U8, 1)?;
    if let Some(page) = page {
        decoder.set_options(options.jpeg_set_out_colorspace(ColorSpace::Luma));
        page.resize(format.page_bytes().unwrap_or(0), 0);
        decoder.decode_into(page).map_err(damaged)?;
    }
    Ok((format, Shown::GREY))
}

/// Whether the last scan of a JPEG is followed by its end. The decoder makes up what is missing; within a scan
/// neither of the two markers can stand.
fn ends_as_jpeg(bytes: &[u8]) -> bool {
    const SCAN: [u8; 2] = [0xff, 0xda];
    const END: [u8; 2] = [0xff, 0xd9];
    let last = |marker: [u8; 2]| bytes.windows(2).rposition(|pair| pair == marker);
    last(END) > last(SCAN)
}

/// Stored samples as they are: no palette, no gamma, no scaling of fewer than 8 bits.
fn png(bytes: &[u8], page: Option<&mut Vec<u8>>) -> Read {
    let mut decoder = png::Decoder::new(Cursor::new(bytes));
    decoder.set_transformations(png::Transformations::IDENTITY);
    let mut reader = decoder.read_info().map_err(damaged)?;
    let info = reader.info();
    let (width, height) = info.size();
    let frames = info.animation_control.map_or(1, |a| a.num_frames);
    if frames > 1 {
        return Err(format!(
            "it is an animation of {frames} frames; accepted is one image a file: save each frame as a slice"
        )
        .into());
    }
    let channels = match info.color_type {
        png::ColorType::Grayscale | png::ColorType::Indexed => 1,
        png::ColorType::Rgb => 3,
        other => return pixels_refused(other),
    };
    let bits = info.bit_depth as usize;
    let sample = if bits == 16 { Sample::U16 } else { Sample::U8 };
    let format = format_of([width, height], sample, channels)?;
    let shown = png_shown(info);
    let Some(page) = page else {
        return Ok((format, shown));
    };
    page.resize(reader.output_buffer_size().ok_or("it is too large")?, 0);
    reader.next_frame(page).map_err(damaged)?;
    to_native(page, sample, true);
    if bits < 8 {
        let rows = page.chunks_exact((format.width * bits).div_ceil(8).max(1));
        let rows = rows.take(format.height);
        *page = (rows.flat_map(|row| unpack_bits(row, bits, format.width))).collect();
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
        (_, bits) => Shown::grey(bits, false),
    }
}

fn format_of(size: [u32; 2], sample: Sample, channels: usize) -> Result<PageFormat, String> {
    let format = PageFormat::new(size.map(|n| n as usize), sample, channels);
    match format.page_bytes() {
        Some(1..) => Ok(format),
        _ => Err(format!("it is {format}, which is no page")),
    }
}

fn pixels_refused(found: impl std::fmt::Debug) -> Read {
    Err(format!(
        "its pixels are {found:?}; accepted are grey, palette and RGB: save it without transparency"
    )
    .into())
}

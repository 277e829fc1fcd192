use std::fmt::Write as _;

use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontTransform, TextStyle};

use crate::drawing::{Anchor, Drawing, Image, Item, Point};
use crate::{Error, text};

/// Units of the SVG per logical pixel: the backend writes whole numbers.
const SVG_SCALE: u32 = 8;
/// Pixels along the longer edge of a picture inside the SVG: small ones are enlarged, because
/// not every viewer knows `image-rendering` and the others would smooth the voxels away.
const SVG_IMAGE: usize = 900;
/// Pixels of the PNG per logical pixel.
const PNG_SCALE: u32 = 2;
/// The PNG is drawn this much larger and averaged, because the bitmap backend does not smooth
/// the edges of thick lines and polygons.
const SUPERSAMPLING: u32 = 2;
/// Family name in an SVG; viewers put their own sans-serif in its place.
const FAMILY: &str = "sans-serif";

impl Drawing {
    /// The drawing as an SVG document.
    ///
    /// # Errors
    /// [`Error::Draw`] with the backend's reason.
    pub fn to_svg(&self) -> Result<String, Error> {
        let mut text = String::new();
        let (width, height) = (self.width * SVG_SCALE, self.height * SVG_SCALE);
        {
            let mut backend = SVGBackend::with_string(&mut text, (width, height));
            replay(self, &mut backend, f64::from(SVG_SCALE), svg_text)?;
        }
        // The backend cannot scale or embed pictures: the opening tag is written anew, and
        // the white ground and the pictures come right after it.
        let end_of_tag = text
            .find("<svg")
            .and_then(|start| text[start..].find('>').map(|end| start + end + 1))
            .ok_or_else(|| Error::Draw("the SVG backend wrote no <svg> element".into()))?;
        let mut head = format!(
            "<svg width=\"{}\" height=\"{}\" viewBox=\"0 0 {width} {height}\" \
             xmlns=\"http://www.w3.org/2000/svg\">\n\
             <rect width=\"100%\" height=\"100%\" fill=\"#FFFFFF\"/>",
            self.width, self.height
        );
        for image in &self.images {
            let [x, y, width, height] = image.place.map(|s| s * f64::from(SVG_SCALE));
            let image = enlarged(image);
            let [columns, rows] = image.size.map(|n| n as u32);
            let data = base64(&encode_png(&image.rgb, columns, rows)?);
            let _ = write!(
                head,
                "\n<image x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" \
                 preserveAspectRatio=\"none\" image-rendering=\"pixelated\" \
                 href=\"data:image/png;base64,{data}\"/>"
            );
        }
        text.replace_range(..end_of_tag, &head);
        Ok(text)
    }

    /// The drawing as a PNG file, two pixels per logical pixel.
    ///
    /// # Errors
    /// [`Error::Draw`] with the backend's reason.
    pub fn to_png(&self) -> Result<Vec<u8>, Error> {
        let scale = PNG_SCALE * SUPERSAMPLING;
        let (width, height) = (self.width * scale, self.height * scale);
        let mut pixels = vec![255_u8; (width * height * 3) as usize];
        for image in &self.images {
            blit(image, &mut pixels, width as usize, f64::from(scale));
        }
        {
            let mut backend = BitMapBackend::with_buffer(&mut pixels, (width, height));
            replay(self, &mut backend, f64::from(scale), text::draw)?;
        }
        let averaged = average(&pixels, width as usize);
        encode_png(&averaged, width / SUPERSAMPLING, height / SUPERSAMPLING)
    }
}

/// Draws all but the images; `text_at` draws a text at a pixel with an anchor in a size.
fn replay<B: DrawingBackend>(
    drawing: &Drawing,
    backend: &mut B,
    scale: f64,
    text_at: fn(&mut B, &str, Point, Anchor, f64) -> Result<(), Error>,
) -> Result<(), Error> {
    let pixel = |p: &[f64; 2]| ((p[0] * scale).round() as i32, (p[1] * scale).round() as i32);
    for item in &drawing.items {
        match item {
            Item::Line {
                points,
                colour,
                width,
            } => {
                let style = colour.stroke_width((width * scale).round().max(1.0) as u32);
                backend
                    .draw_path(points.iter().map(pixel), &style)
                    .map_err(failed)?;
            }
            Item::Area { points, colour } => backend
                .fill_polygon(points.iter().map(pixel), colour)
                .map_err(failed)?,
            Item::Text {
                text,
                at,
                anchor,
                size,
            } => text_at(backend, text, at.map(|x| x * scale), *anchor, size * scale)?,
        }
    }
    backend.present().map_err(failed)
}

fn svg_text(
    backend: &mut SVGBackend,
    text: &str,
    at: Point,
    anchor: Anchor,
    size: f64,
) -> Result<(), Error> {
    let [x, y] = at.map(|x| x.round() as i32);
    backend
        .draw_text(text, &text_style(anchor, size), (x, y))
        .map_err(failed)
}

fn failed(error: impl std::fmt::Display) -> Error {
    Error::Draw(error.to_string())
}

fn text_style(anchor: Anchor, size: f64) -> TextStyle<'static> {
    let mut font = FontDesc::new(FontFamily::Name(FAMILY), size, FontStyle::Normal);
    if anchor == Anchor::Upwards {
        font = font.transform(FontTransform::Rotate270);
    }
    let across = match anchor {
        Anchor::Left => HPos::Left,
        Anchor::Centre | Anchor::Upwards => HPos::Center,
        Anchor::Right => HPos::Right,
    };
    TextStyle::from(font).pos(Pos::new(across, VPos::Center))
}

/// The image with each pixel repeated until it has about `SVG_IMAGE` along its longer edge.
fn enlarged(image: &Image) -> Image {
    let [columns, rows] = image.size;
    let factor = SVG_IMAGE.div_ceil(columns.max(rows));
    let size = [columns * factor, rows * factor];
    let mut rgb = vec![0; 3 * size[0] * size[1]];
    let place = [0.0, 0.0, size[0] as f64, size[1] as f64];
    let whole = Image {
        place,
        ..image.clone()
    };
    blit(&whole, &mut rgb, size[0], 1.0);
    Image { size, rgb, place }
}

/// Copies an image into its place, nearest pixel.
fn blit(image: &Image, pixels: &mut [u8], stride: usize, scale: f64) {
    let [left, top, width, height] = image.place.map(|s| (s * scale).round() as usize);
    let [columns, rows] = image.size;
    for y in 0..height {
        let row = y * rows / height;
        for x in 0..width {
            let from = 3 * (row * columns + x * columns / width);
            let to = 3 * ((top + y) * stride + left + x);
            pixels[to..to + 3].copy_from_slice(&image.rgb[from..from + 3]);
        }
    }
}

/// Mean of each block of `SUPERSAMPLING` squared pixels.
fn average(pixels: &[u8], width: usize) -> Vec<u8> {
    let block = SUPERSAMPLING as usize;
    let mut averaged = Vec::with_capacity(pixels.len() / (block * block));
    for rows in pixels.chunks(3 * width * block) {
        for x in 0..width / block {
            for channel in 0..3 {
                let value = |i: usize| {
                    let (dx, dy) = (i % block, i / block);
                    u32::from(rows[3 * (dy * width + x * block + dx) + channel])
                };
                let sum: u32 = (0..block * block).map(value).sum();
                averaged.push((sum / (block * block) as u32) as u8);
            }
        }
    }
    averaged
}

fn encode_png(rgb: &[u8], width: u32, height: u32) -> Result<Vec<u8>, Error> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header().map_err(failed)?;
    writer.write_image_data(rgb).map_err(failed)?;
    writer.finish().map_err(failed)?;
    Ok(bytes)
}

/// RFC 4648 base 64, for pictures inside SVG.
fn base64(bytes: &[u8]) -> String {
    const ALPHABET: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for group in bytes.chunks(3) {
        let bits = (0..3).fold(0_u32, |bits, i| {
            bits << 8 | u32::from(group.get(i).copied().unwrap_or(0))
        });
        for digit in 0..4 {
            if digit <= group.len() {
                text.push(char::from(
                    ALPHABET[(bits >> (18 - 6 * digit) & 63) as usize],
                ));
            } else {
                text.push('=');
            }
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_of_the_rfc() {
        for (plain, coded) in [
            ("", ""),
            ("f", "Zg=="),
            ("fo", "Zm8="),
            ("foo", "Zm9v"),
            ("foob", "Zm9vYg=="),
            ("foobar", "Zm9vYmFy"),
        ] {
            assert_eq!(base64(plain.as_bytes()), coded);
        }
    }

    #[test]
    fn an_image_fills_its_place_and_no_more() {
        let mut drawing = Drawing::new(40, 30);
        drawing.images.push(Image {
            place: [10.0, 5.0, 20.0, 10.0],
            size: [2, 1],
            rgb: vec![255, 0, 0, 0, 0, 255],
        });
        let bytes = drawing.to_png().unwrap();
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes))
            .read_info()
            .unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut pixels).unwrap();
        assert_eq!((info.width, info.height), (80, 60));
        let at = |x: usize, y: usize| &pixels[3 * (80 * y + x)..][..3];
        assert_eq!(at(20, 10), [255, 0, 0]);
        assert_eq!(at(59, 29), [0, 0, 255]);
        assert_eq!(at(39, 29), [255, 0, 0]);
        assert_eq!(at(19, 15), [255, 255, 255]);
        assert_eq!(at(60, 15), [255, 255, 255]);
        assert_eq!(at(30, 30), [255, 255, 255]);
    }
}

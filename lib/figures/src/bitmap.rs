//! Drawings as PNG.

use plotters::prelude::*;

use crate::drawing::{Drawing, Image};
use crate::replay::{failed, replay};
use crate::{Error, text};

/// A PNG is drawn this much larger and averaged, because the bitmap backend does not smooth
/// the edges of thick lines and polygons.
pub(crate) const SUPERSAMPLING: usize = 2;
/// Pixels along the longer edge of a picture inside an SVG or PDF: small ones are enlarged,
/// because not every viewer shows pixels as they are and the others would smooth the voxels away.
const SMALLEST: usize = 900;
/// Most pixels of a PNG; drawing takes twelve bytes of memory for each.
const MOST_PIXELS: f64 = 48e6;

impl Drawing {
    /// The drawing as a PNG file in the dots per inch of its page.
    ///
    /// # Errors
    /// [`Error::Request`] for a picture of too many pixels, [`Error::Draw`] with the backend's
    /// reason.
    pub fn to_png(&self) -> Result<Vec<u8>, Error> {
        let (pixels, size) = self.pixels()?;
        encode(&pixels, size, Some(self.page.dpi))
    }

    /// The drawing in the dots per inch of its page, row by row from the top, three bytes a pixel; pixels along x and y.
    pub(crate) fn pixels(&self) -> Result<(Vec<u8>, [usize; 2]), Error> {
        let size = [self.width, self.height].map(|edge| (edge * self.page.scale()).round());
        if size[0] * size[1] > MOST_PIXELS {
            return Err(Error::Request(format!(
                "a picture of {} x {} pixels is too large: at most {} million; ask for fewer dots per inch",
                size[0],
                size[1],
                MOST_PIXELS / 1e6
            )));
        }
        let size = size.map(|edge| edge.max(1.0) as usize);
        let [width, height] = size.map(|edge| edge * SUPERSAMPLING);
        let scale = width as f64 / self.width;
        let mut pixels = vec![255_u8; width * height * 3];
        for image in &self.images {
            let [left, top, wide, high] = image.place.map(|s| (s * scale).round() as usize);
            blit(image, [[left, wide], [top, high]], &mut pixels, width);
        }
        {
            let edges = (width as u32, height as u32);
            let mut backend = BitMapBackend::with_buffer(&mut pixels, edges);
            replay(self, &mut backend, scale, text::draw)?;
        }
        Ok((average(&pixels, width), size))
    }
}

impl Image {
    /// The image with each pixel repeated until it has about `SMALLEST` along its longer edge.
    pub(crate) fn enlarged(&self) -> Self {
        let [columns, rows] = self.size;
        let factor = (SMALLEST / columns.max(rows)).max(1);
        let size = [columns * factor, rows * factor];
        let mut rgb = vec![0; 3 * size[0] * size[1]];
        blit(self, size.map(|n| [0, n]), &mut rgb, size[0]);
        Self {
            size,
            rgb,
            place: self.place,
        }
    }
}

/// Copies an image into columns and rows (the first and how many) of pixels, nearest pixel.
fn blit(image: &Image, place: [[usize; 2]; 2], pixels: &mut [u8], stride: usize) {
    let [[left, width], [top, height]] = place;
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

/// Mean of each block of [`SUPERSAMPLING`] squared pixels.
pub(crate) fn average(pixels: &[u8], width: usize) -> Vec<u8> {
    let block = SUPERSAMPLING;
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

/// Pixels as a PNG file, with its dots per inch if they mean something.
pub(crate) fn encode(rgb: &[u8], size: [usize; 2], dpi: Option<f64>) -> Result<Vec<u8>, Error> {
    let mut bytes = Vec::new();
    let encoder = encoder(&mut bytes, size, dpi);
    let mut writer = encoder.write_header().map_err(failed)?;
    writer.write_image_data(rgb).map_err(failed)?;
    writer.finish().map_err(failed)?;
    Ok(bytes)
}

/// Of a PNG file of so many pixels along x and y.
pub(crate) fn encoder(
    bytes: &mut Vec<u8>,
    size: [usize; 2],
    dpi: Option<f64>,
) -> png::Encoder<'static, &mut Vec<u8>> {
    let [width, height] = size.map(|edge| edge as u32);
    let mut encoder = png::Encoder::new(bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    if let Some(dpi) = dpi {
        let per_metre = (dpi / 0.0254).round() as u32;
        encoder.set_pixel_dims(Some(png::PixelDimensions {
            xppu: per_metre,
            yppu: per_metre,
            unit: png::Unit::Meter,
        }));
    }
    encoder
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::page::Page;

    #[test]
    fn an_image_fills_its_place_and_no_more() {
        let mut drawing = Drawing::new(Page::default(), 40.0, 30.0);
        drawing.images.push(Image {
            place: [10.0, 5.0, 20.0, 10.0],
            size: [2, 1],
            rgb: vec![255, 0, 0, 0, 0, 255],
        });
        let (pixels, size) = drawing.pixels().unwrap();
        assert_eq!(size, [80, 60]);
        let at = |x: usize, y: usize| &pixels[3 * (80 * y + x)..][..3];
        for (x, y) in [(20, 10), (39, 29)] {
            assert_eq!(at(x, y), [255, 0, 0]);
        }
        assert_eq!(at(59, 29), [0, 0, 255]);
        for (x, y) in [(19, 15), (60, 15), (30, 30)] {
            assert_eq!(at(x, y), [255, 255, 255]);
        }
    }
}

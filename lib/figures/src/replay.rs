//! Drawings onto the backends of plotters.

use plotters::prelude::*;

use crate::Error;
use crate::drawing::{Anchor, Drawing, Item, Point};

/// Draws all but the images; `text_at` draws a text at a pixel with an anchor in a size.
pub(crate) fn replay<B: DrawingBackend>(
    drawing: &Drawing,
    backend: &mut B,
    scale: f64,
    text_at: fn(&mut B, &str, Point, Anchor, f64) -> Result<(), Error>,
) -> Result<(), Error> {
    let pixel = |p: &[f64; 2]| ((p[0] * scale).round() as i32, (p[1] * scale).round() as i32);
    for item in &drawing.items {
        match item {
            Item::Line(points, colour, width) => {
                let style = colour.stroke_width((width * scale).round().max(1.0) as u32);
                // One by one: the corner of two is drawn far beyond them where they turn sharply.
                for ends in points.windows(2) {
                    backend
                        .draw_path(ends.iter().map(pixel), &style)
                        .map_err(failed)?;
                }
            }
            Item::Area(points, colour) => backend
                .fill_polygon(points.iter().map(pixel), colour)
                .map_err(failed)?,
            Item::Text(text, at, anchor, size) => {
                text_at(backend, text, at.map(|x| x * scale), *anchor, size * scale)?;
            }
        }
    }
    backend.present().map_err(failed)
}

pub(crate) fn failed(error: impl std::fmt::Display) -> Error {
    Error::Draw(error.to_string())
}

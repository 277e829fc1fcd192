//! Text as pixels.

use ab_glyph_rasterizer::{Point as Place, Rasterizer, point};
use plotters::backend::DrawingBackend;
use plotters::style::{Color, RGBAColor};
use skrifa::instance::{LocationRef, Size};
use skrifa::outline::DrawSettings;
use skrifa::outline::pen::PathElement;
use skrifa::{FontRef, GlyphId, MetadataProvider};

use crate::Error;
use crate::drawing::{Anchor, Point};
use crate::measure::EM;
use crate::replay::failed;

/// Draws black text of the embedded DejaVu Sans on pixels: lines of glyphs as they stand in
/// the font, without kerning. Capitals and figures are centred on `at`.
///
/// # Errors
/// [`Error::Draw`] when the font or the backend refuses.
pub(crate) fn draw<B: DrawingBackend>(
    backend: &mut B,
    text: &str,
    at: Point,
    anchor: Anchor,
    size: f64,
) -> Result<(), Error> {
    let font = FontRef::new(dejavu::sans::regular()).map_err(failed)?;
    let em = (EM * size) as f32;
    let (size, place) = (Size::new(em), LocationRef::default());
    let (metrics, advances) = (font.metrics(size, place), font.glyph_metrics(size, place));
    // What the font lacks is drawn as its glyph 0, a box.
    let glyphs: Vec<GlyphId> = (text.chars())
        .map(|c| font.charmap().map(c).unwrap_or(GlyphId::NOTDEF))
        .collect();
    let advance = |&glyph| advances.advance_width(glyph).unwrap_or(0.0);
    let length = glyphs.iter().map(advance).sum::<f32>();
    // Glyphs may reach beyond their advance and the line's height: an em is enough.
    let (margin, baseline) = (em, metrics.ascent + em);
    let edges = [length + 2.0 * margin, baseline + em - metrics.descent];
    let [columns, rows] = edges.map(|edge| edge.ceil() as usize);
    // The share of each pixel that they cover.
    let mut ink = Rasterizer::new(columns, rows);
    let outlines = font.outline_glyphs();
    let mut x = margin;
    for glyph in &glyphs {
        if let Some(outline) = outlines.get(*glyph) {
            let mut path: Vec<PathElement> = Vec::new();
            let settings = DrawSettings::unhinted(size, place);
            outline.draw(settings, &mut path).map_err(failed)?;
            trace(&mut ink, &path, point(x, baseline));
        }
        x += advance(glyph);
    }
    let capitals = metrics.cap_height.unwrap_or(0.73 * em);
    let start = anchor.before() as f32 * length;
    let [left, top] = [start + margin, baseline - 0.5 * capitals];
    let origin = at.map(|x| x.round() as i32);
    let [left, top] = [left, top].map(|x| x.round() as i32);
    let (width, height) = backend.get_size();
    let mut failure = None;
    ink.for_each_pixel_2d(|column, row, cover| {
        let [right, down] = [column as i32 - left, row as i32 - top];
        let [x, y] = match anchor {
            Anchor::Upwards => [origin[0] + down, origin[1] - right - 1],
            _ => [origin[0] + right, origin[1] + down],
        };
        let inside = (0..width as i32).contains(&x) && (0..height as i32).contains(&y);
        if inside && cover > 0.0 && failure.is_none() {
            let shade = RGBAColor(0, 0, 0, f64::from(cover.min(1.0))).to_backend_color();
            failure = backend.draw_pixel((x, y), shade).err();
        }
    });
    failure.map_or(Ok(()), |e| Err(failed(e)))
}

/// Puts an outline, whose y points up from `origin`, among pixels, whose y points down.
fn trace(ink: &mut Rasterizer, path: &[PathElement], origin: Place) {
    let place = |x: f32, y: f32| point(origin.x + x, origin.y - y);
    let (mut start, mut last) = (origin, origin);
    for element in path {
        let from = last;
        match *element {
            PathElement::MoveTo { x, y } => {
                last = place(x, y);
                start = last;
            }
            PathElement::LineTo { x, y } => {
                last = place(x, y);
                ink.draw_line(from, last);
            }
            PathElement::QuadTo { cx0, cy0, x, y } => {
                last = place(x, y);
                ink.draw_quad(from, place(cx0, cy0), last);
            }
            PathElement::CurveTo {
                cx0,
                cy0,
                cx1,
                cy1,
                x,
                y,
            } => {
                last = place(x, y);
                ink.draw_cubic(from, place(cx0, cy0), place(cx1, cy1), last);
            }
            PathElement::Close => {
                ink.draw_line(from, start);
                last = start;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use plotters::backend::BitMapBackend;

    use super::*;

    const EDGE: u32 = 400;
    const SIZE: f64 = 62.0;

    /// Low and high corner of the ink, or none.
    fn ink(text: &str, at: Point, anchor: Anchor) -> Option<[[i32; 2]; 2]> {
        let mut pixels = vec![255_u8; (3 * EDGE * EDGE) as usize];
        {
            let mut backend = BitMapBackend::with_buffer(&mut pixels, (EDGE, EDGE));
            draw(&mut backend, text, at, anchor, SIZE).unwrap();
        }
        let places = (0..EDGE * EDGE)
            .filter(|i| pixels[3 * *i as usize] < 128)
            .map(|i| [(i % EDGE) as i32, (i / EDGE) as i32]);
        places.fold(None, |found, [x, y]| {
            let [[x0, y0], [x1, y1]] = found.unwrap_or([[x, y]; 2]);
            Some([[x0.min(x), y0.min(y)], [x1.max(x), y1.max(y)]])
        })
    }

    /// DejaVu Sans: a capital H is 0.729 em high and advances by 0.752 em, with 0.098 em of
    /// white on each side.
    #[test]
    fn a_capital_is_drawn_at_its_anchor() {
        let em = EM * SIZE;
        let near = |found: i32, expected: f64| (f64::from(found) - expected).abs() <= 1.5;
        let at = [200.0, 150.0];
        let high = 0.5 * 0.729 * em;
        for (anchor, start) in [
            (Anchor::Left, 0.0),
            (Anchor::Centre, -0.376 * em),
            (Anchor::Right, -0.752 * em),
        ] {
            let [low, end] = ink("H", at, anchor).unwrap();
            assert!(near(low[1], 150.0 - high) && near(end[1], 150.0 + high));
            let left = 200.0 + start;
            assert!(near(low[0], left + 0.098 * em), "{anchor:?}: {low:?}");
            assert!(near(end[0], left + 0.654 * em), "{anchor:?}: {end:?}");
        }
        let [low, end] = ink("H", at, Anchor::Upwards).unwrap();
        assert!(near(low[0], 200.0 - high) && near(end[0], 200.0 + high));
        assert!(near(low[1], 150.0 - 0.278 * em) && near(end[1], 150.0 + 0.278 * em));
    }

    #[test]
    fn text_that_the_font_lacks_or_the_picture_cuts_is_no_failure() {
        assert_eq!(ink("", [9.0; 2], Anchor::Left), None);
        assert!(ink("\u{4e2d}", [200.0; 2], Anchor::Left).is_some(), "a box");
        let far = ink(&"\u{2588}".repeat(40), [0.0, 0.0], Anchor::Centre).unwrap();
        assert_eq!((far[0], far[1][0]), ([0, 0], EDGE as i32 - 1));
    }
}

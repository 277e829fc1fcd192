//! Drawings as SVG.

use std::fmt::Write as _;

use base64::prelude::{BASE64_STANDARD, Engine as _};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{FontTransform, TextStyle};

use crate::Error;
use crate::bitmap::encode;
use crate::drawing::{Anchor, Drawing, Point};
use crate::page::millimetres;
use crate::replay::{failed, replay};

/// Units of the SVG per logical pixel: the backend writes whole numbers.
const SCALE: u32 = 8;
/// Families in an SVG, the first there is: none is much wider than the embedded one, by which
/// the room for texts is measured.
const FAMILIES: &str = "DejaVu Sans, Verdana, Arial, Helvetica, sans-serif";

/// The bytes in base 64, for pictures inside SVG and HTML.
pub fn base64(bytes: &[u8]) -> String {
    BASE64_STANDARD.encode(bytes)
}

impl Drawing {
    /// The drawing as an SVG document, as wide as its page says.
    ///
    /// # Errors
    /// [`Error::Draw`] with the backend's reason.
    pub fn to_svg(&self) -> Result<String, Error> {
        let mut text = String::new();
        let size = [self.width, self.height];
        let [width, height] = size.map(|edge| (edge * f64::from(SCALE)).round() as u32);
        {
            let mut backend = SVGBackend::with_string(&mut text, (width, height));
            replay(self, &mut backend, f64::from(SCALE), svg_text)?;
        }
        // The backend cannot scale or embed pictures: the opening tag is written anew, and
        // the white ground and the pictures come right after it.
        let end_of_tag = text
            .find("<svg")
            .and_then(|start| text[start..].find('>').map(|end| start + end + 1))
            .ok_or_else(|| Error::Draw("the SVG backend wrote no <svg> element".into()))?;
        let [wide, high] = size.map(|edge| match self.page.width_mm {
            Some(_) => format!("{:.2}mm", millimetres(edge)),
            None => format!("{edge:.0}"),
        });
        let mut head = format!(
            "<svg width=\"{wide}\" height=\"{high}\" viewBox=\"0 0 {width} {height}\" \
             xmlns=\"http://www.w3.org/2000/svg\">\n\
             <rect width=\"100%\" height=\"100%\" fill=\"#FFFFFF\"/>",
        );
        for image in &self.images {
            let [x, y, width, height] = image.place.map(|s| s * f64::from(SCALE));
            let image = image.enlarged();
            let data = base64(&encode(&image.rgb, image.size, None)?);
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
}

fn svg_text(
    backend: &mut SVGBackend,
    text: &str,
    at: Point,
    anchor: Anchor,
    size: f64,
) -> Result<(), Error> {
    let [x, y] = at.map(|x| x.round() as i32);
    let mut font = FontDesc::new(FontFamily::Name(FAMILIES), size, FontStyle::Normal);
    if anchor == Anchor::Upwards {
        font = font.transform(FontTransform::Rotate270);
    }
    let across = match anchor {
        Anchor::Left => HPos::Left,
        Anchor::Centre | Anchor::Upwards => HPos::Center,
        Anchor::Right => HPos::Right,
    };
    let style = TextStyle::from(font).pos(Pos::new(across, VPos::Center));
    backend.draw_text(text, &style, (x, y)).map_err(failed)
}

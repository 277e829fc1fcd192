//! Drawings as PDF: lines, areas and images as they are, text in the embedded font's own glyphs,
//! which can be searched and copied.

mod glyphs;

use std::collections::BTreeSet;
use std::io::Write as _;

use flate2::Compression;
use flate2::write::ZlibEncoder;
use pdf_writer::types::{LineCapStyle, LineJoinStyle};
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref, Str};
use plotters::style::RGBAColor;

use crate::Error;
use crate::colour::BLACK;
use crate::drawing::{Anchor, Drawing, Item, Point};
use crate::measure::EM;
use crate::page::millimetres;
use crate::replay::failed;
use glyphs::Glyphs;

const FONT: Name = Name(b"F");

/// Numbers of the document's objects; images and opacities follow.
const CATALOG: Ref = Ref::new(1);
const PAGES: Ref = Ref::new(2);
const PAGE: Ref = Ref::new(3);
const CONTENT: Ref = Ref::new(4);
const TYPE0: Ref = Ref::new(5);
const CID_FONT: Ref = Ref::new(6);
const DESCRIPTOR: Ref = Ref::new(7);
const FONT_FILE: Ref = Ref::new(8);
const UNICODE: Ref = Ref::new(9);
const NEXT: i32 = 10;

impl Drawing {
    /// The drawing as a PDF of one page of its printed size, without a date.
    ///
    /// # Errors
    /// [`Error::Draw`] where the embedded font cannot be read.
    pub fn to_pdf(&self) -> Result<Vec<u8>, Error> {
        let mut ink = Ink::new(self.height)?;
        for (i, image) in self.images.iter().enumerate() {
            let [x, y, width, height] = image.place;
            let [x, y] = ink.place(&[x, y + height]);
            let [width, height] = [width, height].map(points);
            ink.content.save_state();
            ink.content.transform([width, 0.0, 0.0, height, x, y]);
            ink.content.x_object(Name(format!("I{i}").as_bytes()));
            ink.content.restore_state();
        }
        for item in &self.items {
            ink.draw(item);
        }
        let mut pdf = Pdf::new();
        pdf.catalog(CATALOG).pages(PAGES);
        pdf.pages(PAGES).kids([PAGE]).count(1);
        self.page(&mut pdf, &ink.opacities);
        for (i, per_mille) in ink.opacities.iter().enumerate() {
            let alpha = f32::from(*per_mille) / 1000.0;
            let mut state = pdf.ext_graphics(self.opacity(i));
            state.non_stroking_alpha(alpha).stroking_alpha(alpha);
        }
        for (i, image) in self.images.iter().enumerate() {
            let image = image.enlarged();
            let data = packed(&image.rgb)?;
            let mut object = pdf.image_xobject(picture(i), &data);
            let [columns, rows] = image.size.map(|n| n as i32);
            object.filter(Filter::FlateDecode);
            object.width(columns).height(rows);
            object.color_space().device_rgb();
            object.bits_per_component(8);
        }
        ink.text.write(&mut pdf)?;
        let content = packed(&ink.content.finish())?;
        pdf.stream(CONTENT, &content).filter(Filter::FlateDecode);
        Ok(pdf.finish())
    }

    /// The page and what its content names: font, images, opacities.
    fn page(&self, pdf: &mut Pdf, opacities: &BTreeSet<u16>) {
        let mut page = pdf.page(PAGE);
        let [width, height] = [self.width, self.height].map(points);
        page.media_box(Rect::new(0.0, 0.0, width, height));
        page.parent(PAGES).contents(CONTENT);
        let mut resources = page.resources();
        resources.fonts().pair(FONT, TYPE0);
        let mut objects = resources.x_objects();
        for i in 0..self.images.len() {
            objects.pair(Name(format!("I{i}").as_bytes()), picture(i));
        }
        objects.finish();
        let mut graphics = resources.ext_g_states();
        for (i, per_mille) in opacities.iter().enumerate() {
            graphics.pair(Name(format!("G{per_mille}").as_bytes()), self.opacity(i));
        }
    }

    fn opacity(&self, i: usize) -> Ref {
        picture(self.images.len() + i)
    }
}

fn picture(i: usize) -> Ref {
    Ref::new(NEXT + i as i32)
}

/// A length in logical pixels, points.
fn points(pixels: f64) -> f32 {
    (millimetres(pixels) * 72.0 / 25.4) as f32
}

fn packed(bytes: &[u8]) -> Result<Vec<u8>, Error> {
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(bytes).map_err(failed)?;
    encoder.finish().map_err(failed)
}

/// What is drawn so far.
struct Ink {
    content: Content,
    /// Height of the drawing, logical pixels.
    height: f64,
    /// The opacities in use, per mille.
    opacities: BTreeSet<u16>,
    text: Glyphs,
}

impl Ink {
    fn new(height: f64) -> Result<Self, Error> {
        let mut content = Content::new();
        content.set_line_cap(LineCapStyle::ButtCap);
        content.set_line_join(LineJoinStyle::RoundJoin);
        Ok(Self {
            content,
            height,
            opacities: BTreeSet::new(),
            text: Glyphs::new()?,
        })
    }

    /// A place, points from the lower left corner.
    fn place(&self, [x, y]: &Point) -> [f32; 2] {
        [*x, self.height - y].map(points)
    }

    fn draw(&mut self, item: &Item) {
        match item {
            Item::Line(path, colour, width) => {
                self.colour(colour);
                self.content.set_line_width(points(*width));
                self.path(path);
                self.content.stroke();
            }
            Item::Area(outline, colour) => {
                self.colour(colour);
                self.path(outline);
                self.content.fill_nonzero();
            }
            Item::Text(text, at, anchor, size) => self.text(text, *at, *anchor, *size),
        }
    }

    fn colour(&mut self, colour: &RGBAColor) {
        let [r, g, b] = [colour.0, colour.1, colour.2].map(|c| f32::from(c) / 255.0);
        let opacity = (1000.0 * colour.3).round() as u16;
        self.opacities.insert(opacity);
        let name = format!("G{opacity}");
        self.content.set_parameters(Name(name.as_bytes()));
        self.content.set_stroke_rgb(r, g, b);
        self.content.set_fill_rgb(r, g, b);
    }

    fn path(&mut self, path: &[Point]) {
        for (i, point) in path.iter().enumerate() {
            let [x, y] = self.place(point);
            match i {
                0 => self.content.move_to(x, y),
                _ => self.content.line_to(x, y),
            };
        }
    }

    fn text(&mut self, text: &str, at: Point, anchor: Anchor, size: f64) {
        self.colour(&BLACK);
        let (codes, width) = self.text.encode(text, size);
        let start = anchor.before() * width;
        let down = 0.5 * self.text.capitals * EM * size;
        let (origin, [a, b, c, d]) = match anchor {
            Anchor::Upwards => ([at[0] + down, at[1] + start], [0.0, 1.0, -1.0, 0.0]),
            _ => ([at[0] - start, at[1] + down], [1.0, 0.0, 0.0, 1.0]),
        };
        let [x, y] = self.place(&origin);
        self.content.begin_text();
        self.content.set_font(FONT, points(EM * size));
        self.content.set_text_matrix([a, b, c, d, x, y]);
        self.content.show(Str(&codes));
        self.content.end_text();
    }
}

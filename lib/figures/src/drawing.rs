//! A picture as a list of lines, areas, texts and images.

use plotters::style::RGBAColor;

use crate::measure::{self, ABOVE, BELOW};
use crate::page::Page;

/// A point in logical pixels from the top left corner.
pub(crate) type Point = [f64; 2];

/// A picture as a list of what is in it, in logical pixels (120 per inch); figures build it,
/// [`Drawing::to_svg`], [`Drawing::to_png`] and [`Drawing::to_pdf`] render it. Images lie under
/// all else, the rest in the order of drawing.
#[derive(Clone, Debug)]
pub struct Drawing {
    pub(crate) page: Page,
    pub(crate) width: f64,
    pub(crate) height: f64,
    pub(crate) images: Vec<Image>,
    pub(crate) items: Vec<Item>,
}

/// Pixels of a picture placed in the drawing, not smoothed.
#[derive(Clone, Debug)]
pub(crate) struct Image {
    /// Left, top, width and height of the place it fills.
    pub(crate) place: [f64; 4],
    /// Pixels along x and y.
    pub(crate) size: [usize; 2],
    /// Row by row from the top, three bytes a pixel.
    pub(crate) rgb: Vec<u8>,
}

#[derive(Clone, Debug)]
pub(crate) enum Item {
    /// Its points, colour and width.
    Line(Vec<Point>, RGBAColor, f64),
    /// Its outline and colour.
    Area(Vec<Point>, RGBAColor),
    /// What it says, its place, anchor and size.
    Text(String, Point, Anchor, f64),
}

/// Where the text lies with respect to its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Anchor {
    /// To the right of it, centred in height.
    Left,
    /// Centred on it.
    Centre,
    /// To the left of it, centred in height.
    Right,
    /// Centred on it, reading upwards.
    Upwards,
}

impl Anchor {
    /// Share of the text's width that lies before its point.
    pub(crate) fn before(self) -> f64 {
        match self {
            Self::Left => 0.0,
            Self::Centre | Self::Upwards => 0.5,
            Self::Right => 1.0,
        }
    }
}

/// A line of text and the room that it takes, in logical pixels from the top left corner.
#[derive(Clone, Debug, PartialEq)]
pub struct TextBox {
    /// What it says.
    pub text: String,
    /// Left, top, right and lower end.
    pub edges: [f64; 4],
}

impl Drawing {
    pub(crate) fn new(page: Page, width: f64, height: f64) -> Self {
        Self {
            page,
            width,
            height: height.ceil(),
            images: Vec::new(),
            items: Vec::new(),
        }
    }

    pub(crate) fn line(&mut self, points: Vec<Point>, colour: RGBAColor, width: f64) {
        self.items.push(Item::Line(points, colour, width));
    }

    /// A line of dashes `on` long with gaps of `off`.
    pub(crate) fn dashes(
        &mut self,
        points: &[Point],
        colour: RGBAColor,
        width: f64,
        [on, off]: [f64; 2],
    ) {
        let mut dash = Vec::new();
        let mut done = 0.0;
        for pair in points.windows(2) {
            let [a, b] = [pair[0], pair[1]];
            let length = (b[0] - a[0]).hypot(b[1] - a[1]);
            let at = |s: f64| [0, 1].map(|i| a[i] + (b[i] - a[i]) * s / length);
            let mut s = 0.0;
            while s < length {
                let phase = done % (on + off);
                let inked = phase < on;
                let left = if inked { on - phase } else { on + off - phase };
                // A floor on the step keeps rounding in `phase` from stalling the walk.
                let step = left.max(1e-6).min(length - s);
                if inked {
                    if dash.is_empty() {
                        dash.push(at(s));
                    }
                    dash.push(at(s + step));
                } else if !dash.is_empty() {
                    self.line(std::mem::take(&mut dash), colour, width);
                }
                s += step;
                done += step;
            }
        }
        if dash.len() > 1 {
            self.line(dash, colour, width);
        }
    }

    pub(crate) fn area(&mut self, points: Vec<Point>, colour: RGBAColor) {
        // An empty polygon stops ImageMagick.
        if !points.is_empty() {
            self.items.push(Item::Area(points, colour));
        }
    }

    pub(crate) fn text(&mut self, text: impl Into<String>, at: Point, anchor: Anchor, size: f64) {
        (self.items).push(Item::Text(text.into(), at, anchor, size));
    }

    /// Lines of text one below the other, the first with its middle at `at`.
    pub(crate) fn lines(&mut self, lines: &[String], at: Point, anchor: Anchor, size: f64) {
        for (i, line) in lines.iter().enumerate() {
            let down = i as f64 * measure::LINE * size;
            let at = match anchor {
                Anchor::Upwards => [at[0] + down, at[1]],
                _ => [at[0], at[1] + down],
            };
            self.text(line.as_str(), at, anchor, size);
        }
    }

    /// Width and height, logical pixels.
    pub fn size(&self) -> [f64; 2] {
        [self.width, self.height]
    }

    /// Every line of text with its room in the embedded font.
    pub fn text_boxes(&self) -> Vec<TextBox> {
        let boxed = |item: &Item| match item {
            Item::Text(text, [x, y], anchor, size) => {
                let width = measure::width(text, *size);
                let [above, below] = [ABOVE * size, BELOW * size];
                let start = x - anchor.before() * width;
                let edges = match anchor {
                    Anchor::Upwards => [x - above, y - 0.5 * width, x + below, y + 0.5 * width],
                    _ => [start, y - above, start + width, y + below],
                };
                let text = text.clone();
                Some(TextBox { text, edges })
            }
            _ => None,
        };
        self.items.iter().filter_map(boxed).collect()
    }
}

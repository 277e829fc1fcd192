//! The page that a figure is made for.

/// Logical pixels per millimetre: 120 to the inch, so that the text of a picture printed at its
/// own size is of 7 and 8 points.
const PER_MM: f64 = 120.0 / 25.4;

/// What a picture is made for: its printed width and the dots of its pixels.
///
/// A figure fits itself to the width: fewer panels side by side, shorter legends and fewer ticks,
/// but text as large as in any other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Page {
    /// mm; without it a figure is as wide as it likes, 170 mm or so.
    pub width_mm: Option<f64>,
    /// Pixels per inch of a PNG.
    pub dpi: f64,
}

impl Default for Page {
    fn default() -> Self {
        Self {
            width_mm: None,
            dpi: 240.0,
        }
    }
}

impl Page {
    /// Narrowest picture, mm.
    pub const NARROWEST: f64 = 60.0;
    /// Widest picture, mm.
    pub const WIDEST: f64 = 1000.0;
    /// Fewest and most pixels per inch.
    pub const DPI: [f64; 2] = [30.0, 1200.0];

    /// Its width in logical pixels, if it is given.
    pub(crate) fn width(&self) -> Option<f64> {
        self.width_mm.map(|mm| mm * PER_MM)
    }

    /// Pixels of a PNG per logical pixel.
    pub(crate) fn scale(&self) -> f64 {
        self.dpi / (25.4 * PER_MM)
    }
}

/// A length in logical pixels, mm.
pub(crate) fn millimetres(pixels: f64) -> f64 {
    pixels / PER_MM
}

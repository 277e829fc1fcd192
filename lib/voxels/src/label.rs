//! The value of a pixel.

use std::fmt;
use std::str::FromStr;

use crate::sample::Sample;

/// The stored value of a pixel: a number, or three for RGB.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Label {
    /// One sample per pixel.
    Value(f64),
    /// Three samples per pixel.
    Rgb([f64; 3]),
}

impl Label {
    /// Whether it is made of whole numbers, as labels are; a float may be none.
    pub(crate) fn is_whole(self) -> bool {
        match self {
            Label::Value(v) => v.fract() == 0.0,
            Label::Rgb(parts) => parts.iter().all(|v| v.fract() == 0.0),
        }
    }

    /// The label of the pixel stored in `bytes` (native byte order, channels interleaved).
    pub(crate) fn of_pixel(bytes: &[u8], sample: Sample, channels: usize) -> Self {
        if channels == 3 {
            let n = sample.bytes();
            Label::Rgb([0, 1, 2].map(|c| sample.value(&bytes[c * n..])))
        } else {
            Label::Value(sample.value(bytes))
        }
    }
}

impl fmt::Display for Label {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Label::Value(v) => write!(f, "{v}"),
            Label::Rgb([r, g, b]) => write!(f, "{r}:{g}:{b}"),
        }
    }
}

impl FromStr for Label {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        // Beyond 2^53 two stored integers could share one double.
        let is_label = |v: &f64| v.abs() < 9_007_199_254_740_992.0 && v.fract() == 0.0;
        let number = |part: &str| part.trim().parse().ok().filter(is_label);
        let parts: Option<Vec<f64>> = text.split(':').map(number).collect();
        match parts.as_deref() {
            Some(&[value]) => Ok(Label::Value(value)),
            Some(&[r, g, b]) => Ok(Label::Rgb([r, g, b])),
            _ => Err(format!(
                "'{text}' is not a label; accepted are a whole number below 2^53 and R:G:B"
            )),
        }
    }
}

//! Options that several figures share: where a picture goes, its page, and how a state is looked at.

use clap::Args;
use figures::{Direction, Page, Wood};

use crate::values::{Target, degrees, given, number, one_of, width};

#[derive(Args)]
pub(crate) struct Picture {
    /// Picture to write, .svg, .png or .pdf; `-` is SVG on standard output; may be repeated
    #[arg(short, long, value_name = "FILE", required = true, value_parser = given(Target::new))]
    pub(crate) output: Vec<Target>,
    #[command(flatten)]
    pub(crate) print: Print,
}

/// What a picture is printed on.
#[derive(Args)]
pub(crate) struct Print {
    /// Printed width, e.g. "84 mm", at which text has 7 and 8 points
    /// [default: by the content, about 170 mm]
    #[arg(long, value_name = "LEN", value_parser = width)]
    width: Option<f64>,
    /// Pixels per inch of a PNG, 30 to 1200
    #[arg(long, value_name = "NUMBER", default_value = "240", value_parser = |text: &str| number(text, Page::DPI))]
    dpi: f64,
}

impl Print {
    pub(crate) fn page(&self) -> Page {
        Page {
            width_mm: self.width,
            dpi: self.dpi,
        }
    }
}

/// What is seen of a state, and from where.
#[derive(Args)]
pub(crate) struct Look {
    /// Wood that is shown: none (hidden), the half away from the viewer (cut), or all (whole)
    #[arg(long, default_value = "cut", value_parser = one_of::<Wood>())]
    pub(crate) wood: Wood,
    /// Angle of view to the side of the front, in degrees about the axis across the bond
    #[arg(long, value_name = "DEGREES", default_value_t = Direction::default().turn, allow_hyphen_values = true,
          value_parser = |text: &str| degrees(text, [-360.0, 360.0]))]
    pub(crate) turn: f64,
    /// Angle of view above the bond plane, in degrees
    #[arg(long, value_name = "DEGREES", default_value_t = Direction::default().tilt, allow_hyphen_values = true,
          value_parser = |text: &str| degrees(text, [-90.0, 90.0]))]
    pub(crate) tilt: f64,
}

impl Look {
    pub(crate) fn from(&self) -> Direction {
        Direction {
            turn: self.turn,
            tilt: self.tilt,
        }
    }
}

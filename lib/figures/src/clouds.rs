//! The figure of points coloured by a value.

use crate::Error;
use crate::axes::{Axis, extent};
use crate::colour::{opaque, viridis};
use crate::colour_bar;
use crate::drawing::Drawing;
use crate::frame::{most_beside, room_below};
use crate::legend::disc;
use crate::page::Page;
use crate::panels::{Layout, Panels, Sheet};

/// Points of a plane coloured by a value, several clouds side by side in one scale.
#[derive(Clone, Debug)]
pub struct Clouds {
    value: String,
    axes: [String; 2],
    range: [f64; 2],
    radius: f64,
    clouds: Vec<(String, Vec<Spot>)>,
    page: Page,
}

/// Place (x, y) and value of a point.
pub type Spot = ([f64; 2], f64);

const LONGEST: f64 = 360.0;
/// About the least edge of a panel, logical pixels.
const LEAST: f64 = 100.0;

impl Clouds {
    /// No clouds yet; `axes` name the places, `value` what colours them over `range`, `radius` is that of a point
    /// in the unit of the places.
    pub fn new(axes: [&str; 2], value: &str, range: [f64; 2], radius: f64) -> Self {
        Self {
            axes: axes.map(String::from),
            value: value.into(),
            range,
            radius,
            clouds: Vec::new(),
            page: Page::default(),
        }
    }

    /// The same for a page.
    pub fn on(self, page: Page) -> Self {
        Self { page, ..self }
    }

    /// The same with another cloud.
    pub fn with(mut self, label: &str, points: Vec<Spot>) -> Self {
        self.clouds.push((label.into(), points));
        self
    }

    /// The figure.
    ///
    /// # Errors
    /// [`Error::Data`] when there is no point.
    pub fn draw(&self) -> Result<Drawing, Error> {
        let all = || self.clouds.iter().flat_map(|c| c.1.iter());
        if all().next().is_none() {
            return Err(Error::Data("no points to draw".into()));
        }
        let side = |i: usize| {
            let (low, high) = extent(all().map(|(place, _)| place[i]));
            (low - self.radius, high + self.radius)
        };
        let (x, y) = (side(0), side(1));
        let sheets: Vec<Sheet> = (self.clouds.iter())
            .map(|(label, _)| Sheet {
                edges: [x.1 - x.0, y.1 - y.0],
                name: label,
                detail: "",
            })
            .collect();
        let shades = Axis::exact(self.value.as_str(), self.range[0], self.range[1]);
        let across = Axis::exact(self.axes[0].as_str(), x.0, x.1);
        let up = Axis::exact(self.axes[1].as_str(), y.0, y.1);
        let layout = Layout {
            top: 10.0,
            longest: LONGEST,
            left: most_beside(&up, LEAST) + 4.0,
            below: room_below(&across, LEAST) + 8.0,
            right: colour_bar::width(&shades),
        };
        let panels = Panels::place(&sheets, layout, &self.page);
        let page = (self.page.width()).unwrap_or(panels.right + layout.right);
        let (top, height) = (
            panels.frames[0].top,
            panels.frames[0].height.max(colour_bar::LEAST),
        );
        let bottom = panels.bottom.max(top + height + layout.below);
        let mut drawing = Drawing::new(self.page, page, bottom);
        panels.draw_captions(&mut drawing);
        for ((_, points), frame) in self.clouds.iter().zip(&panels.frames) {
            frame.draw(&mut drawing, &across, &up, false);
            let radius = self.radius / (x.1 - x.0) * frame.width;
            for (place, value) in points {
                let disc = disc(frame.place(&across, &up, *place), radius);
                drawing.area(disc, opaque(viridis(shades.share(*value))));
            }
        }
        colour_bar::draw(&mut drawing, panels.right, top, height, &shades);
        Ok(drawing)
    }
}

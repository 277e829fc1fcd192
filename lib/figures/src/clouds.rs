//! The figure of points coloured by a value.

use crate::Error;
use crate::axes::{Axis, extent};
use crate::colour::{opaque, viridis};
use crate::drawing::Drawing;
use crate::legend::{Legend, disc};
use crate::page::Page;
use crate::panels::{Plate, Sheet};

/// Points of a plane coloured by a value, several clouds side by side in one scale.
#[derive(Clone, Debug)]
pub struct Clouds<'a> {
    axes: [&'a str; 2],
    value: &'a str,
    range: [f64; 2],
    radius: f64,
    clouds: Vec<(&'a str, Vec<Spot>)>,
}

/// Place (x, y) and value of a point.
pub type Spot = ([f64; 2], f64);

impl<'a> Clouds<'a> {
    /// No clouds yet; `axes` name the places, `value` what colours them over `range`, `radius` is that of a point
    /// in the unit of the places.
    pub fn new(axes: [&'a str; 2], value: &'a str, range: [f64; 2], radius: f64) -> Self {
        Self {
            axes,
            value,
            range,
            radius,
            clouds: Vec::new(),
        }
    }

    /// The same with another cloud.
    pub fn with(mut self, label: &'a str, points: Vec<Spot>) -> Self {
        self.clouds.push((label, points));
        self
    }

    /// The figure.
    ///
    /// # Errors
    /// [`Error::Data`] when there is no point.
    pub fn draw(&self, page: Page) -> Result<Drawing, Error> {
        let all = || self.clouds.iter().flat_map(|(_, points)| points);
        if all().next().is_none() {
            return Err(Error::Data("no points to draw".into()));
        }
        let side = |i: usize| {
            let (low, high) = extent(all().map(|(place, _)| place[i]));
            [low - self.radius, high + self.radius]
        };
        let sides = [side(0), side(1)];
        let edges = sides.map(|[low, high]| high - low);
        let axes = [0, 1].map(|i| Axis::over(self.axes[i], sides[i][0], sides[i][1]));
        let sheets = self.clouds.iter();
        let sheets = sheets.map(|(label, _)| Sheet::new(edges, label, Some(axes.clone())));
        let shades = Axis::over(self.value, self.range[0], self.range[1]);
        let plate = Plate {
            sheets: sheets.collect(),
            key: Legend::new([], Legend::PATCH, 0.0),
            shades: Some(shades.clone()),
            longest: 360.0,
            apart: 8.0,
        };
        let [x, y] = &axes;
        Ok(plate.draw(
            page,
            |_, _, _| {},
            |drawing, i, frame| {
                frame.draw(drawing, x, y, false);
                let radius = self.radius / edges[0] * frame.width;
                for (place, value) in &self.clouds[i].1 {
                    let disc = disc(frame.place(x, y, *place), radius);
                    drawing.area(disc, opaque(viridis(shades.share(*value))));
                }
            },
        ))
    }
}

use crate::Error;
use crate::axes::{Axis, NORMAL, extent};
use crate::colour::{opaque, viridis};
use crate::colour_bar;
use crate::drawing::{Anchor, Drawing, Point};
use crate::panels::{Panels, Room};

/// Points of a plane coloured by a value, several clouds side by side in one scale.
#[derive(Clone, Debug)]
pub struct Clouds {
    value: String,
    range: [f64; 2],
    radius: f64,
    clouds: Vec<(String, Vec<Spot>)>,
}

/// Place (x, y) and value of a point.
pub type Spot = ([f64; 2], f64);

const LONGEST: f64 = 360.0;
const ROOM: Room = Room {
    left: 24.0,
    above: 48.0,
    below: 24.0,
    column: 190.0,
};

impl Clouds {
    /// No clouds yet; `value` names what colours them over `range`, `radius` is that of a point
    /// in the unit of the places.
    pub fn new(value: &str, range: [f64; 2], radius: f64) -> Self {
        Self {
            value: value.into(),
            range,
            radius,
            clouds: Vec::new(),
        }
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
        let edges = vec![[x.1 - x.0, y.1 - y.0]; self.clouds.len()];
        let panels = Panels::place(&edges, LONGEST, ROOM);
        let size = [panels.right + colour_bar::WIDTH, panels.bottom];
        let mut drawing = Drawing::new(size[0] as u32, size[1] as u32);
        let shades = Axis::exact(self.value.as_str(), self.range[0], self.range[1]);
        let (across, up) = (Axis::exact("", x.0, x.1), Axis::exact("", y.0, y.1));
        for ((label, points), frame) in self.clouds.iter().zip(&panels.frames) {
            frame.draw(&mut drawing, &Axis::none(), &Axis::none(), false);
            let middle = [frame.left + 0.5 * frame.width, frame.top - 22.0];
            drawing.text(label, middle, Anchor::Centre, NORMAL);
            let radius = self.radius / (x.1 - x.0) * frame.width;
            for (place, value) in points {
                let disc = disc(frame.place(&across, &up, *place), radius);
                drawing.area(disc, opaque(viridis(shades.share(*value))));
            }
        }
        colour_bar::draw(
            &mut drawing,
            panels.right,
            ROOM.above,
            panels.height,
            &shades,
        );
        Ok(drawing)
    }
}

fn disc([x, y]: Point, radius: f64) -> Vec<Point> {
    (0..12)
        .map(|i| {
            let (sin, cos) = (f64::from(i) / 12.0 * std::f64::consts::TAU).sin_cos();
            [x + radius * cos, y + radius * sin]
        })
        .collect()
}

use crate::Error;
use crate::axes::{Axis, Frame, NORMAL};
use crate::colour::DISTINCT;
use crate::drawing::{Anchor, Drawing, Point};
use crate::legend::{self, Stroke};

/// Any quantity against any other, as lines and dots.
#[derive(Clone, Debug)]
pub struct Plot {
    title: String,
    axes: [(String, bool); 2],
    series: Vec<Series>,
}

/// One series of a [`Plot`].
#[derive(Clone, Debug)]
struct Series {
    label: String,
    mark: Mark,
    points: Vec<Point>,
}

/// How a series is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// A line through the points; one that is not finite breaks it.
    Line,
    /// A dot for each.
    Dots,
    /// Both.
    LineAndDots,
}

const WIDTH: u32 = 800;
const LEFT: f64 = 92.0;
const RIGHT: f64 = 24.0;
const HEIGHT: f64 = 420.0;

impl Plot {
    /// A plot without data, of axes with these titles.
    pub fn new(title: &str, x: &str, y: &str) -> Self {
        Self {
            title: title.into(),
            axes: [(x.into(), false), (y.into(), false)],
            series: Vec::new(),
        }
    }

    /// The same with logarithmic axes, x and y, where asked.
    pub fn logarithmic(mut self, which: [bool; 2]) -> Self {
        for (axis, logarithmic) in self.axes.iter_mut().zip(which) {
            axis.1 = logarithmic;
        }
        self
    }

    /// The same with another series.
    pub fn with(mut self, label: &str, mark: Mark, points: Vec<[f64; 2]>) -> Self {
        self.series.push(Series {
            label: label.into(),
            mark,
            points,
        });
        self
    }

    /// The figure.
    ///
    /// # Errors
    /// [`Error::Data`] when no series has a finite point; [`Error::Request`] for more series
    /// than can be told apart.
    pub fn draw(&self) -> Result<Drawing, Error> {
        if self.series.len() > DISTINCT {
            return Err(Error::Request(format!(
                "{} series are too many for one plot: {DISTINCT} can be told apart",
                self.series.len()
            )));
        }
        let all = || self.series.iter().flat_map(|s| s.points.iter());
        if !all().any(|p| p[0].is_finite() && p[1].is_finite()) {
            return Err(Error::Data(format!("'{}' has no data", self.title)));
        }
        let axis = |i: usize| {
            let (title, logarithmic) = &self.axes[i];
            let values = all().map(|p| p[i]);
            if *logarithmic {
                Axis::logarithmic(title.as_str(), values)
            } else {
                Axis::linear(title.as_str(), values)
            }
        };
        let (x, y) = (axis(0), axis(1));
        let labels: Vec<&str> = self.series.iter().map(|s| s.label.as_str()).collect();
        let width = f64::from(WIDTH) - LEFT - RIGHT;
        let frame = Frame {
            left: LEFT,
            top: 46.0 + legend::height(&labels, width),
            width,
            height: HEIGHT,
        };
        let mut drawing = Drawing::new(WIDTH, (frame.bottom() + 56.0) as u32);
        let middle = [LEFT + 0.5 * width, 20.0];
        drawing.text(&self.title, middle, Anchor::Centre, NORMAL + 2.0);
        let sample = |drawing: &mut Drawing, i: usize, [a, b]: [Point; 2]| {
            let middle = [0.5 * (a[0] + b[0]), a[1]];
            self.series[i].draw_line(drawing, i, &[a, b]);
            self.series[i].draw_dots(drawing, i, &[middle]);
        };
        legend::draw_samples(&mut drawing, &labels, [LEFT, 36.0], width, sample);
        frame.draw(&mut drawing, &x, &y, true);
        for (i, series) in self.series.iter().enumerate() {
            let places = series.points.iter().map(|&p| frame.place(&x, &y, p));
            let places: Vec<Point> = places.collect();
            series.draw_line(&mut drawing, i, &places);
            series.draw_dots(&mut drawing, i, &places);
        }
        Ok(drawing)
    }
}

impl Series {
    fn draw_line(&self, drawing: &mut Drawing, index: usize, places: &[Point]) {
        if self.mark != Mark::Dots {
            Stroke::of_series(index).draw(drawing, places);
        }
    }

    fn draw_dots(&self, drawing: &mut Drawing, index: usize, places: &[Point]) {
        if self.mark != Mark::Line {
            for place in places {
                // A run of one point is a dot.
                Stroke::of_series(index).draw(drawing, &[*place]);
            }
        }
    }
}

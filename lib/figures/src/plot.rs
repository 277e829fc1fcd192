//! The figure of any quantity against another.

use crate::Error;
use crate::axes::{Axis, NORMAL};
use crate::colour::DISTINCT;
use crate::drawing::{Anchor, Drawing, Point};
use crate::frame::{Frame, room_below, room_beside};
use crate::legend::{Legend, Stroke};
use crate::measure;
use crate::page::Page;

/// Any quantity against any other, as lines and dots.
#[derive(Clone, Debug)]
pub struct Plot {
    title: String,
    axes: [(String, Scale); 2],
    series: Vec<Series>,
    page: Page,
}

/// How values are placed on an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Scale {
    Linear,
    /// By their logarithms, the uppermost decades.
    Logarithmic,
    /// By their logarithms, all decades.
    Decades,
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

const WIDTH: f64 = 800.0;
const RIGHT: f64 = 24.0;

impl Plot {
    /// A plot without data, of axes with these titles.
    pub fn new(title: &str, x: &str, y: &str) -> Self {
        Self {
            title: title.into(),
            axes: [(x.into(), Scale::Linear), (y.into(), Scale::Linear)],
            series: Vec::new(),
            page: Page::default(),
        }
    }

    /// The same for a page.
    pub fn on(self, page: Page) -> Self {
        Self { page, ..self }
    }

    /// The same with logarithmic axes, x and y, where asked.
    pub fn logarithmic(mut self, which: [bool; 2]) -> Self {
        for (axis, logarithmic) in self.axes.iter_mut().zip(which) {
            axis.1 = match logarithmic {
                true => Scale::Logarithmic,
                false => Scale::Linear,
            };
        }
        self
    }

    /// The same with a logarithmic x axis over all decades that there are.
    pub fn decades(mut self) -> Self {
        self.axes[0].1 = Scale::Decades;
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
            let (title, scale) = &self.axes[i];
            let values = all().map(|p| p[i]);
            match scale {
                Scale::Linear => Axis::linear(title.as_str(), values),
                Scale::Logarithmic => Axis::logarithmic(title.as_str(), values),
                Scale::Decades => Axis::decades(title.as_str(), values),
            }
        };
        let (x, y) = (axis(0), axis(1));
        let page = self.page.width().unwrap_or(WIDTH);
        let height = (0.525 * page).max(200.0);
        let left = room_beside(&y, height) + 4.0;
        let width = page - left - RIGHT;
        let labels = self.series.iter().map(|s| s.label.as_str());
        let legend = Legend::new(labels, Legend::LINE, width);
        let title = measure::lines(&self.title, NORMAL + 2.0, page - 2.0 * RIGHT, 3);
        let title_height = 12.0 + 1.4 * NORMAL * title.len() as f64;
        let frame = Frame {
            left,
            top: title_height + legend.height() + 10.0,
            width,
            height,
        };
        let bottom = frame.bottom() + room_below(&x, width) + 4.0;
        let mut drawing = Drawing::new(self.page, page, bottom);
        let middle = [0.5 * page, 20.0];
        drawing.lines(&title, middle, Anchor::Centre, NORMAL + 2.0);
        legend.draw(&mut drawing, [left, title_height], |drawing, i, [a, b]| {
            let middle = [0.5 * (a[0] + b[0]), a[1]];
            self.series[i].draw_line(drawing, i, &[a, b]);
            self.series[i].draw_dots(drawing, i, &[middle]);
        });
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

//! The figure of any quantity against another.

use crate::Error;
use crate::axes::{Axis, NORMAL};
use crate::colour::{DISTINCT, faded, series};
use crate::drawing::{Anchor, Drawing, Point};
use crate::frame::{Frame, room_below, room_beside};
use crate::legend::{Legend, Stroke};
use crate::measure;
use crate::page::Page;

/// Any quantity against any other, as lines and dots.
#[derive(Clone, Debug)]
pub struct Plot {
    title: String,
    /// Titles of x and y, and whether values lie by their logarithms.
    axes: [(String, bool); 2],
    series: Vec<Series>,
}

/// One series of a [`Plot`].
#[derive(Clone, Debug)]
struct Series {
    label: String,
    mark: Mark,
    points: Vec<Point>,
    /// Deviation up and down of each point; empty without.
    deviations: Vec<f64>,
    /// Which of the labels it has.
    entry: usize,
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

/// Opacity of the band of a line.
const BAND_SHADE: f64 = 0.2;
const WIDTH: f64 = 800.0;
const RIGHT: f64 = 24.0;
/// Lies on the lower edge of every logarithmic axis.
pub(crate) const LEAST: f64 = f64::MIN_POSITIVE;

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

    /// The same with another series; those of one label are drawn alike.
    pub fn with(mut self, label: &str, mark: Mark, points: Vec<[f64; 2]>) -> Self {
        let entry = self.entries().position(|other| other.label == label);
        self.series.push(Series {
            label: label.into(),
            mark,
            points,
            deviations: Vec::new(),
            entry: entry.unwrap_or(self.entries().count()),
        });
        self
    }

    /// The same with another series, of points x and y that are known to a deviation of y: dots with bars, lines with a band.
    pub fn with_deviations(self, label: &str, mark: Mark, points: &[[f64; 3]]) -> Self {
        let places = points.iter().map(|&[x, y, _]| [x, y]).collect();
        let mut plot = self.with(label, mark, places);
        if let Some(series) = plot.series.last_mut() {
            series.deviations = points.iter().map(|p| p[2]).collect();
        }
        plot
    }

    /// The first series of each label.
    fn entries(&self) -> impl Iterator<Item = &Series> {
        let first = |(i, series): &(usize, &Series)| {
            !(self.series[..*i].iter()).any(|other| other.label == series.label)
        };
        (self.series.iter().enumerate().filter(first)).map(|(_, series)| series)
    }

    /// The figure.
    ///
    /// # Errors
    /// [`Error::Data`] when no series has a finite point; [`Error::Request`] for more series
    /// than can be told apart.
    pub fn draw(&self, page: Page) -> Result<Drawing, Error> {
        let entries: Vec<&Series> = self.entries().collect();
        if entries.len() > DISTINCT {
            return Err(Error::Request(format!(
                "{} series are too many for one plot: {DISTINCT} can be told apart",
                entries.len()
            )));
        }
        let all = || self.series.iter().flat_map(Series::extent);
        if !all().any(|p| p[0].is_finite() && p[1].is_finite()) {
            return Err(Error::Data(format!("'{}' has no data", self.title)));
        }
        let axis = |i: usize| {
            let (title, logarithmic) = &self.axes[i];
            let points = self.series.iter().flat_map(|s| &s.points).map(|p| p[i]);
            match logarithmic {
                false => Axis::linear(title, all().map(|p| p[i])),
                // What a deviation reaches to is no point that could be left out.
                true => {
                    let above = all().map(|p| p[i]).filter(|v| *v > 0.0);
                    let others = points.filter(|v| *v <= 0.0);
                    Axis::logarithmic(title, above.chain(others))
                }
            }
        };
        let (x, y) = (axis(0), axis(1));
        let across = page.width().unwrap_or(WIDTH);
        let height = (0.525 * across).max(200.0);
        let left = room_beside(&y, height) + 4.0;
        let width = across - left - RIGHT;
        let labels = entries.iter().map(|s| s.label.as_str());
        let legend = Legend::new(labels, Legend::LINE, width);
        let title = measure::lines(&self.title, NORMAL + 2.0, across - 2.0 * RIGHT, 3);
        let title_height = 12.0 + 1.4 * NORMAL * title.len() as f64;
        let top = title_height + legend.height + 10.0;
        let frame = Frame::new([left, top], [width, height]);
        let bottom = frame.bottom() + room_below(&x, width) + 4.0;
        let mut drawing = Drawing::new(page, across, bottom);
        let middle = [0.5 * across, 20.0];
        drawing.lines(&title, middle, Anchor::Centre, NORMAL + 2.0);
        legend.draw(&mut drawing, [left, title_height], |drawing, i, [a, b]| {
            let middle = [0.5 * (a[0] + b[0]), a[1]];
            entries[i].draw_line(drawing, &[a, b]);
            entries[i].draw_dots(drawing, &[middle]);
        });
        frame.draw(&mut drawing, &x, &y, true);
        for series in &self.series {
            let places = |points: Vec<Point>| -> Vec<Point> {
                (points.into_iter().map(|p| frame.place(&x, &y, p))).collect()
            };
            let mut ends = series.ends();
            if self.axes[1].1 {
                ends[0].iter_mut().for_each(|p| p[1] = p[1].max(LEAST));
            }
            series.draw_deviations(&mut drawing, ends.map(places));
            let places = places(series.points.clone());
            series.draw_line(&mut drawing, &places);
            series.draw_dots(&mut drawing, &places);
        }
        Ok(drawing)
    }
}

impl Series {
    /// Points, and what they reach to by their deviations.
    fn extent(&self) -> impl Iterator<Item = Point> {
        let ends = self.ends().into_iter().flatten();
        self.points.iter().copied().chain(ends)
    }

    /// Low and high ends of what points reach to by their deviations.
    fn ends(&self) -> [Vec<Point>; 2] {
        [-1.0, 1.0].map(|sign| {
            let points = self.points.iter().zip(&self.deviations);
            points.map(|([x, y], by)| [*x, y + sign * by]).collect()
        })
    }

    fn draw_deviations(&self, drawing: &mut Drawing, [low, high]: [Vec<Point>; 2]) {
        if self.mark == Mark::Dots {
            let pairs = low.into_iter().zip(high);
            for (low, high) in pairs.filter(|(low, high)| placed(low) && placed(high)) {
                drawing.line(vec![low, high], series(self.entry), 1.4);
            }
        } else {
            let outline = low.into_iter().chain(high.into_iter().rev());
            let outline = outline.filter(placed);
            drawing.area(outline.collect(), faded(series(self.entry), BAND_SHADE));
        }
    }

    fn draw_line(&self, drawing: &mut Drawing, places: &[Point]) {
        if self.mark != Mark::Dots {
            Stroke::of_series(self.entry).draw(drawing, places);
        }
    }

    fn draw_dots(&self, drawing: &mut Drawing, places: &[Point]) {
        // A run of one point is a dot.
        for place in places.chunks(1).filter(|_| self.mark != Mark::Line) {
            Stroke::of_series(self.entry).draw(drawing, place);
        }
    }
}

fn placed(point: &Point) -> bool {
    point.iter().all(|x| x.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points with bars and a line with a band share one entry of the key; the axis takes in what they reach to.
    #[test]
    fn series_of_one_label_are_one_entry_and_deviations_are_drawn() {
        let mut plot = Plot::new("", "x", "y");
        for i in 0..DISTINCT {
            let label = i.to_string();
            let points = [[1.0, 10.0, 2.0], [2.0, 11.0, 4.0]];
            plot = plot
                .with_deviations(&label, Mark::Line, &points)
                .with_deviations(&label, Mark::Dots, &points);
        }
        assert_eq!(plot.entries().count(), DISTINCT);
        let highest = plot.series[0].extent().map(|p| p[1]).fold(0.0, f64::max);
        assert_eq!(highest, 15.0);
        assert!(plot.draw(Page::default()).is_ok());
        let one_more = plot.with("another", Mark::Line, vec![[0.0, 0.0]]);
        assert!(one_more.draw(Page::default()).is_err());
    }

    /// An empty polygon, of deviations that there are none of, kept ImageMagick from drawing the curve.
    #[test]
    fn a_line_without_deviations_has_no_band() {
        let plot = Plot::new("", "x", "y").with("a", Mark::Line, vec![[0.0, 1.0], [1.0, 2.0]]);
        let svg = plot.draw(Page::default()).unwrap().to_svg().unwrap();
        assert!(!svg.contains("points=\"\""), "{svg}");
    }
}

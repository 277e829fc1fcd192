//! The key of series, and how they are told apart.

use plotters::style::RGBAColor;

use crate::axes::NORMAL;
use crate::drawing::{Anchor, Drawing, Point};
use crate::measure;

/// Dash and gap of the i-th series; the first is solid.
const DASHES: [Option<[f64; 2]>; 4] = [None, Some([9.0, 4.0]), Some([2.5, 3.5]), Some([14.0, 4.0])];

/// How a series is drawn: colour, dashes and width differ, so that series stay apart without
/// colour and where they lie on each other.
#[derive(Clone, Copy)]
pub(crate) struct Stroke {
    pub(crate) colour: RGBAColor,
    dashes: Option<[f64; 2]>,
    width: f64,
    /// Radius of a point.
    dot: f64,
}

/// Radii of points of the i-th series: those of later ones leave a rim of those that they cover.
const DOTS: [f64; 4] = [5.2, 4.0, 2.8, 1.8];

impl Stroke {
    pub(crate) fn of_series(i: usize) -> Self {
        Self {
            colour: crate::colour::series(i),
            dashes: DASHES[i % DASHES.len()],
            width: if i == 0 { 2.6 } else { 2.0 },
            dot: DOTS[i % DOTS.len()],
        }
    }

    /// Draws the runs of finite points; a run of one point is a dot.
    pub(crate) fn draw(&self, drawing: &mut Drawing, points: &[Point]) {
        for run in points.split(|p| !(p[0].is_finite() && p[1].is_finite())) {
            match (run, self.dashes) {
                ([], _) => {}
                ([point], _) => drawing.area(disc(*point, self.dot), self.colour),
                (_, Some(dashes)) => drawing.dashes(run, self.colour, self.width, dashes),
                (_, None) => drawing.line(run.to_vec(), self.colour, self.width),
            }
        }
    }
}

/// A disc about a place.
pub(crate) fn disc([x, y]: Point, radius: f64) -> Vec<Point> {
    (0..16)
        .map(|i| {
            let (sin, cos) = (f64::from(i) / 16.0 * std::f64::consts::TAU).sin_cos();
            [x + radius * cos, y + radius * sin]
        })
        .collect()
}

const BESIDE: f64 = 8.0;
const BETWEEN: f64 = 26.0;
const ROW: f64 = 24.0;

/// Samples with labels in rows, above the plots, where they cover no data.
pub(crate) struct Legend {
    /// Labels as far as there is room, with the left end and the top of their entries.
    entries: Vec<(String, Point)>,
    /// Length of a sample.
    sample: f64,
    /// Width of the longest row.
    pub(crate) width: f64,
    /// Height of all rows.
    pub(crate) height: f64,
}

impl Legend {
    /// Length of the line that stands for a series.
    pub(crate) const LINE: f64 = 34.0;
    /// Width of the patch that stands for a colour.
    pub(crate) const PATCH: f64 = 22.0;

    /// Entries of these labels, with samples of a length, in rows of at most `width`.
    pub(crate) fn new<'a>(
        labels: impl IntoIterator<Item = &'a str>,
        sample: f64,
        width: f64,
    ) -> Self {
        let (mut next, mut longest) = ([0.0, 0.0], 0.0_f64);
        let place = |label| {
            let label = measure::shortened(label, NORMAL, width - sample - BESIDE);
            let entry = sample + BESIDE + measure::width(&label, NORMAL);
            if next[0] > 0.0 && next[0] + entry > width {
                next = [0.0, next[1] + ROW];
            }
            let place = next;
            next[0] += entry + BETWEEN;
            longest = longest.max(next[0] - BETWEEN);
            (label, place)
        };
        let entries: Vec<_> = labels.into_iter().map(place).collect();
        let rows = entries.last().map_or(0.0, |(_, last)| last[1] / ROW + 1.0);
        Self {
            entries,
            sample,
            width: longest,
            height: rows * ROW,
        }
    }

    /// Draws the labels and, by `sample`, what stands before them: given the entry and the ends
    /// of the sample.
    pub(crate) fn draw(
        &self,
        drawing: &mut Drawing,
        [left, top]: Point,
        sample: impl Fn(&mut Drawing, usize, [Point; 2]),
    ) {
        for (i, (label, [x, y])) in self.entries.iter().enumerate() {
            let (start, y) = (left + x, top + y + 0.5 * ROW);
            let end = start + self.sample;
            sample(drawing, i, [[start, y], [end, y]]);
            drawing.text(label.as_str(), [end + BESIDE, y], Anchor::Left, NORMAL);
        }
    }
}

/// The patch of a colour between the ends of a sample.
pub(crate) fn patch([start, end]: [Point; 2]) -> Vec<Point> {
    let [above, below] = [start[1] - 7.0, start[1] + 7.0];
    let [left, right] = [start[0], end[0]];
    [[left, above], [right, above], [right, below], [left, below]].to_vec()
}

use plotters::style::RGBAColor;

use crate::axes::NORMAL;
use crate::drawing::{Anchor, Drawing, Point};

/// Dash and gap of the i-th series; the first is solid.
const DASHES: [Option<[f64; 2]>; 4] = [None, Some([9.0, 4.0]), Some([2.5, 3.5]), Some([14.0, 4.0])];

/// How a series is drawn: colour, dashes and width differ, so that series stay apart without
/// colour and where they lie on each other.
#[derive(Clone, Copy)]
pub(crate) struct Stroke {
    pub(crate) colour: RGBAColor,
    dashes: Option<[f64; 2]>,
    width: f64,
}

impl Stroke {
    pub(crate) fn of_series(i: usize) -> Self {
        Self {
            colour: crate::colour::series(i),
            dashes: DASHES[i % DASHES.len()],
            width: if i == 0 { 2.6 } else { 2.0 },
        }
    }

    /// Draws the runs of finite points; a run of one point is a dot.
    pub(crate) fn draw(&self, drawing: &mut Drawing, points: &[Point]) {
        for run in points.split(|p| !(p[0].is_finite() && p[1].is_finite())) {
            match (run, self.dashes) {
                ([], _) => {}
                ([point], _) => drawing.area(dot(*point), self.colour),
                (_, Some(dashes)) => drawing.dashes(run, self.colour, self.width, dashes),
                (_, None) => drawing.line(run.to_vec(), self.colour, self.width),
            }
        }
    }
}

fn dot([x, y]: Point) -> Vec<Point> {
    const RADIUS: f64 = 4.0;
    (0..16)
        .map(|i| {
            let (sin, cos) = (f64::from(i) / 16.0 * std::f64::consts::TAU).sin_cos();
            [x + RADIUS * cos, y + RADIUS * sin]
        })
        .collect()
}

/// Mean width of a character of the legend, logical pixels: an estimate on the safe side.
const CHARACTER: f64 = 0.47 * NORMAL;
const SAMPLE: f64 = 34.0;
const BETWEEN: f64 = 26.0;

/// Height of the legend of these labels when `width` is free for it.
pub(crate) fn height(labels: &[&str], width: f64) -> f64 {
    let rows = places(labels, width).last().map_or(0.0, |last| last[1]);
    rows + 24.0
}

/// Draws sample lines and labels above the plots, where they cover no data.
pub(crate) fn draw(drawing: &mut Drawing, labels: &[&str], left: f64, top: f64, width: f64) {
    let line = |drawing: &mut Drawing, i: usize, ends: [Point; 2]| {
        Stroke::of_series(i).draw(drawing, &ends);
    };
    draw_samples(drawing, labels, [left, top], width, line);
}

/// The same with samples drawn by `sample`, given the series and the ends of its line.
pub(crate) fn draw_samples(
    drawing: &mut Drawing,
    labels: &[&str],
    [left, top]: Point,
    width: f64,
    sample: impl Fn(&mut Drawing, usize, [Point; 2]),
) {
    for (i, (label, [x, y])) in labels.iter().zip(places(labels, width)).enumerate() {
        let (x, y) = (left + x, top + y + 12.0);
        sample(drawing, i, [[x, y], [x + SAMPLE, y]]);
        drawing.text(*label, [x + SAMPLE + 8.0, y], Anchor::Left, NORMAL);
    }
}

/// Left end and top of each entry, in rows.
fn places(labels: &[&str], width: f64) -> Vec<Point> {
    let mut next = [0.0, 0.0];
    labels
        .iter()
        .map(|label| {
            let entry = SAMPLE + 8.0 + CHARACTER * label.chars().count() as f64 + BETWEEN;
            if next[0] > 0.0 && next[0] + entry - BETWEEN > width {
                next = [0.0, next[1] + 24.0];
            }
            let place = next;
            next[0] += entry;
            place
        })
        .collect()
}

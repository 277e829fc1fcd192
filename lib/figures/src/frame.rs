//! The frame of a plot with its two axes.

use crate::axes::{Axis, NORMAL, SMALL};
use crate::colour::{BLACK, FAINT};
use crate::drawing::{Anchor, Drawing, Image, Point};
use crate::measure::{self, LINE, highest};

/// A rectangle of the drawing with an x and a y axis.
#[derive(Clone, Debug)]
pub(crate) struct Frame {
    pub(crate) left: f64,
    pub(crate) top: f64,
    pub(crate) width: f64,
    pub(crate) height: f64,
}

/// Length of a tick, and from the frame to its text.
const TICK: f64 = 5.0;
const BESIDE: f64 = 9.0;
const BELOW: f64 = 16.0;
/// From the ticks' texts to the middle of the first line of the title beside or below them.
const TITLE: f64 = 0.9 * NORMAL;
/// Most lines of an axis' title.
const MOST_LINES: usize = 3;

/// Lines of a title along an axis `length` long.
fn title(axis: &Axis, length: f64) -> Vec<String> {
    // A title may reach over both ends by a little, where nothing else stands.
    let room = (length + 1.5 * NORMAL).max(4.5 * NORMAL);
    let lines = |text| measure::lines(text, NORMAL, room, MOST_LINES);
    [lines(&axis.title), lines(&axis.note)].concat()
}

fn widest(axis: &Axis, height: f64) -> f64 {
    let ticks = axis.ticks(height, true);
    highest(ticks.iter().map(|(_, text)| measure::width(text, SMALL)))
}

/// Room that the ticks and title of an axis take on the left of a frame of this height.
pub(crate) fn room_beside(axis: &Axis, height: f64) -> f64 {
    let lines = title(axis, height).len() as f64;
    let ticks = BESIDE + widest(axis, height);
    match lines > 0.0 {
        true => ticks + TITLE + (lines - 0.5) * LINE * NORMAL,
        false => ticks + 2.0,
    }
}

/// The same for a frame that is at least so high.
pub(crate) fn most_beside(axis: &Axis, least: f64) -> f64 {
    highest([1.0, 2.0, 4.0].map(|times| room_beside(axis, times * least)))
}

/// Room that the ticks and title of an axis take below a frame of this width.
pub(crate) fn room_below(axis: &Axis, width: f64) -> f64 {
    let lines = title(axis, width).len() as f64;
    BELOW + 0.8 * SMALL + lines * LINE * NORMAL
}

impl Frame {
    pub(crate) fn new([left, top]: Point, [width, height]: [f64; 2]) -> Self {
        Self {
            left,
            top,
            width,
            height,
        }
    }

    /// Where a value pair lies.
    pub(crate) fn place(&self, x: &Axis, y: &Axis, value: [f64; 2]) -> Point {
        [
            self.left + x.share(value[0]) * self.width,
            self.top + (1.0 - y.share(value[1])) * self.height,
        ]
    }

    pub(crate) fn bottom(&self) -> f64 {
        self.top + self.height
    }

    pub(crate) fn right(&self) -> f64 {
        self.left + self.width
    }

    pub(crate) fn middle(&self) -> f64 {
        self.left + 0.5 * self.width
    }

    /// Frame, grid lines, ticks and tick texts; titles where an axis has one. With
    /// `grid = false` the ticks point outwards and no lines cross the frame (for maps).
    pub(crate) fn draw(&self, drawing: &mut Drawing, x: &Axis, y: &Axis, grid: bool) {
        let (bottom, right) = (self.bottom(), self.right());
        for (share, text) in x.ticks(self.width, false) {
            let at = self.left + share * self.width;
            if grid {
                drawing.line(vec![[at, self.top], [at, bottom]], FAINT, 1.0);
            }
            drawing.line(vec![[at, bottom], [at, bottom + TICK]], BLACK, 1.0);
            drawing.text(text, [at, bottom + BELOW], Anchor::Centre, SMALL);
        }
        for (share, text) in y.ticks(self.height, true) {
            let at = bottom - share * self.height;
            if grid {
                drawing.line(vec![[self.left, at], [right, at]], FAINT, 1.0);
            }
            drawing.line(vec![[self.left - TICK, at], [self.left, at]], BLACK, 1.0);
            drawing.text(text, [self.left - BESIDE, at], Anchor::Right, SMALL);
        }
        let corners = [
            [self.left, self.top],
            [right, self.top],
            [right, bottom],
            [self.left, bottom],
            [self.left, self.top],
        ];
        drawing.line(corners.to_vec(), BLACK, 1.0);
        let below = [self.middle(), bottom + BELOW + 1.3 * NORMAL];
        drawing.lines(&title(x, self.width), below, Anchor::Centre, NORMAL);
        let title = title(y, self.height);
        let lines = title.len() as f64;
        let beside =
            self.left - BESIDE - widest(y, self.height) - TITLE - (lines - 1.0) * LINE * NORMAL;
        let beside = [beside, self.top + 0.5 * self.height];
        drawing.lines(&title, beside, Anchor::Upwards, NORMAL);
    }

    /// Fills the frame with pixels: how many across and down, row by row from the top.
    pub(crate) fn fill(&self, drawing: &mut Drawing, size: [usize; 2], rgb: Vec<u8>) {
        let place = [self.left, self.top, self.width, self.height];
        drawing.images.push(Image { place, size, rgb });
    }
}

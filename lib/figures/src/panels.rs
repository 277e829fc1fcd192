//! Panels of equal scale with room for axes and captions.

use crate::axes::{NORMAL, SMALL};
use crate::drawing::{Anchor, Drawing};
use crate::frame::Frame;
use crate::measure::{self, LINE};
use crate::page::Page;

/// Panels of equal scale side by side in rows, with room for axes on the left and below and a
/// caption above each.
pub(crate) struct Panels {
    pub(crate) frames: Vec<Frame>,
    /// Right end of the last column.
    pub(crate) right: f64,
    /// Lower end of the last row.
    pub(crate) bottom: f64,
    /// Lines of each panel's name and detail.
    captions: Vec<[Vec<String>; 2]>,
}

/// One panel: width and height in any unit, name, and what is said below it.
pub(crate) struct Sheet<'a> {
    pub(crate) edges: [f64; 2],
    pub(crate) name: &'a str,
    pub(crate) detail: &'a str,
}

/// What the panels of a figure have in common, logical pixels.
#[derive(Clone, Copy)]
pub(crate) struct Layout {
    /// Top of the first row.
    pub(crate) top: f64,
    /// Longest edge of a panel.
    pub(crate) longest: f64,
    /// Room on the left of a panel and below it, for its axes.
    pub(crate) left: f64,
    pub(crate) below: f64,
    /// Room on the right of all, for a colour bar.
    pub(crate) right: f64,
}

/// From the right end of a panel to the next column.
const GAP: f64 = 14.0;
/// Least width of a panel with its caption, where the page has none.
const COLUMN: f64 = 110.0;
/// Most lines of a panel's name, and of its detail.
const MOST_LINES: usize = 3;
/// Height over width that panels of a given width are arranged to come near.
const SHAPE: f64 = 0.8;

impl Panels {
    /// Places the panels on a page: of the number of columns that is natural for their shape or,
    /// where the page has a width, of the number that fills it best.
    pub(crate) fn place(sheets: &[Sheet], layout: Layout, page: &Page) -> Self {
        let count = sheets.len().max(1);
        let largest = |axis: usize| sheets.iter().map(|s| s.edges[axis]).fold(0.0, f64::max);
        let edges = [largest(0), largest(1)];
        let natural = layout.longest / edges[0].max(edges[1]);
        let Some(width) = page.width() else {
            let most = if edges[0] < 0.6 * edges[1] { 6 } else { 3 };
            let columns = match count {
                4 if most == 3 => 2,
                n => n.min(most),
            };
            return Self::in_columns(sheets, layout, columns, natural, COLUMN);
        };
        let fitted = |columns: usize| {
            let room = ((width - layout.right) / columns as f64 - layout.left - GAP).max(1.0);
            Self::in_columns(sheets, layout, columns, natural.min(room / edges[0]), room)
        };
        // A panel has a caption, which is not to be broken to pieces.
        let least = layout.left + GAP + 4.0 * NORMAL;
        let most = ((width - layout.right) / least).clamp(1.0, count as f64) as usize;
        let distance = |panels: &Self| (panels.bottom / width / SHAPE).ln().abs();
        // No column more than the rows need.
        let even = |n: &usize| count.div_ceil(count.div_ceil(*n)) == *n;
        let all = (1..=most).filter(even).map(fitted);
        let best = all.min_by(|a, b| distance(a).total_cmp(&distance(b)));
        best.unwrap_or_else(|| fitted(1))
    }

    /// In columns that leave each panel at least `least` of width.
    fn in_columns(
        sheets: &[Sheet],
        layout: Layout,
        columns: usize,
        scale: f64,
        least: f64,
    ) -> Self {
        let size = |s: &Sheet| s.edges.map(|edge| edge * scale);
        let widest = sheets.iter().map(|s| size(s)[0]).fold(0.0, f64::max);
        let highest = sheets.iter().map(|s| size(s)[1]).fold(0.0, f64::max);
        let inner = widest.max(least);
        let column = layout.left + inner + GAP;
        let lines = |text, size| measure::lines(text, size, inner + GAP, MOST_LINES);
        let captions: Vec<_> = sheets
            .iter()
            .map(|s| [lines(s.name, NORMAL), lines(s.detail, SMALL)])
            .collect();
        let (mut frames, mut top) = (Vec::new(), layout.top);
        for (row, captions) in sheets.chunks(columns).zip(captions.chunks(columns)) {
            let above = captions.iter().map(caption_height).fold(0.0, f64::max);
            for (i, sheet) in row.iter().enumerate() {
                let [width, height] = size(sheet);
                let free = inner - width;
                frames.push(Frame {
                    left: i as f64 * column + layout.left + 0.5 * free,
                    top: top + above,
                    width,
                    height,
                });
            }
            top += above + highest + layout.below;
        }
        Self {
            frames,
            right: columns as f64 * column,
            bottom: top,
            captions,
        }
    }

    /// Draws each panel's name and detail above it.
    pub(crate) fn draw_captions(&self, drawing: &mut Drawing) {
        for (frame, caption) in self.frames.iter().zip(&self.captions) {
            let [name, detail] = caption;
            let mut y = frame.top - caption_height(caption) + 0.7 * NORMAL;
            for (lines, size) in [(name, NORMAL), (detail, SMALL)] {
                drawing.lines(lines, [frame.middle(), y], Anchor::Centre, size);
                y += lines.len() as f64 * LINE * size;
            }
        }
    }
}

fn caption_height([name, detail]: &[Vec<String>; 2]) -> f64 {
    LINE * (name.len() as f64 * NORMAL + detail.len() as f64 * SMALL) + 10.0
}

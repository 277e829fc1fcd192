//! Panels of equal scale with room for axes and captions.

use crate::axes::{Axis, NORMAL, SMALL};
use crate::colour_bar;
use crate::drawing::{Anchor, Drawing, Point};
use crate::frame::{Frame, most_beside, room_below};
use crate::legend::Legend;
use crate::measure::{self, LINE, highest};
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

/// One panel: width and height in any unit, name, what is said below it, and its axes across and up.
pub(crate) struct Sheet<'a> {
    pub(crate) edges: [f64; 2],
    pub(crate) name: &'a str,
    pub(crate) detail: &'a str,
    pub(crate) axes: Option<[Axis; 2]>,
    /// It stays in a row with the one before it.
    pub(crate) beside: bool,
}

impl<'a> Sheet<'a> {
    pub(crate) fn new(edges: [f64; 2], name: &'a str, axes: Option<[Axis; 2]>) -> Self {
        Self {
            edges,
            name,
            detail: "",
            axes,
            beside: false,
        }
    }
}

/// Room about the panels of a figure, logical pixels.
#[derive(Clone, Copy)]
pub(crate) struct Layout {
    /// Top of the first row.
    pub(crate) top: f64,
    /// Longest edge of a panel.
    pub(crate) longest: f64,
    /// Room on the left of a panel and below it, for its axes.
    pub(crate) left: f64,
    pub(crate) below: f64,
    /// Room on the right of all.
    pub(crate) right: f64,
}

/// Panels with a key above them and, where there are `shades`, a colour bar on their right.
pub(crate) struct Plate<'a> {
    pub(crate) sheets: Vec<Sheet<'a>>,
    pub(crate) key: Legend,
    pub(crate) shades: Option<Axis>,
    /// Longest edge of a panel, logical pixels.
    pub(crate) longest: f64,
    /// Room between the axes of a panel and what stands below it.
    pub(crate) apart: f64,
}

/// Margin on either side of keys and titles.
pub(crate) const MARGIN: f64 = 24.0;
/// About the least edge of a panel with axes.
const LEAST: f64 = 100.0;
/// From the right end of a panel to the next column.
const GAP: f64 = 14.0;
/// Least width of a panel with its caption, where the page has none.
const COLUMN: f64 = 110.0;
/// Most lines of a panel's name, and of its detail.
const MOST_LINES: usize = 3;
/// Height over width that panels of a given width are arranged to come near.
const SHAPE: f64 = 0.8;

impl Plate<'_> {
    /// The figure: `sample` draws what stands before an entry of the key, `draw` a panel by its number.
    pub(crate) fn draw(
        &self,
        page: Page,
        sample: impl Fn(&mut Drawing, usize, [Point; 2]),
        draw: impl Fn(&mut Drawing, usize, &Frame),
    ) -> Drawing {
        let axes = || self.sheets.iter().filter_map(|sheet| sheet.axes.as_ref());
        let layout = Layout {
            top: 10.0 + self.key.height,
            longest: self.longest,
            left: highest(axes().map(|[_, up]| most_beside(up, LEAST))) + 4.0,
            below: highest(axes().map(|[across, _]| room_below(across, LEAST))) + self.apart,
            right: self.shades.as_ref().map_or(0.0, colour_bar::width),
        };
        let panels = Panels::place(&self.sheets, layout, page);
        let natural = (panels.right + layout.right).max(self.key.width + 2.0 * MARGIN);
        let (top, height) = (panels.frames[0].top, panels.frames[0].height);
        let height = height.max(colour_bar::LEAST);
        let bottom = match self.shades {
            Some(_) => panels.bottom.max(top + height + MARGIN),
            None => panels.bottom,
        };
        let mut drawing = Drawing::new(page, page.width().unwrap_or(natural), bottom);
        self.key.draw(&mut drawing, [MARGIN, 8.0], sample);
        panels.draw_captions(&mut drawing);
        for (i, frame) in panels.frames.iter().enumerate() {
            draw(&mut drawing, i, frame);
        }
        if let Some(shades) = &self.shades {
            colour_bar::draw(&mut drawing, panels.right, top, height, shades);
        }
        drawing
    }
}

impl Panels {
    /// Places the panels on a page: of the number of columns that is natural for their shape or,
    /// where the page has a width, of the number that fills it best.
    pub(crate) fn place(sheets: &[Sheet], layout: Layout, page: Page) -> Self {
        let count = sheets.len().max(1);
        let edges = [0, 1].map(|axis| highest(sheets.iter().map(|s| s.edges[axis])));
        let natural = layout.longest / edges[0].max(edges[1]);
        let Some(width) = page.width() else {
            let columns = match count {
                n if edges[0] < 0.6 * edges[1] => n.min(6),
                4 => 2,
                n => n.min(3),
            };
            let together = 1 + usize::from(sheets.iter().any(|sheet| sheet.beside));
            let columns = columns - columns % together;
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
        let inner = highest(sheets.iter().map(|s| size(s)[0])).max(least);
        let tallest = highest(sheets.iter().map(|s| size(s)[1]));
        let column = layout.left + inner + GAP;
        let lines = |text, size| measure::lines(text, size, inner + GAP, MOST_LINES);
        let captions: Vec<_> = (sheets.iter())
            .map(|s| [lines(s.name, NORMAL), lines(s.detail, SMALL)])
            .collect();
        let (mut frames, mut top) = (Vec::new(), layout.top);
        for (row, captions) in sheets.chunks(columns).zip(captions.chunks(columns)) {
            let above = highest(captions.iter().map(caption_height));
            for (i, sheet) in row.iter().enumerate() {
                let size = size(sheet);
                let left = i as f64 * column + layout.left + 0.5 * (inner - size[0]);
                // On one floor: the fixed adherend stays in place where the clamp has shortened a scene.
                let top = top + above + tallest - size[1];
                frames.push(Frame::new([left, top], size));
            }
            top += above + tallest + layout.below;
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
            let mut y = frame.top - caption_height(caption) + 0.7 * NORMAL;
            for (lines, size) in caption.iter().zip([NORMAL, SMALL]) {
                drawing.lines(lines, [frame.middle(), y], Anchor::Centre, size);
                y += lines.len() as f64 * LINE * size;
            }
        }
    }
}

fn caption_height([name, detail]: &[Vec<String>; 2]) -> f64 {
    LINE * (name.len() as f64 * NORMAL + detail.len() as f64 * SMALL) + 10.0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A scene that the clamp has shortened: what is fixed lies below.
    #[test]
    fn panels_of_a_row_stand_on_one_floor() {
        let sheets = [[1.0, 2.0], [1.0, 1.5]].map(|edges| Sheet::new(edges, "", None));
        let layout = Layout {
            top: 0.0,
            longest: 100.0,
            left: 0.0,
            below: 0.0,
            right: 0.0,
        };
        let panels = Panels::in_columns(&sheets, layout, 2, 50.0, 0.0);
        // Pairs stay in a row and leave no part of it empty: six panels were a row of four and one of two.
        let mut pairs = [(); 6].map(|()| Sheet::new([1.0, 1.5], "", None));
        pairs[1].beside = true;
        let placed = Panels::place(&pairs, layout, Page::default());
        let tops = placed.frames.chunks(2).map(|row| (row[0].top, row[1].top));
        assert!(tops.is_sorted_by(|above, below| above.0 == above.1 && above.0 < below.0));
        let [a, b] = [0, 1].map(|i| panels.frames[i].top + panels.frames[i].height);
        assert_eq!(a, b);
    }
}

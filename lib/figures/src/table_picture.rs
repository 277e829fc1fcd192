//! Table 2 as a picture.

use std::collections::BTreeMap;

use crate::axes::{NORMAL, SMALL};
use crate::colour::BLACK;
use crate::drawing::{Anchor, Drawing};
use crate::known::SIDES;
use crate::measure::{self, LINE};
use crate::page::Page;
use crate::table2::{ERRORS, Row, Table2};

const WIDTH: f64 = 520.0;
const MARGIN: f64 = 12.0;
/// Width of a column of numbers, and how far names are set in below their adhesive.
const COLUMN: f64 = 58.0;
const COLUMNS: f64 = 4.0;
const INDENT: f64 = 14.0;
const ROW: f64 = 1.45 * NORMAL;

/// A table on its way down the page.
struct Column {
    drawing: Drawing,
    y: f64,
}

impl Column {
    fn rule(&mut self, width: f64) {
        let right = self.drawing.width - MARGIN;
        let ends = [MARGIN, right].map(|x| [x, self.y]);
        self.drawing.line(ends.to_vec(), BLACK, width);
        self.y += 0.35 * ROW;
    }

    /// A row: its name in as many lines as it needs, and texts.
    fn row(&mut self, name: &str, indent: f64, size: f64, cells: &[String]) {
        let left = MARGIN + indent;
        let first = self.drawing.width - MARGIN - COLUMNS * COLUMN;
        let free = match cells {
            [] => self.drawing.width - MARGIN,
            _ => first,
        };
        let lines = measure::lines(name, size, free - left, 5);
        self.y += 0.5 * ROW;
        (self.drawing).lines(&lines, [left, self.y], Anchor::Left, size);
        for (i, cell) in cells.iter().enumerate() {
            let right = first + (i as f64 + 1.0) * COLUMN;
            (self.drawing).text(cell.as_str(), [right, self.y], Anchor::Right, size);
        }
        self.y += 0.5 * ROW + (lines.len().max(1) - 1) as f64 * LINE * size;
    }

    fn case(&mut self, row: &Row, name: &str, paper: Option<[f64; 3]>) {
        let wp = row.known[..3].iter().map(|known| known.told(2));
        let (mut values, mut errors) = (Vec::new(), Vec::new());
        for mut told in wp {
            errors.push(told.get(1).map_or(String::new(), |e| format!("± {e}")));
            values.push(told.swap_remove(0));
        }
        values.push(format!("{:.2}", row.slab));
        self.row(name, INDENT, NORMAL, &values);
        let below = 2.0 * INDENT;
        if row.has_error() {
            self.row("error", below, SMALL, &errors);
        }
        if let Some(paper) = paper {
            self.row("paper", below, SMALL, &paper.map(|wp| format!("{wp:.2}")));
        }
        let ends = row.end.iter();
        for told in ends.flat_map(|end| end.mark().into_iter().chain(end.released())) {
            self.row(&told.replace(" um", " µm"), below, SMALL, &[]);
        }
    }
}

impl Table2 {
    /// The table as a picture for a page; `names` says how adhesives and cases are called in it.
    pub fn draw(&self, names: &BTreeMap<String, String>, page: Page) -> Drawing {
        let named = |key: &str| names.get(key).map_or(key.to_owned(), Clone::clone);
        let width = page.width().unwrap_or(WIDTH);
        let mut table = Column {
            drawing: Drawing::new(page, width, 0.0),
            y: MARGIN,
        };
        table.rule(1.8);
        let heads = [SIDES[0], SIDES[1], SIDES[2], "slab"].map(String::from);
        table.row("Weighted penetration (µm)", 0.0, NORMAL, &heads);
        table.y += 0.2 * ROW;
        table.rule(1.0);
        for group in self.rows.chunk_by(|a, b| a.adhesive == b.adhesive) {
            table.row(&named(&group[0].adhesive), 0.0, NORMAL, &[]);
            for row in group {
                table.case(row, &named(&row.case), self.paper_of(row));
            }
            table.y += 0.25 * ROW;
        }
        table.rule(1.8);
        let notes = [
            Some("slab: the unpenetrated slab of the same volume, t/√12"),
            self.has_errors().then_some(ERRORS),
            (self.paper).then_some("paper: Hammerquist and Nairn, Table 2; another specimen"),
        ];
        for note in notes.into_iter().flatten() {
            table.row(note, 0.0, SMALL, &[]);
        }
        let Column { mut drawing, y } = table;
        drawing.height = (y + MARGIN).ceil();
        drawing
    }
}

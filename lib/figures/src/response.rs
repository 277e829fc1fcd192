//! The response of a sweep to each of its parameters.

use crate::axes::{Axis, NORMAL};
use crate::colour::{DISTINCT, opaque};
use crate::column_name::worded;
use crate::drawing::{Anchor, Drawing, Point};
use crate::frame::{Frame, room_below, room_beside};
use crate::legend::{Legend, Stroke, disc};
use crate::measure::{self, LINE};
use crate::outcome::{Outcome, axis};
use crate::page::Page;
use crate::panels::{Layout, Panels, Sheet};
use crate::table::Table;
use crate::{Error, Labelled};

/// A result of a sweep with its error, pressure and time against each of its parameters, a panel each, from the CSV of
/// `bond-sweep collect`. Runs that differ in that parameter alone are joined by a line.
#[derive(Clone, Debug)]
pub struct Response {
    /// The one asked for, then those that stand beside it.
    results: Vec<Outcome>,
    /// Runs that ended at their time limit before closing.
    open: Vec<bool>,
    parameters: Vec<Parameter>,
    /// The cells of each row but the numbers of `parameters`.
    words: Vec<String>,
    page: Page,
}

#[derive(Clone, Debug)]
struct Parameter {
    name: String,
    values: Vec<f64>,
}

/// The column from which on a row holds results.
const FIRST_RESULT: &str = "status";
/// Results that stand beside the one asked for.
const BESIDE: [&str; 2] = ["pressure_pa", "time_s"];
/// Half the width of the ends of a bar, logical pixels.
const CAP: f64 = 5.0;

/// Longest and about the least edge of a panel, logical pixels, and height over width.
const LONGEST: f64 = 380.0;
const LEAST: f64 = 130.0;
const HEIGHT: f64 = 0.74;
const MARGIN: f64 = 24.0;

impl Response {
    /// Reads `result`, a column of numbers, known to a relative `error` (by default what small specimens show), pressure
    /// and time where there are any, and every parameter with more than one number; where
    /// there is none, the row.
    ///
    /// # Errors
    /// [`Error::Data`] for a table that is not of a sweep or a result without a number.
    pub fn read(sweep: &Labelled, result: &str, error: Option<f64>) -> Result<Self, Error> {
        let table = Table::read(&sweep.path)?;
        let values = table.data(result)?;
        let rows = values.len();
        let mut results = vec![Outcome::new(result, values, error)];
        for name in BESIDE.into_iter().filter(|name| *name != result) {
            let values = match table.has(name) {
                true => table.numbers(name)?,
                false => Vec::new(),
            };
            if values.iter().any(|value| value.is_finite()) {
                results.push(Outcome::new(name, values, None));
            }
        }
        let open = match table.has("end") {
            true => table
                .texts("end")?
                .iter()
                .map(|end| *end == "time-limit")
                .collect(),
            false => vec![false; rows],
        };
        let inputs = table.before(FIRST_RESULT)?;
        let mut parameters = Vec::new();
        let mut words = vec![Vec::new(); rows];
        for name in inputs.into_iter().filter(|name| *name != "row") {
            match table.numbers(name) {
                Ok(numbers) if varies(&numbers) => parameters.push(Parameter {
                    name: name.to_owned(),
                    values: numbers,
                }),
                _ => {
                    for (row, cell) in words.iter_mut().zip(table.texts(name)?) {
                        row.push(cell.to_owned());
                    }
                }
            }
        }
        if parameters.is_empty() {
            parameters.push(Parameter {
                name: "row".into(),
                values: (1..=rows).map(|row| row as f64).collect(),
            });
        }
        Ok(Self {
            results,
            open,
            parameters,
            words: words.into_iter().map(|row| distinct(&row)).collect(),
            page: Page::default(),
        })
    }

    /// The same for a page.
    pub fn on(self, page: Page) -> Self {
        Self { page, ..self }
    }

    /// The figure.
    pub fn draw(&self) -> Drawing {
        let kinds = self.kinds();
        let labels = match kinds.len() {
            2..=DISTINCT => &kinds[..],
            _ => &[],
        };
        let panels = self.panels().count().min(3) as f64;
        let room = self.page.width().unwrap_or(panels * LONGEST) - 2.0 * MARGIN;
        let key = Legend::new(labels.iter().copied(), Legend::LINE, room);
        let title = measure::lines(&self.title(), NORMAL, room, 3);
        let responses: Vec<Axis> = self.results.iter().map(Outcome::axis).collect();
        let across: Vec<Axis> = self.parameters.iter().map(Parameter::axis).collect();
        let sheet = |_| Sheet {
            edges: [1.0, HEIGHT],
            name: "",
            detail: "",
        };
        let sheets: Vec<Sheet> = self.panels().map(sheet).collect();
        let beside = responses
            .iter()
            .map(|axis| room_beside(axis, HEIGHT * LEAST));
        let below = across.iter().map(|axis| room_below(axis, LEAST));
        let layout = Layout {
            top: 12.0 + LINE * NORMAL * title.len() as f64 + key.height(),
            longest: LONGEST,
            left: beside.fold(0.0, f64::max) + 6.0,
            below: below.fold(0.0, f64::max) + 6.0,
            right: MARGIN,
        };
        let panels = Panels::place(&sheets, layout, &self.page);
        let page = (self.page.width())
            .unwrap_or(panels.right + layout.right)
            .max(key.width() + 2.0 * MARGIN);
        let mut drawing = Drawing::new(self.page, page, panels.bottom);
        drawing.lines(&title, [0.5 * page, 16.0], Anchor::Centre, NORMAL);
        let under = 10.0 + LINE * NORMAL * title.len() as f64;
        key.draw(&mut drawing, [MARGIN, under], |drawing, kind, ends| {
            Stroke::of_series(kind).draw(drawing, &ends);
        });
        for (frame, panel) in panels.frames.iter().zip(self.panels()) {
            let axes = [&across[panel[0]], &responses[panel[1]]];
            frame.draw(&mut drawing, axes[0], axes[1], true);
            for (kind, path) in self.paths(panel) {
                let kind = if labels.is_empty() { 0 } else { kind };
                self.draw_path(&mut drawing, frame, axes, panel, (kind, &path));
            }
        }
        drawing
    }

    /// Parameter and result of each panel.
    fn panels(&self) -> impl Iterator<Item = [usize; 2]> {
        let results = 0..self.results.len();
        (0..self.parameters.len()).flat_map(move |i| results.clone().map(move |k| [i, k]))
    }

    /// How many runs there are, and what bars and rings are.
    fn title(&self) -> String {
        let runs = self.open.len();
        let mut title = format!("{runs} run{}", if runs == 1 { "" } else { "s" });
        let values = &self.results[0].values;
        match values.iter().filter(|v| !v.is_finite()).count() {
            0 => {}
            n => title += &format!(", of which {n} have no result"),
        }
        match self.open.iter().filter(|open| **open).count() {
            0 => {}
            n => title += &format!("; rings: {n} did not close"),
        }
        if self.results.iter().any(|result| result.error > 0.0) {
            title += "; bars: error by the size of the cells";
        }
        title
    }

    /// A line through the runs of a path, a dot on each with its error; a ring where the press did not close.
    fn draw_path(
        &self,
        drawing: &mut Drawing,
        frame: &Frame,
        [across, response]: [&Axis; 2],
        [parameter, result]: [usize; 2],
        (kind, path): (usize, &[usize]),
    ) {
        let own = &self.parameters[parameter].values;
        let Outcome { values, error, .. } = &self.results[result];
        let place =
            |row: usize, value: f64| -> Point { frame.place(across, response, [own[row], value]) };
        let stroke = Stroke::of_series(kind);
        let places: Vec<Point> = path.iter().map(|&row| place(row, values[row])).collect();
        stroke.draw(drawing, &places);
        for (&row, &dot) in path.iter().zip(&places) {
            if *error > 0.0 {
                let ends = [1.0 - error, 1.0 + error].map(|part| place(row, part * values[row]));
                drawing.line(ends.to_vec(), stroke.colour, 1.4);
                for [x, y] in ends {
                    drawing.line(vec![[x - CAP, y], [x + CAP, y]], stroke.colour, 1.4);
                }
            }
            stroke.draw(drawing, &[dot]);
            if self.open[row] {
                drawing.area(disc(dot, 2.2), opaque([255; 3]));
            }
        }
    }

    /// What tells rows apart beside numbers, in the order of the table.
    fn kinds(&self) -> Vec<&str> {
        let mut kinds: Vec<&str> = Vec::new();
        for words in &self.words {
            if !kinds.contains(&words.as_str()) {
                kinds.push(words);
            }
        }
        kinds
    }

    /// Rows with result `result` that differ in parameter `i` alone, by its values; and which of the kinds
    /// they are.
    fn paths(&self, [i, result]: [usize; 2]) -> Vec<(usize, Vec<usize>)> {
        let kinds = self.kinds();
        let others = |row: usize| -> (&str, Vec<u64>) {
            let rest = self.parameters.iter().enumerate().filter(|(k, _)| *k != i);
            let rest = rest.map(|(_, parameter)| parameter.values[row].to_bits());
            (&self.words[row], rest.collect())
        };
        let mut paths: Vec<(usize, Vec<usize>)> = Vec::new();
        let own = &self.parameters[i].values;
        let values = &self.results[result].values;
        let shown = |row: &usize| own[*row].is_finite() && values[*row].is_finite();
        for row in (0..values.len()).filter(shown) {
            match paths
                .iter_mut()
                .find(|(_, path)| others(path[0]) == others(row))
            {
                Some((_, path)) => path.push(row),
                None => {
                    let kind = kinds.iter().position(|kind| *kind == self.words[row]);
                    paths.push((kind.unwrap_or(0), vec![row]));
                }
            }
        }
        for (_, path) in &mut paths {
            path.sort_by(|a, b| own[*a].total_cmp(&own[*b]));
        }
        paths
    }
}

impl Parameter {
    fn axis(&self) -> Axis {
        axis(&worded(&self.name), self.values.iter().copied())
    }
}

fn varies(numbers: &[f64]) -> bool {
    let mut finite = numbers.iter().filter(|v| v.is_finite());
    let first = finite.next();
    finite.any(|other| Some(other) != first)
}

/// The words of a row that say something.
fn distinct(row: &[String]) -> String {
    let words: Vec<&str> = row
        .iter()
        .map(String::as_str)
        .filter(|w| !w.is_empty())
        .collect();
    words.join(", ")
}

//! The response of a sweep to each of its parameters.

use units::Pressure;

use crate::axes::{Axis, NORMAL};
use crate::colour::{DISTINCT, opaque};
use crate::column_name::worded;
use crate::drawing::{Anchor, Drawing, Point};
use crate::frame::{Frame, room_below, room_beside};
use crate::legend::{Legend, Stroke, disc};
use crate::measure::{self, LINE, highest};
use crate::outcome::{Outcome, axis};
use crate::page::Page;
use crate::panels::{Layout, MARGIN, Panels, Sheet};
use crate::table::Table;
use crate::{Error, Labelled};

/// A sweep: results and parameters of its runs.
#[derive(Clone, Debug)]
struct Sweep {
    /// The one asked for, then those that stand beside it.
    results: Vec<Outcome>,
    /// Runs that did not close.
    open: Vec<bool>,
    /// Names and values.
    parameters: Vec<(String, Vec<f64>)>,
    /// The cells of each row but the numbers of `parameters`.
    words: Vec<String>,
}

/// The column from which on a row holds results.
const FIRST_RESULT: &str = "status";
/// Results that grow with penetration, also of presses that did not close, and the one drawn of a table without them.
const ENTERED: [&str; 2] = ["entered_share", "mean_depth_um"];
const ELSE: &str = "wp_um";
/// Results that stand beside the one asked for.
const BESIDE: [&str; 2] = ["pressure_pa", "time_s"];
/// Share of the gap left from which a press is open.
const OPEN: f64 = 1e-3;
/// Half the width of the ends of a bar, logical pixels.
const CAP: f64 = 5.0;

/// Longest and about the least edge of a panel, logical pixels, and height over width.
const LONGEST: f64 = 380.0;
const LEAST: f64 = 130.0;
const HEIGHT: f64 = 0.74;

/// A `result` of a sweep, a column of numbers (by default the share of the adhesive that entered the wood, with its mean
/// depth), known to a relative `error` (by default what small specimens show),
/// pressure and time where there are any, against each of its parameters with more than one number or, where there is
/// none, the row: a panel each, from the CSV of `bond-sweep collect`. Runs that differ in that parameter alone are joined
/// by a line.
///
/// # Errors
/// [`Error::Data`] for a table that is not of a sweep or a result without a number; [`Error::Request`] for one that it lacks.
pub fn response<'a>(
    sweep: &Labelled,
    result: impl Into<Option<&'a str>>,
    error: Option<f64>,
    page: Page,
) -> Result<Drawing, Error> {
    Ok(Sweep::read(sweep, result.into(), error)?.draw(page))
}

impl Sweep {
    fn read(sweep: &Labelled, result: Option<&str>, error: Option<f64>) -> Result<Self, Error> {
        let table = Table::read(&sweep.path)?;
        let drawn = [ENTERED[0], ELSE].into_iter().find(|name| table.has(name));
        let result = result.or(drawn).unwrap_or(ELSE);
        // A run that failed or is not sound has no results.
        let status = table.texts(FIRST_RESULT)?;
        let numbers = |name: &str| table.some_numbers(name, |row| status[row] != "sound");
        if !table.has(result) {
            return Err(Error::Request(table.without(result)));
        }
        let values = numbers(result)?;
        let rows = values.len();
        let limits = limits(&table, rows);
        let outcome = |name: &str, values: Vec<f64>, error: Option<f64>| {
            let outcome = Outcome::new(name, values, error);
            match name == BESIDE[0] && error.is_none() {
                true => outcome.held(&limits),
                false => outcome,
            }
        };
        let mut results = vec![outcome(result, values, error)];
        let depth = Some(ENTERED[1]).filter(|_| result == ENTERED[0]);
        for name in
            (depth.into_iter().chain(BESIDE)).filter(|name| *name != result && table.has(name))
        {
            // Where nothing has entered there is no depth.
            let may_lack = |row: usize| status[row] != "sound" || depth == Some(name);
            let values = table.numbers_but(name, may_lack)?;
            if values.iter().any(|value| value.is_finite()) {
                results.push(outcome(name, values, None));
            }
        }
        let ends = match table.has("end") {
            true => table.texts("end")?,
            false => vec![""; rows],
        };
        let left = match table.has("gap_share") {
            true => table.numbers_but("gap_share", |_| true)?,
            false => vec![f64::NAN; rows],
        };
        let mut parameters = Vec::new();
        let mut words = vec![Vec::new(); rows];
        let inputs = table.before(FIRST_RESULT)?.into_iter();
        for name in inputs.filter(|name| *name != "row") {
            match table.numbers_but(name, |_| true) {
                Ok(numbers) if varies(&numbers) => parameters.push((name.to_owned(), numbers)),
                // The words of a row that say something.
                _ => (words.iter_mut().zip(table.texts(name)?))
                    .filter(|(_, cell)| !cell.is_empty())
                    .for_each(|(row, cell)| row.push(cell)),
            }
        }
        if parameters.is_empty() {
            let numbers = (1..=rows).map(|row| row as f64);
            parameters.push(("row".into(), numbers.collect()));
        }
        Ok(Self {
            results,
            open: (ends.iter().zip(left))
                .map(|(end, left)| *end == "time-limit" || left > OPEN)
                .collect(),
            parameters,
            words: words.iter().map(|row| row.join(", ")).collect(),
        })
    }

    fn draw(&self, page: Page) -> Drawing {
        let labels = self.labels();
        let labels = match labels.len() {
            2..=DISTINCT => &labels[..],
            _ => &[],
        };
        let columns = self.panels().count().min(3) as f64;
        let room = page.width().unwrap_or(columns * LONGEST) - 2.0 * MARGIN;
        let key = Legend::new(labels.iter().map(String::as_str), Legend::LINE, room);
        let title = measure::lines(&self.title(), NORMAL, room, 3);
        let responses: Vec<Axis> = self.results.iter().map(Outcome::axis).collect();
        let across =
            |(name, values): &(String, Vec<f64>)| axis(&worded(name), values.iter().copied());
        let across: Vec<Axis> = self.parameters.iter().map(across).collect();
        let sheets = self.panels().map(|_| Sheet::new([1.0, HEIGHT], "", None));
        let sheets: Vec<Sheet> = sheets.collect();
        let under = 10.0 + LINE * NORMAL * title.len() as f64;
        let layout = Layout {
            top: 12.0 + LINE * NORMAL * title.len() as f64 + key.height,
            longest: LONGEST,
            left: highest(responses.iter().map(|y| room_beside(y, HEIGHT * LEAST))) + 6.0,
            below: highest(across.iter().map(|x| room_below(x, LEAST))) + 6.0,
            right: MARGIN,
        };
        let panels = Panels::place(&sheets, layout, page);
        let natural = (panels.right + layout.right).max(key.width + 2.0 * MARGIN);
        let width = page.width().unwrap_or(natural);
        let mut drawing = Drawing::new(page, width, panels.bottom);
        drawing.lines(&title, [0.5 * width, 16.0], Anchor::Centre, NORMAL);
        key.draw(&mut drawing, [MARGIN, under], |drawing, kind, ends| {
            Stroke::of_series(kind).draw(drawing, &ends);
        });
        for (frame, panel) in panels.frames.iter().zip(self.panels()) {
            let axes = [&across[panel[0]], &responses[panel[1]]];
            frame.draw(&mut drawing, axes[0], axes[1], true);
            for path in self.paths(panel) {
                let own = self.label(panel[0], path[0]);
                let kind = labels.iter().position(|label| *label == own).unwrap_or(0);
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
            n => title += &format!(", {n} of them without a result"),
        }
        match self.open.iter().filter(|open| **open).count() {
            0 => {}
            n => title += &format!("; rings: {n} did not close"),
        }
        let errors = || self.results.iter().flat_map(|result| &result.errors);
        if errors().any(|error| *error > 0.0) {
            title += "; bars: error due to the cell size";
        }
        if self.labels().len() > DISTINCT {
            title += "; lines: runs that differ in one parameter alone";
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
        let own = &self.parameters[parameter].1;
        let Outcome { values, errors, .. } = &self.results[result];
        let place =
            |row: usize, value: f64| -> Point { frame.place(across, response, [own[row], value]) };
        let stroke = Stroke::of_series(kind);
        let places: Vec<Point> = path.iter().map(|&row| place(row, values[row])).collect();
        stroke.draw(drawing, &places);
        for (&row, &dot) in path.iter().zip(&places) {
            let error = errors[row];
            if error > 0.0 {
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

    /// Label of a line through `row` over parameter `i`, apart from the others of its panel: words and the other parameters.
    fn label(&self, i: usize, row: usize) -> String {
        let others = self.parameters.iter().enumerate().filter(|(k, _)| *k != i);
        let others = others.map(|(_, (name, values))| format!("{} {}", worded(name), values[row]));
        let words = Some(self.words[row].clone()).filter(|words| !words.is_empty());
        words
            .into_iter()
            .chain(others)
            .collect::<Vec<_>>()
            .join(", ")
    }

    /// Those of all lines, in the order of panels and rows.
    fn labels(&self) -> Vec<String> {
        let mut labels: Vec<String> = Vec::new();
        for panel in self.panels() {
            for path in self.paths(panel) {
                let label = self.label(panel[0], path[0]);
                if !labels.contains(&label) {
                    labels.push(label);
                }
            }
        }
        labels
    }

    /// Rows with result `result` that differ in parameter `i` alone, by its values.
    fn paths(&self, [i, result]: [usize; 2]) -> Vec<Vec<usize>> {
        let mut paths: Vec<(String, Vec<usize>)> = Vec::new();
        let own = &self.parameters[i].1;
        let values = &self.results[result].values;
        let shown = |row: &usize| own[*row].is_finite() && values[*row].is_finite();
        for row in (0..values.len()).filter(shown) {
            let label = self.label(i, row);
            match paths.iter_mut().find(|(other, _)| *other == label) {
                Some((_, path)) => path.push(row),
                None => paths.push((label, vec![row])),
            }
        }
        for (_, path) in &mut paths {
            path.sort_by(|a, b| own[*a].total_cmp(&own[*b]));
        }
        paths.into_iter().map(|(_, path)| path).collect()
    }
}

/// Largest pressure of the clamp in each row, Pa, where it is a parameter; else NaN.
fn limits(table: &Table, rows: usize) -> Vec<f64> {
    let limit = |header: &str| {
        let unit = header.strip_prefix("clamp.max_pressure")?.replace('_', " ");
        let cells = table.texts(header).ok()?.into_iter();
        let si = |cell: &str| units::si::<Pressure>(&format!("{cell}{unit}"));
        Some(cells.map(|cell| si(cell).unwrap_or(f64::NAN)).collect())
    };
    let found = table.headers().iter().find_map(limit);
    found.unwrap_or_else(|| vec![f64::NAN; rows])
}

fn varies(numbers: &[f64]) -> bool {
    let mut finite = numbers.iter().filter(|v| v.is_finite());
    let first = finite.next();
    finite.any(|other| Some(other) != first)
}

//! The response of a sweep to each of its parameters.

use crate::axes::{Axis, NORMAL};
use crate::colour::DISTINCT;
use crate::drawing::{Anchor, Drawing, Point};
use crate::frame::{Frame, room_below, room_beside};
use crate::legend::{Legend, Stroke};
use crate::measure::{self, LINE};
use crate::page::Page;
use crate::panels::{Layout, Panels, Sheet};
use crate::table::Table;
use crate::{Error, Labelled};

/// A result of a sweep against each of its parameters, a panel each, from the CSV of
/// `bond-sweep collect`. Runs that differ in that parameter alone are joined by a line.
#[derive(Clone, Debug)]
pub struct Response {
    result: String,
    /// Values of the result; NaN where a run has none.
    values: Vec<f64>,
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
/// Parameters whose largest value is more than so many times the smallest get a logarithmic axis.
const LOGARITHMIC: f64 = 20.0;

/// Longest and about the least edge of a panel, logical pixels, and height over width.
const LONGEST: f64 = 380.0;
const LEAST: f64 = 130.0;
const HEIGHT: f64 = 0.74;
const MARGIN: f64 = 24.0;

impl Response {
    /// Reads `result`, a column of numbers, and every parameter with more than one number; where
    /// there is none, the row.
    ///
    /// # Errors
    /// [`Error::Data`] for a table that is not of a sweep or a result without a number.
    pub fn read(sweep: &Labelled, result: &str) -> Result<Self, Error> {
        let table = Table::read(&sweep.path)?;
        let values = table.data(result)?;
        let inputs = table.before(FIRST_RESULT)?;
        let mut parameters = Vec::new();
        let mut words = vec![Vec::new(); values.len()];
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
                values: (1..=values.len()).map(|row| row as f64).collect(),
            });
        }
        Ok(Self {
            result: result.to_owned(),
            values,
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
        let room = self.page.width().unwrap_or(LONGEST) - 2.0 * MARGIN;
        let key = Legend::new(labels.iter().copied(), Legend::LINE, room);
        let title = measure::lines(&self.title(), NORMAL, room, 3);
        let response = Axis::linear(worded(&self.result), self.values.iter().copied());
        let across: Vec<Axis> = self.parameters.iter().map(Parameter::axis).collect();
        let sheet = |_| Sheet {
            edges: [1.0, HEIGHT],
            name: "",
            detail: "",
        };
        let sheets: Vec<Sheet> = self.parameters.iter().map(sheet).collect();
        let below = across.iter().map(|axis| room_below(axis, LEAST));
        let layout = Layout {
            top: 12.0 + LINE * NORMAL * title.len() as f64 + key.height(),
            longest: LONGEST,
            left: room_beside(&response, HEIGHT * LEAST) + 6.0,
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
        for (i, (frame, across)) in panels.frames.iter().zip(&across).enumerate() {
            frame.draw(&mut drawing, across, &response, true);
            for (kind, path) in self.paths(i) {
                let kind = if labels.is_empty() { 0 } else { kind };
                self.draw_path(&mut drawing, frame, [across, &response], i, (kind, &path));
            }
        }
        drawing
    }

    fn title(&self) -> String {
        let runs = self.values.len();
        match self.values.iter().filter(|v| !v.is_finite()).count() {
            0 if runs == 1 => "1 run".to_owned(),
            0 => format!("{runs} runs"),
            n => format!("{runs} runs, of which {n} have no result"),
        }
    }

    /// A line through the runs of a path, a dot on each.
    fn draw_path(
        &self,
        drawing: &mut Drawing,
        frame: &Frame,
        [across, response]: [&Axis; 2],
        parameter: usize,
        (kind, path): (usize, &[usize]),
    ) {
        let values = &self.parameters[parameter].values;
        let places = (path.iter()).map(|&row| [values[row], self.values[row]]);
        let places: Vec<Point> = places
            .map(|value| frame.place(across, response, value))
            .collect();
        let stroke = Stroke::of_series(kind);
        stroke.draw(drawing, &places);
        for place in places {
            stroke.draw(drawing, &[place]);
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

    /// Rows with a result that differ in parameter `i` alone, by its values; and which of the kinds
    /// they are.
    fn paths(&self, i: usize) -> Vec<(usize, Vec<usize>)> {
        let kinds = self.kinds();
        let others = |row: usize| -> (&str, Vec<u64>) {
            let rest = self.parameters.iter().enumerate().filter(|(k, _)| *k != i);
            let rest = rest.map(|(_, parameter)| parameter.values[row].to_bits());
            (&self.words[row], rest.collect())
        };
        let mut paths: Vec<(usize, Vec<usize>)> = Vec::new();
        let own = &self.parameters[i].values;
        let shown = |row: &usize| own[*row].is_finite() && self.values[*row].is_finite();
        for row in (0..self.values.len()).filter(shown) {
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
        let finite = || self.values.iter().copied().filter(|v| v.is_finite());
        let [low, high] = [f64::min, f64::max].map(|pick| finite().fold(f64::NAN, pick));
        let name = worded(&self.name);
        match low > 0.0 && high > LOGARITHMIC * low {
            true => Axis::logarithmic(name, finite()),
            false => Axis::linear(name, finite()),
        }
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

/// A column's name as it stands on an axis: `adhesive.viscosity_Pa_s` as `adhesive.viscosity (Pa s)`.
fn worded(column: &str) -> String {
    let known = |unit: &str| match unit {
        "um3" => Some("µm³".to_owned()),
        "pa" => Some("Pa".to_owned()),
        "cell" => Some("cells".to_owned()),
        "voxel" | "voxels" => Some("voxels".to_owned()),
        unit => units::unit(unit).map(|_| unit.replace("um", "µm")),
    };
    // The longest unit: some hold a blank, which is an underscore here.
    let found = column.match_indices('_').find_map(|(at, _)| {
        let unit = known(&column[at + 1..].replace('_', " "))?;
        Some(format!("{} ({unit})", spaced(&column[..at])))
    });
    found.unwrap_or_else(|| spaced(column))
}

/// The name of a result in words; keys of the case stay as they are written there.
fn spaced(name: &str) -> String {
    match name.contains('.') {
        true => name.to_owned(),
        false => name.replace('_', " "),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_worded_with_their_units() {
        for (column, words) in [
            ("ep_um", "ep (µm)"),
            ("slab_wp_um", "slab wp (µm)"),
            ("adhesive.viscosity_Pa_s", "adhesive.viscosity (Pa s)"),
            ("volume_um3", "volume (µm³)"),
            ("clamp.max_pressure_MPa", "clamp.max_pressure (MPa)"),
            ("integrator.cfl", "integrator.cfl"),
            ("steps", "steps"),
        ] {
            assert_eq!(worded(column), words);
        }
    }
}

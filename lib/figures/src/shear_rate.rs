//! The figure of shear rates against time.

use crate::axes::{Axis, NORMAL, extent};
use crate::closing::time_unit;
use crate::colour::{BLACK, faded, series};
use crate::drawing::{Anchor, Drawing, Point};
use crate::frame::{Frame, room_below, room_beside};
use crate::legend::{self, Legend};
use crate::measure::{self, LINE};
use crate::page::Page;
use crate::panels::MARGIN;
use crate::penetration::LONG;
use crate::plot::LEAST;
use crate::table::Table;
use crate::{Error, Labelled};

#[derive(Clone, Debug)]
struct Panel {
    label: String,
    /// s
    time: Vec<f64>,
    /// 1/s; in the order of `QUANTILES`
    quantiles: Vec<Vec<f64>>,
    /// 1/s
    max: Vec<f64>,
}

/// Columns of the bands from the outside in, and the median in the middle.
const QUANTILES: [&str; 7] = ["q05", "q10", "q25", "q50", "q75", "q90", "q95"];
/// Bands by the indices of their lower and upper quantile, name and opacity.
const BANDS: [(usize, usize, &str, f64); 3] = [
    (0, 6, "5 to 95 %", 0.18),
    (1, 5, "10 to 90 %", 0.25),
    (2, 4, "25 to 75 %", 0.40),
];

/// Widest and narrowest panel, logical pixels.
const PANEL: [f64; 2] = [590.0, 250.0];
const BETWEEN: f64 = 30.0;
/// Most panels side by side.
const COLUMNS: usize = 3;

/// Quantiles of the shear rate against time, one panel per run with a common axis of rates (Figs. 10
/// and 11 of the paper), from the CSV of `shear-stats`.
///
/// # Errors
/// [`Error::Data`] for an unreadable file, a missing column, or one without numbers.
pub fn shear_rates(runs: &[Labelled], page: Page) -> Result<Drawing, Error> {
    let panels = runs.iter().map(Panel::read);
    let panels = panels.collect::<Result<Vec<_>, _>>()?;
    let rates = || panels.iter().flat_map(Panel::rates).copied();
    let rate = |title| Axis::logarithmic(title, rates());
    let (titled, untitled) = (rate("shear rate (1/s)"), rate(""));
    let outer = room_beside(&titled, PANEL[1]) + 4.0;
    let between = BETWEEN + room_beside(&untitled, PANEL[1]);
    let count = panels.len().min(COLUMNS);
    let room =
        |width: f64, columns: f64| (width - outer - MARGIN - (columns - 1.0) * between) / columns;
    let fits = |page: f64| (1..=count).rfind(|&n| room(page, n as f64) >= PANEL[1]);
    let columns = page.width().map_or(count, |page| fits(page).unwrap_or(1));
    let natural = outer + MARGIN + columns as f64 * (PANEL[0] + between) - between;
    let across = page.width().unwrap_or(natural);
    let width = room(across, columns as f64);
    let height = (0.62 * width).max(200.0);
    let key = key(across - 2.0 * MARGIN);
    let title = |panel: &Panel| measure::lines(&panel.label, NORMAL, width + 1.8 * MARGIN, 3);
    let below = room_below(&panels[0].time_axis().0, width) + 6.0;
    let (mut frames, mut top) = (Vec::new(), 14.0 + key.height);
    for row in panels.chunks(columns) {
        let titles = row.iter().map(|panel| title(panel).len()).max();
        top += LINE * NORMAL * titles.unwrap_or(0) as f64 + 10.0;
        let left = |i: usize| outer + i as f64 * (width + between);
        let frame = |i| Frame::new([left(i), top], [width, height]);
        frames.extend((0..row.len()).map(frame));
        top += height + below;
    }
    let mut drawing = Drawing::new(page, across, top);
    key.draw(&mut drawing, [MARGIN, 8.0], sample);
    for (i, (panel, frame)) in panels.iter().zip(&frames).enumerate() {
        let title = title(panel);
        let first = frame.top - 16.0 - LINE * NORMAL * (title.len() as f64 - 1.0);
        drawing.lines(&title, [frame.middle(), first], Anchor::Centre, NORMAL);
        let first = i % columns == 0;
        panel.draw(&mut drawing, frame, if first { &titled } else { &untitled });
    }
    Ok(drawing)
}

/// What the bands and lines are.
fn key(width: f64) -> Legend {
    let names = BANDS.iter().map(|band| band.2);
    Legend::new(names.chain(["median", "maximum"]), Legend::PATCH, width)
}

/// A band as dark as it is in a panel, where it lies over those around it; or a line.
fn sample(drawing: &mut Drawing, entry: usize, ends: [Point; 2]) {
    for (_, _, _, opacity) in BANDS.iter().take(entry + 1).filter(|_| entry < BANDS.len()) {
        drawing.area(legend::patch(ends), faded(series(0), *opacity));
    }
    match entry.checked_sub(BANDS.len()) {
        Some(0) => drawing.line(ends.to_vec(), BLACK, 3.0),
        Some(_) => drawing.dashes(&ends, BLACK, 1.4, [5.0, 3.0]),
        None => {}
    }
}

impl Panel {
    fn read(source: &Labelled) -> Result<Self, Error> {
        let table = Table::read(&source.path)?;
        let quantiles = QUANTILES.iter().map(|q| table.numbers(q));
        let max = table.numbers("max")?;
        if !max.iter().any(|rate| *rate > 0.0) {
            return Err(Error::Data(format!(
                "'{}' has no shear rate above zero: nothing flows in these states",
                table.name()
            )));
        }
        Ok(Self {
            label: source.label.clone(),
            time: table.numbers("time_s")?,
            quantiles: quantiles.collect::<Result<_, _>>()?,
            max,
        })
    }

    fn rates(&self) -> impl Iterator<Item = &f64> {
        self.quantiles.iter().flatten().chain(&self.max)
    }

    /// Its axis and the unit of time, s.
    fn time_axis(&self) -> (Axis, f64) {
        let (unit, name) = time_unit(extent(self.time.iter().copied()).1);
        let times = || self.time.iter().map(|t| t / unit);
        let (first, last) = extent(times().filter(|t| *t > 0.0));
        let title = format!("time ({name})");
        let axis = match last > LONG * first {
            true => Axis::logarithmic(&title, times()),
            false => Axis::over(&title, 0.0, last),
        };
        (axis, unit)
    }

    fn draw(&self, drawing: &mut Drawing, frame: &Frame, rate: &Axis) {
        let (time, unit) = self.time_axis();
        let times = self.time.iter().map(|t| t / unit);
        frame.draw(drawing, &time, rate, true);
        // A rate of zero, as before the start, has no place on a logarithmic axis; of a band
        // whose upper end has one, the lower end lies on the edge.
        let places = |values: &[f64], shown: &[f64]| -> Vec<[f64; 2]> {
            let rows = times.clone().zip(values).zip(shown);
            let rows = rows.filter(|(_, shown)| **shown > 0.0);
            let places = rows.map(|((t, v), _)| frame.place(&time, rate, [t, v.max(LEAST)]));
            places.filter(|place| place[0].is_finite()).collect()
        };
        let line = |values: &[f64]| places(values, values);
        for (low, high, _, opacity) in BANDS {
            let mut outline = places(&self.quantiles[low], &self.quantiles[high]);
            outline.extend(line(&self.quantiles[high]).into_iter().rev());
            drawing.area(outline, faded(series(0), opacity));
        }
        drawing.dashes(&line(&self.max), BLACK, 1.4, [5.0, 3.0]);
        let median = line(&self.quantiles[3]);
        if let [[x, y]] = median[..] {
            // One snapshot has no line: bars from q05 to q95 and a mark at the median.
            let ends = [0, 6].map(|q| line(&self.quantiles[q]));
            if let [[low, ..], [high, ..]] = &ends.each_ref().map(Vec::as_slice) {
                drawing.line(vec![*low, *high], series(0), 3.0);
            }
            drawing.line(vec![[x - 8.0, y], [x + 8.0, y]], BLACK, 3.0);
        } else {
            drawing.line(median, BLACK, 3.0);
        }
    }
}

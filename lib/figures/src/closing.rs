//! The figure of pressure and closing speed against time.

use plotters::style::RGBAColor;

use crate::axes::{Axis, NORMAL, SMALL, extent};
use crate::cell_band::{self, Reach, band, parts};
use crate::colour::{BLACK, DISTINCT, faded, opaque, series};
use crate::drawing::{Anchor, Drawing, Point};
use crate::frame::{Frame, room_below, room_beside};
use crate::known::limit_of;
use crate::legend::{Legend, Stroke, patch};
use crate::measure;
use crate::page::Page;
use crate::stages::{self, Stage};
use crate::table::Table;
use crate::{Error, Labelled};

/// Pressure and speed of one run.
#[derive(Clone, Debug)]
struct Course {
    label: String,
    /// s; the ends of the steps, of which the pressure is, and their middles, of which the speed is
    time: Vec<f64>,
    middle: Vec<f64>,
    /// Pa; on the upper body, which the clamp drives
    pressure: Vec<f64>,
    /// What a finer run says of the pressure, where one was given.
    band: Vec<Reach>,
    /// m/s
    speed: Vec<f64>,
    /// Of a press programme.
    stages: Vec<Stage>,
}

/// The four axes of the figure.
struct Axes {
    /// Time over the pressure, without a title, and below the speed.
    above: Axis,
    below: Axis,
    pressure: Axis,
    speed: Axis,
    /// Unit of time, s.
    unit: f64,
}

const WIDTH: f64 = 800.0;
const RIGHT: f64 = 24.0;
/// What the bands show.
const BAND: &str = "error due to the cell size";
const UNSETTLED: &str = "not converged: error above the value";
/// Yellow, which no series has.
const UNSETTLED_COLOUR: [u8; 3] = [240, 200, 60];
const BAND_SHADE: f64 = 0.25;

/// Clamping pressure and closing speed against time, one line per run (Figs. 5 and 6 of the
/// paper), from the `history.csv` of each run. What runs in cells half as large (`finer`, by the label of
/// their run) say of the pressure is drawn as a band, `limit` (Pa) as a dashed line, or else the one that the cases of all
/// runs have, the stages of press programmes as thin lines where they begin, with the names of those of the first.
///
/// # Errors
/// [`Error::Data`] for an unreadable history, a missing column, or one without numbers;
/// [`Error::Request`] for more runs than can be told apart, or a finer run of none of them, of
/// several, given twice, or not in cells half as large.
pub fn closing(
    runs: &[Labelled],
    finer: &[Labelled],
    limit: Option<f64>,
    title: &str,
    page: Page,
) -> Result<Drawing, Error> {
    let limit = limit.or_else(|| limit_of(runs));
    let runs = read(runs, finer, limit)?;
    let width = page.width().unwrap_or(WIDTH);
    let axes = Axes::over(&runs, limit);
    let heights = [(0.375 * width).max(170.0), (0.1875 * width).max(120.0)];
    let left = room_beside(&axes.pressure, heights[0]).max(room_beside(&axes.speed, heights[1]));
    let left = left + 4.0;
    let across = width - left - RIGHT;
    let title = measure::lines(title, NORMAL + 2.0, width - 2.0 * RIGHT, 3);
    let title_height = 10.0 + 1.4 * NORMAL * title.len() as f64;
    let bands = bands(&runs);
    let labels = runs.iter().map(|run| run.label.as_str());
    let labels = labels.chain(bands.iter().map(|(label, _)| *label));
    let legend = Legend::new(labels, Legend::LINE, across);
    let frame = |top, height| Frame::new([left, top], [across, height]);
    let above = title_height + legend.height + staged(&runs).map_or(10.0, |_| stages::ROOM);
    let upper = frame(above, heights[0]);
    let lower = frame(upper.bottom() + 34.0, heights[1]);
    let height = lower.bottom() + room_below(&axes.below, across) + 4.0;
    let mut drawing = Drawing::new(page, width, height);
    drawing.lines(&title, [0.5 * width, 20.0], Anchor::Centre, NORMAL + 2.0);
    let sample = |drawing: &mut Drawing, i: usize, ends| match i.checked_sub(runs.len()) {
        Some(band) => {
            let (shades, [[left, y], [right, _]]) = (&bands[band].1, ends);
            let wide = (right - left) / shades.len() as f64;
            for (k, shade) in shades.iter().enumerate() {
                let left = left + wide * k as f64;
                drawing.area(patch([[left, y], [left + wide, y]]), *shade);
            }
        }
        None => Stroke::of_series(i).draw(drawing, &ends),
    };
    legend.draw(&mut drawing, [left, title_height], sample);
    draw(&mut drawing, &runs, &axes, [&upper, &lower]);
    if let Some(limit) = limit {
        let place = |t| upper.place(&axes.above, &axes.pressure, [t / axes.unit, limit * 1e-6]);
        let ends = [0.0, f64::MAX].map(place);
        drawing.dashes(&ends, BLACK, 1.2, [4.0, 4.0]);
        name_limit(&mut drawing, &upper, ends[0][1], limit);
    }
    Ok(drawing)
}

/// The histories, with bands and marked labels.
fn read(
    sources: &[Labelled],
    finer: &[Labelled],
    limit: Option<f64>,
) -> Result<Vec<Course>, Error> {
    if sources.len() > DISTINCT {
        return Err(Error::Request(format!(
            "{} runs are too many for one figure: {DISTINCT} can be told apart",
            sources.len()
        )));
    }
    let mut runs: Vec<Course> = sources.iter().map(Course::read).collect::<Result<_, _>>()?;
    for (place, fine) in finer.iter().enumerate() {
        let named = runs.iter_mut().zip(sources);
        let mut named = named.filter(|(run, _)| run.label == fine.label);
        let (Some((run, source)), None) = (named.next(), named.next()) else {
            return Err(Error::Request(format!(
                "the label of the finer run '{}' is that of no run or of several",
                fine.label
            )));
        };
        if finer[..place].iter().any(|other| other.label == fine.label) {
            return Err(Error::Request(format!(
                "two finer runs have the label '{}'",
                fine.label
            )));
        }
        cell_band::check(source, fine)?;
        let (ways, finer) = ([travel(source)?, travel(fine)?], Course::read(fine)?);
        let pressures = [&run.pressure[..], &finer.pressure];
        let limit = limit.unwrap_or(f64::INFINITY);
        run.band = band([&ways[0], &ways[1]], &run.time, pressures, limit);
    }
    for (run, source) in runs.iter_mut().zip(sources) {
        run.label = source.clone().marked()?.label;
    }
    Ok(runs)
}

/// Kinds of bands that there are, and their shades.
fn bands(runs: &[Course]) -> Vec<(&'static str, Vec<RGBAColor>)> {
    let kind = |(label, converged)| {
        let has = |run: &Course| run.band.iter().any(|at| at.converged == converged);
        let shaded = (0..runs.len()).filter(|&i| has(&runs[i]));
        let mut shades: Vec<RGBAColor> = shaded.map(|i| shade(i, converged)).collect();
        shades.dedup();
        (label, shades)
    };
    let kinds = [(BAND, true), (UNSETTLED, false)].map(kind).into_iter();
    kinds.filter(|(_, shades)| !shades.is_empty()).collect()
}

impl Axes {
    fn over(runs: &[Course], limit: Option<f64>) -> Self {
        let (first, last) = extent(runs.iter().flat_map(|run| run.time.iter().copied()));
        let (unit, name) = time_unit(last);
        let times = || {
            runs.iter()
                .flat_map(|run| run.time.iter().map(|t| t / unit))
        };
        // Stages take milliseconds to minutes.
        let time = |title: &str| match staged(runs) {
            Some(_) => Axis::logarithmic(title, times()),
            None => Axis::over(title, first.min(0.0) / unit, last / unit),
        };
        let bands = runs.iter().flat_map(|run| &run.band);
        let bands = bands.flat_map(|at| [at.low, at.high]);
        let pressures = runs.iter().flat_map(|run| run.pressure.iter().copied());
        let pressures = pressures.chain(bands).chain(limit).chain([0.0]);
        // Room above the limit, for its name, and the full speed, which else lie on the frame.
        let roomy = |title: &str, (low, high): (f64, f64)| Axis::over(title, low, 1.12 * high);
        let speeds = runs.iter().flat_map(|run| run.speed.iter().copied());
        Self {
            above: time(""),
            below: time(&format!("time ({name})")),
            pressure: roomy("pressure (MPa)", extent(pressures.map(|p| p * 1e-6))),
            speed: roomy("closing speed (m/s)", extent(speeds.chain([0.0]))),
            unit,
        }
    }
}

fn draw(drawing: &mut Drawing, runs: &[Course], axes: &Axes, [upper, lower]: [&Frame; 2]) {
    upper.draw(drawing, &axes.above, &axes.pressure, true);
    lower.draw(drawing, &axes.below, &axes.speed, true);
    let end = |t: f64, p: f64| upper.place(&axes.above, &axes.pressure, [t / axes.unit, p * 1e-6]);
    for (i, run) in runs.iter().enumerate() {
        for part in parts(&run.band) {
            let low = part.iter().map(|at| end(at.time, at.low));
            let high = part.iter().rev().map(|at| end(at.time, at.high));
            let shade = shade(i, part.iter().all(|at| at.converged));
            drawing.area(low.chain(high).collect(), shade);
        }
    }
    for (i, run) in runs.iter().enumerate() {
        let line = |frame: &Frame, y: &Axis, [time, values]: [&[f64]; 2], scale: f64| {
            let pairs = time.iter().zip(values);
            let place = |(t, v): (&f64, &f64)| [t / axes.unit, v * scale];
            thinned(pairs.map(|pair| frame.place(&axes.above, y, place(pair))))
        };
        let stroke = Stroke::of_series(i);
        let time = (&axes.above, axes.unit);
        let named = staged(runs) == Some(i);
        stages::draw(
            drawing,
            &run.stages,
            [upper, lower],
            time,
            stroke.colour,
            named,
        );
        stroke.draw(
            drawing,
            &line(upper, &axes.pressure, [&run.time, &run.pressure], 1e-6),
        );
        stroke.draw(
            drawing,
            &line(lower, &axes.speed, [&run.middle, &run.speed], 1.0),
        );
    }
}

/// The first run of a press programme.
fn staged(runs: &[Course]) -> Option<usize> {
    runs.iter().position(|run| !run.stages.is_empty())
}

/// Says what the dashed line at height `y` is, on the side of it where there is room.
fn name_limit(drawing: &mut Drawing, frame: &Frame, y: f64, limit: f64) {
    let text = format!("pressure limit, {} MPa", (limit * 1e-6) as f32);
    let text = measure::shortened(&text, SMALL, frame.width - 12.0);
    let room_above = y - frame.top >= 1.3 * SMALL;
    let aside = if room_above { -0.75 } else { 0.75 };
    let (right, y) = (frame.right() - 6.0, y + aside * SMALL);
    let left = right - measure::width(&text, SMALL);
    let [above, below] = [y - 0.5 * SMALL, y + 0.55 * SMALL];
    let ground = [[left, above], [right, above], [right, below], [left, below]];
    drawing.area(ground.to_vec(), faded(opaque([255; 3]), 0.75));
    drawing.text(text, [right, y], Anchor::Right, SMALL);
}

impl Course {
    fn read(source: &Labelled) -> Result<Self, Error> {
        let table = Table::read(&source.path)?;
        let time = table.numbers("time_s")?;
        let mut middle = time.clone();
        // The log of a press has no steps.
        if table.has("dt_s") {
            let steps = table.numbers("dt_s")?;
            (middle.iter_mut().zip(steps)).for_each(|(t, dt)| *t -= 0.5 * dt);
        }
        Ok(Self {
            label: source.label.clone(),
            time,
            middle,
            pressure: table.numbers("pressure_top_Pa")?,
            band: Vec::new(),
            speed: table.numbers("closing_speed_m_s")?,
            stages: Stage::read(&table, &source.path)?,
        })
    }
}

fn shade(run: usize, converged: bool) -> RGBAColor {
    match converged {
        true => faded(series(run), BAND_SHADE),
        false => faded(opaque(UNSETTLED_COLOUR), 2.0 * BAND_SHADE),
    }
}

/// How far the clamp of a run had gone at the ends of its steps, m.
fn travel(source: &Labelled) -> Result<Vec<f64>, Error> {
    Table::read(&source.path)?.numbers("displacement_m")
}

/// The largest unit that shows a time of `last` seconds as a number above one.
pub fn time_unit(last: f64) -> (f64, &'static str) {
    match last {
        s if s >= 1.0 => (1.0, "s"),
        s if s >= 1e-3 => (1e-3, "ms"),
        _ => (1e-6, "µs"),
    }
}

/// At most four points per logical pixel column, keeping the extremes, so that noise keeps
/// its height and an SVG of 100 000 steps stays small.
fn thinned(points: impl Iterator<Item = Point>) -> Vec<Point> {
    let mut kept: Vec<Point> = Vec::new();
    let mut column: Vec<Point> = Vec::new();
    let mut flush = |column: &mut Vec<Point>| {
        if column.len() <= 4 {
            kept.append(column);
            return;
        }
        let last = column.len() - 1;
        let by_height = |a: &usize, b: &usize| column[*a][1].total_cmp(&column[*b][1]);
        let lowest = (0..=last).min_by(by_height).unwrap_or(0);
        let highest = (0..=last).max_by(by_height).unwrap_or(last);
        let mut indices = [0, lowest.min(highest), lowest.max(highest), last].to_vec();
        indices.dedup();
        kept.extend(indices.iter().map(|&i| column[i]));
        column.clear();
    };
    for point in points {
        let begins = |first: &Point| first[0].floor() != point[0].floor();
        if column.first().is_some_and(begins) {
            flush(&mut column);
        }
        column.push(point);
    }
    flush(&mut column);
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thinning_keeps_extremes_and_ends() {
        let noise = |i: usize| if i == 517 { 99.0 } else { (i % 7) as f64 };
        let points: Vec<Point> = (0..1000).map(|i| [i as f64 * 0.01, noise(i)]).collect();
        let kept = thinned(points.iter().copied());
        assert!(kept.len() <= 44, "{}", kept.len());
        assert!(kept.iter().any(|p| p[1] == 99.0));
        assert_eq!((kept[0], kept[kept.len() - 1]), (points[0], points[999]));
        assert!(kept.windows(2).all(|pair| pair[0][0] <= pair[1][0]));
    }
}

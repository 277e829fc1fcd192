use crate::axes::{Axis, Frame, NORMAL, SMALL, extent};
use crate::closing::time_unit;
use crate::colour::{BLACK, faded, series};
use crate::drawing::{Anchor, Drawing};
use crate::table::Table;
use crate::{Error, Labelled};

/// Quantiles of the shear rate against time, one panel per run (Figs. 10 and 11 of the
/// paper), from the CSV of `shear-stats`.
#[derive(Clone, Debug)]
pub struct ShearRates {
    panels: Vec<Panel>,
}

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

const PANEL: f64 = 460.0;
const HEIGHT: f64 = 340.0;
const LEFT: f64 = 84.0;
const BETWEEN: f64 = 66.0;
const TOP: f64 = 74.0;

impl ShearRates {
    /// Reads one panel per CSV.
    ///
    /// # Errors
    /// [`Error::Data`] for an unreadable file, a missing column, or one without numbers.
    pub fn read(runs: &[Labelled]) -> Result<Self, Error> {
        let panels = runs.iter().map(Panel::read).collect::<Result<_, _>>()?;
        Ok(Self { panels })
    }

    /// The figure: all panels share the shear-rate axis.
    pub fn draw(&self) -> Drawing {
        let count = self.panels.len() as f64;
        let width = LEFT + count * PANEL + (count - 1.0) * BETWEEN + 24.0;
        let mut drawing = Drawing::new(width as u32, (TOP + HEIGHT + 56.0) as u32);
        let rates = self.panels.iter().flat_map(|panel| {
            let quantiles = panel.quantiles.iter().flatten();
            quantiles.chain(&panel.max).copied()
        });
        let rate = Axis::logarithmic("shear rate (1/s)", rates);
        self.key(&mut drawing);
        for (i, panel) in self.panels.iter().enumerate() {
            let frame = Frame {
                left: LEFT + i as f64 * (PANEL + BETWEEN),
                top: TOP,
                width: PANEL,
                height: HEIGHT,
            };
            let mut rate = rate.clone();
            if i > 0 {
                rate.title.clear();
            }
            panel.draw(&mut drawing, &frame, &rate);
        }
        drawing
    }

    fn key(&self, drawing: &mut Drawing) {
        // From the edge of the figure: from the axis on, it would not fit above a single panel.
        let (mut x, y) = (24.0, 20.0);
        for (_, _, name, opacity) in BANDS {
            let swatch = vec![
                [x, y - 7.0],
                [x + 26.0, y - 7.0],
                [x + 26.0, y + 7.0],
                [x, y + 7.0],
            ];
            drawing.area(swatch, faded(series(0), opacity + 0.1));
            drawing.text(name, [x + 32.0, y], Anchor::Left, SMALL);
            x += 122.0;
        }
        for (name, width, dashed) in [("median", 3.0, false), ("max", 1.4, true)] {
            let points = [[x, y], [x + 20.0, y]];
            if dashed {
                drawing.dashes(&points, BLACK, width, [5.0, 3.0]);
            } else {
                drawing.line(points.to_vec(), BLACK, width);
            }
            drawing.text(name, [x + 26.0, y], Anchor::Left, SMALL);
            x += 92.0;
        }
    }
}

impl Panel {
    fn read(source: &Labelled) -> Result<Self, Error> {
        let table = Table::read(&source.path)?;
        let quantiles = QUANTILES.iter().map(|q| table.data(q));
        let max = table.data("max")?;
        if !max.iter().any(|rate| *rate > 0.0) {
            return Err(Error::Data(format!(
                "'{}' has no shear rate above zero: nothing flows in these states",
                table.name()
            )));
        }
        Ok(Self {
            label: source.label.clone(),
            time: table.data("time_s")?,
            quantiles: quantiles.collect::<Result<_, _>>()?,
            max,
        })
    }

    fn draw(&self, drawing: &mut Drawing, frame: &Frame, rate: &Axis) {
        let (unit, name) = time_unit(extent(self.time.iter().copied()).1);
        let times = self.time.iter().map(|t| t / unit);
        let (first, last) = extent(times.clone());
        let time = Axis::over(format!("time ({name})"), first.min(0.0), last);
        let middle = frame.left + 0.5 * frame.width;
        let label = [middle, frame.top - 18.0];
        drawing.text(&self.label, label, Anchor::Centre, NORMAL);
        frame.draw(drawing, &time, rate, true);
        // A rate of zero, as before the start, has no place on a logarithmic axis; of a band
        // whose upper end has one, the lower end lies on the edge.
        let places = |values: &[f64], shown: &[f64]| -> Vec<[f64; 2]> {
            let triples = times.clone().zip(values).zip(shown);
            let shown =
                triples.filter(|((t, v), shown)| t.is_finite() && v.is_finite() && **shown > 0.0);
            shown
                .map(|((t, v), _)| frame.place(&time, rate, [t, *v]))
                .collect()
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

use crate::colour::{BLACK, FAINT};
use crate::drawing::{Anchor, Drawing, Point};

/// Height of the text at the ticks and of titles, logical pixels.
pub(crate) const SMALL: f64 = 15.0;
pub(crate) const NORMAL: f64 = 17.0;

/// One axis of a plot: its range, title and how values are placed.
#[derive(Clone, Debug)]
pub(crate) struct Axis {
    pub(crate) title: String,
    low: f64,
    high: f64,
    logarithmic: bool,
}

impl Axis {
    /// A linear axis over the range of `values`, widened to whole ticks; a range of one value
    /// is widened about it.
    pub(crate) fn linear(title: impl Into<String>, values: impl Iterator<Item = f64>) -> Self {
        let (low, high) = extent(values);
        let pad = if high > low {
            0.0
        } else {
            0.5 * high.abs().max(1.0)
        };
        let step = nice_step(high + pad - (low - pad));
        Self {
            title: title.into(),
            low: ((low - pad) / step).floor() * step,
            high: ((high + pad) / step).ceil() * step,
            logarithmic: false,
        }
    }

    /// A linear axis that ends exactly at `low` and `high`.
    pub(crate) fn exact(title: impl Into<String>, low: f64, high: f64) -> Self {
        Self {
            title: title.into(),
            low,
            high,
            logarithmic: false,
        }
    }

    /// A linear axis that ends exactly at `low` and `high` if they differ.
    pub(crate) fn over(title: impl Into<String>, low: f64, high: f64) -> Self {
        if high > low {
            Self::exact(title, low, high)
        } else {
            Self::linear(title, [low].into_iter())
        }
    }

    /// A linear axis for a colour scale over the given quantiles of `values`, because single
    /// outliers would take the contrast from the rest; the title says where values lie beyond.
    pub(crate) fn covering(
        title: &str,
        values: impl Iterator<Item = f64>,
        shares: [f64; 2],
    ) -> Self {
        let mut values: Vec<f64> = values.filter(|v| v.is_finite()).collect();
        values.sort_by(f64::total_cmp);
        let last = values.len().saturating_sub(1);
        let quantile = |share: f64| values.get((share * last as f64).round() as usize).copied();
        let mut axis = Self::linear(title, shares.into_iter().filter_map(quantile));
        let beyond = match values[..] {
            [low, .., high] => [low < axis.low, high > axis.high],
            _ => [false, false],
        };
        axis.title += match beyond {
            [false, false] => "",
            [false, true] => ", top: and more",
            [true, false] => ", bottom: and less",
            [true, true] => ", ends: and beyond",
        };
        axis
    }

    /// An axis without ticks.
    pub(crate) fn none() -> Self {
        Self::exact(String::new(), 0.0, 0.0)
    }

    /// A logarithmic axis over the positive `values`, in whole decades and at most
    /// `MOST_DECADES` of them below the largest value; lower values lie on its edge.
    pub(crate) fn logarithmic(title: impl Into<String>, values: impl Iterator<Item = f64>) -> Self {
        let (low, high) = extent(values.filter(|v| *v > 0.0));
        let (low, high) = if high > 0.0 { (low, high) } else { (1.0, 10.0) };
        let top = high.log10().ceil();
        let bottom = low.log10().floor().max(top - MOST_DECADES).min(top - 1.0);
        Self {
            title: title.into(),
            low: bottom,
            high: top,
            logarithmic: true,
        }
    }

    /// Share of the axis at which a value lies, 0 to 1 within its range; values outside are
    /// put on the edge. NaN stays NaN.
    pub(crate) fn share(&self, value: f64) -> f64 {
        let value = if self.logarithmic {
            value.max(0.0).log10()
        } else {
            value
        };
        ((value - self.low) / (self.high - self.low)).clamp(0.0, 1.0)
    }

    /// Ticks as share of the axis and text.
    pub(crate) fn ticks(&self) -> Vec<(f64, String)> {
        if self.logarithmic {
            let decades = self.low as i32..=self.high as i32;
            let text = |d: i32| match d {
                0..=3 => format!("{}", 10_i32.pow(d as u32)),
                _ => format!("1e{d}"),
            };
            return decades
                .map(|d| ((f64::from(d) - self.low) / (self.high - self.low), text(d)))
                .collect();
        }
        if self.high <= self.low {
            return Vec::new();
        }
        let step = nice_step(self.high - self.low);
        let decimals = (-step.log10().floor()).clamp(0.0, 9.0) as usize;
        let first = (self.low / step - 1e-9).ceil() as i64;
        let last = (self.high / step + 1e-9).floor() as i64;
        let tick = |i: i64| {
            let value = i as f64 * step;
            (self.share(value), format!("{value:.decimals$}"))
        };
        (first..=last).map(tick).collect()
    }
}

const MOST_DECADES: f64 = 5.0;
/// About how many steps an axis has.
const STEPS: f64 = 5.0;

/// Lowest and highest finite value; 0 to 1 when there is none.
pub(crate) fn extent(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let finite = values.filter(|v| v.is_finite());
    let (low, high) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
        (low.min(v), high.max(v))
    });
    if low <= high { (low, high) } else { (0.0, 1.0) }
}

/// A step of 1, 2 or 5 times a power of ten that divides `span` into about `STEPS` parts.
fn nice_step(span: f64) -> f64 {
    let raw = (span / STEPS).max(f64::MIN_POSITIVE);
    let power = 10_f64.powf(raw.log10().floor());
    let factor = [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .find(|f| f * power >= raw * (1.0 - 1e-9));
    power * factor.unwrap_or(10.0)
}

/// A rectangle of the drawing with an x and a y axis.
#[derive(Clone, Debug)]
pub(crate) struct Frame {
    pub(crate) left: f64,
    pub(crate) top: f64,
    pub(crate) width: f64,
    pub(crate) height: f64,
}

impl Frame {
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

    /// Frame, grid lines, ticks and tick texts; titles where an axis has one. With
    /// `grid = false` the ticks point outwards and no lines cross the frame (for maps).
    pub(crate) fn draw(&self, drawing: &mut Drawing, x: &Axis, y: &Axis, grid: bool) {
        let (bottom, right) = (self.bottom(), self.right());
        for (share, text) in x.ticks() {
            let at = self.left + share * self.width;
            if grid {
                drawing.line(vec![[at, self.top], [at, bottom]], FAINT, 1.0);
            }
            drawing.line(vec![[at, bottom], [at, bottom + 5.0]], BLACK, 1.0);
            drawing.text(text, [at, bottom + 16.0], Anchor::Centre, SMALL);
        }
        let mut widest = 0;
        for (share, text) in y.ticks() {
            let at = bottom - share * self.height;
            if grid {
                drawing.line(vec![[self.left, at], [right, at]], FAINT, 1.0);
            }
            drawing.line(vec![[self.left - 5.0, at], [self.left, at]], BLACK, 1.0);
            widest = widest.max(text.chars().count());
            drawing.text(text, [self.left - 9.0, at], Anchor::Right, SMALL);
        }
        drawing.line(
            vec![
                [self.left, self.top],
                [right, self.top],
                [right, bottom],
                [self.left, bottom],
                [self.left, self.top],
            ],
            BLACK,
            1.0,
        );
        if !x.title.is_empty() {
            let middle = self.left + 0.5 * self.width;
            drawing.text(&x.title, [middle, bottom + 38.0], Anchor::Centre, NORMAL);
        }
        if !y.title.is_empty() {
            let beside = self.left - 26.0 - 0.5 * SMALL * widest as f64;
            let middle = self.top + 0.5 * self.height;
            drawing.text(&y.title, [beside, middle], Anchor::Upwards, NORMAL);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_inside() {
        let axis = Axis::linear("", [0.03, 2.61].into_iter());
        let texts: Vec<String> = axis.ticks().into_iter().map(|t| t.1).collect();
        assert_eq!(texts, ["0", "1", "2", "3"]);
        assert!(axis.ticks().iter().all(|t| (0.0..=1.0).contains(&t.0)));
        let one = Axis::linear("", [7.0].into_iter());
        assert!(one.share(7.0) > 0.2 && one.share(7.0) < 0.8);
        let none = Axis::linear("", [f64::NAN].into_iter());
        assert!(none.ticks().len() > 2);
    }

    #[test]
    fn a_logarithmic_axis_has_decades() {
        let axis = Axis::logarithmic("", [0.0, 30.0, 4e5, f64::NAN].into_iter());
        assert_eq!(axis.share(10.0), 0.0);
        assert_eq!(axis.share(1e6), 1.0);
        assert!((axis.share(1e3) - 0.4).abs() < 1e-12);
        assert_eq!(axis.share(0.0), 0.0);
        assert_eq!(axis.ticks().len(), 6);
    }

    #[test]
    fn a_colour_scale_leaves_outliers_out_and_says_so() {
        let values = || (0..1000).map(f64::from).chain([1e6]);
        let axis = Axis::covering("T", values(), [0.0, 0.99]);
        assert_eq!(
            (axis.title.as_str(), axis.share(500.0)),
            ("T, top: and more", 0.5)
        );
        let all = Axis::covering("T", values(), [0.0, 1.0]);
        assert_eq!((all.title.as_str(), all.share(1e6)), ("T", 1.0));
    }
}

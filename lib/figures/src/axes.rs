//! Range, ticks and places of an axis.

use crate::measure;

/// Height of the text at the ticks and of titles, logical pixels.
pub(crate) const SMALL: f64 = 15.0;
pub(crate) const NORMAL: f64 = 17.0;

/// One axis of a plot: its range, title and how values are placed.
#[derive(Clone, Debug)]
pub(crate) struct Axis {
    pub(crate) title: String,
    /// Note on values that have no place on it; stands after the title.
    pub(crate) note: String,
    low: f64,
    high: f64,
    logarithmic: bool,
}

impl Axis {
    /// A linear axis over the range of `values`, widened to whole ticks; a range of one value
    /// is widened about it.
    pub(crate) fn linear(title: &str, values: impl Iterator<Item = f64>) -> Self {
        let (low, high) = extent(values);
        let pad = match high > low {
            true => 0.0,
            false => 0.5 * high.abs().max(1.0),
        };
        let step = nice_step(high + pad - (low - pad), STEPS);
        Self {
            low: ((low - pad) / step).floor() * step,
            high: ((high + pad) / step).ceil() * step,
            ..Self::none(title)
        }
    }

    /// A linear axis that ends exactly at `low` and `high` if they differ.
    pub(crate) fn over(title: &str, low: f64, high: f64) -> Self {
        match high > low {
            true => Self {
                low,
                high,
                ..Self::none(title)
            },
            false => Self::linear(title, [low].into_iter()),
        }
    }

    /// An axis without ticks.
    pub(crate) fn none(title: &str) -> Self {
        Self {
            title: title.into(),
            note: String::new(),
            low: 0.0,
            high: 0.0,
            logarithmic: false,
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
            [false, true] => ", top: or more",
            [true, false] => ", bottom: or less",
            [true, true] => ", ends: or beyond",
        };
        axis
    }

    /// A logarithmic axis over all decades of the positive `values`; a note to the title, if there is one, says how
    /// many others have no place.
    pub(crate) fn logarithmic(title: &str, values: impl Iterator<Item = f64>) -> Self {
        let (placed, others): (Vec<f64>, Vec<f64>) =
            values.filter(|v| v.is_finite()).partition(|v| *v > 0.0);
        let (low, high) = match placed[..] {
            [] => (1.0, 10.0),
            _ => extent(placed.into_iter()),
        };
        let top = high.log10().ceil();
        let note = match others.len() {
            n if n > 0 && !title.is_empty() => format!("left out: {n} not above zero"),
            _ => String::new(),
        };
        Self {
            note,
            low: low.log10().floor().min(top - 1.0),
            high: top,
            logarithmic: true,
            ..Self::none(title)
        }
    }

    /// Share of the axis at which a value lies, 0 to 1 within its range; values outside are
    /// put on the edge. NaN stays NaN, and so is what has no logarithm on a logarithmic axis.
    pub(crate) fn share(&self, value: f64) -> f64 {
        match self.logarithmic {
            true if value <= 0.0 => f64::NAN,
            true => self.part(value.log10()),
            false => self.part(value),
        }
    }

    /// The same of a value, or its decade where the axis is logarithmic.
    fn part(&self, value: f64) -> f64 {
        ((value - self.low) / (self.high - self.low)).clamp(0.0, 1.0)
    }

    /// Ticks as share of the axis and text, as many as have room side by side on an axis `length`
    /// long; texts stand along the axis or, `across` it, one above the other.
    pub(crate) fn ticks(&self, length: f64, across: bool) -> Vec<(f64, String)> {
        if self.high <= self.low {
            return Vec::new();
        }
        let room = |text: &String| match across {
            true => 1.1 * SMALL,
            false => measure::width(text, SMALL) + 0.6 * SMALL,
        };
        let fit = |ticks: &[(f64, String)]| {
            let pairs = ticks.windows(2);
            pairs.into_iter().all(|pair| {
                let apart = (pair[1].0 - pair[0].0) * length;
                apart >= 0.5 * (room(&pair[0].1) + room(&pair[1].1))
            })
        };
        let mut parts = STEPS;
        let mut ticks = self.in_steps(parts);
        while ticks.len() > 1 && !fit(&ticks) {
            parts *= 0.7;
            ticks = self.in_steps(parts);
        }
        ticks
    }

    /// Ticks in about so many steps.
    fn in_steps(&self, parts: f64) -> Vec<(f64, String)> {
        let step = match self.logarithmic {
            true => ((self.high - self.low) / parts).ceil(),
            false => nice_step(self.high - self.low, parts),
        };
        let first = (self.low / step - 1e-9).ceil() as i64;
        let last = (self.high / step + 1e-9).floor() as i64;
        let decimals = (-step.log10().floor()).clamp(0.0, 9.0) as usize;
        // One way of writing for all of an axis.
        let plain = self.low >= -2.0 && self.high <= 3.0;
        let text = |value: f64| match (self.logarithmic, plain) {
            (false, _) => format!("{value:.decimals$}"),
            (true, true) => format!("{}", 10_f64.powf(value)),
            (true, false) => power_of_ten(value as i32),
        };
        let values = (first..=last).map(|i| i as f64 * step);
        values.map(|v| (self.part(v), text(v))).collect()
    }
}

/// `10⁴`, `10⁻²`.
fn power_of_ten(exponent: i32) -> String {
    let raised = |c: char| match c.to_digit(10) {
        Some(digit) => RAISED[digit as usize],
        None => '⁻',
    };
    let exponent = exponent.to_string();
    "10".chars().chain(exponent.chars().map(raised)).collect()
}

const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
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

/// A step of 1, 2 or 5 times a power of ten that divides `span` into about so many parts.
fn nice_step(span: f64, parts: f64) -> f64 {
    let raw = (span / parts).max(f64::MIN_POSITIVE);
    let power = 10_f64.powf(raw.log10().floor());
    let factor = [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .find(|f| f * power >= raw * (1.0 - 1e-9));
    power * factor.unwrap_or(10.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(axis: &Axis, length: f64, across: bool) -> Vec<String> {
        let ticks = axis.ticks(length, across);
        assert!(ticks.iter().all(|t| (0.0..=1.0).contains(&t.0)));
        ticks.into_iter().map(|tick| tick.1).collect()
    }

    #[test]
    fn ticks_are_round_and_inside() {
        let axis = Axis::linear("", [0.03, 2.61].into_iter());
        assert_eq!(texts(&axis, 300.0, false), ["0", "1", "2", "3"]);
        assert_eq!(texts(&axis, 40.0, false), ["0", "2"]);
        assert_eq!(texts(&axis, 1.0, false), ["0"]);
        let one = Axis::linear("", [7.0].into_iter());
        assert!(one.share(7.0) > 0.2 && one.share(7.0) < 0.8);
        let none = Axis::linear("", [f64::NAN].into_iter());
        assert!(none.ticks(300.0, false).len() > 2);
    }

    #[test]
    fn a_logarithmic_axis_has_decades() {
        let log = |values: &[f64]| Axis::logarithmic("x", values.iter().copied());
        let axis = log(&[0.0, 30.0, 4e5, f64::NAN]);
        for (value, share) in [(10.0, 0.0), (1e3, 0.4), (1e6, 1.0)] {
            assert!((axis.share(value) - share).abs() < 1e-12);
        }
        assert!(axis.share(0.0).is_nan() && axis.share(-1.0).is_nan());
        assert_eq!(axis.note, "left out: 1 not above zero");
        let decades = ["10¹", "10²", "10³", "10⁴", "10⁵", "10⁶"];
        assert_eq!(texts(&axis, 300.0, true), decades);
        // 1 um/s once lay at 10 um/s, and what creeps at 1 1/s.
        let wide = log(&[1e-6, 1.0]);
        assert_eq!((wide.share(1e-6), wide.share(1e-3)), (0.0, 0.5));
        assert_eq!(log(&[2e-11, 1e5]).share(1e-11), 0.0);
        let small = texts(&log(&[0.012, 30.0]), 300.0, true);
        assert_eq!(small, ["0.01", "0.1", "1", "10", "100"]);
    }

    #[test]
    fn a_colour_scale_leaves_outliers_out_and_says_so() {
        let values = || (0..1000).map(f64::from).chain([1e6]);
        let axis = Axis::covering("T", values(), [0.0, 0.99]);
        assert_eq!(axis.title, "T, top: or more");
        assert_eq!(axis.share(500.0), 0.5);
        let all = Axis::covering("T", values(), [0.0, 1.0]);
        assert_eq!((all.title.as_str(), all.share(1e6)), ("T", 1.0));
    }
}

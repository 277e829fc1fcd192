//! Sums and places over rows of numbers.

/// The error farthest from zero.
pub(crate) fn worst(errors: impl Iterator<Item = f64>) -> Option<f64> {
    errors.max_by(|a, b| a.abs().total_cmp(&b.abs()))
}

/// The largest of numbers, none of them below zero.
pub(crate) fn largest(numbers: impl Iterator<Item = f64>) -> f64 {
    numbers.fold(0.0, f64::max)
}

/// The least and the largest of numbers; NaN of nothing.
pub(crate) fn range(numbers: impl Iterator<Item = f64>) -> [f64; 2] {
    numbers.fold([f64::NAN; 2], |[low, high], x| [low.min(x), high.max(x)])
}

/// Where between zero and `high` something stops to hold that does so once, by halves.
pub(crate) fn last(high: f64, holds: impl Fn(f64) -> bool) -> f64 {
    let (mut low, mut high) = (0.0, high);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        *(if holds(middle) { &mut low } else { &mut high }) = middle;
    }
    low
}

/// Arithmetic mean; NaN of nothing.
pub fn mean(numbers: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = numbers.fold((0.0, 0.0), |(sum, n), x| (sum + x, n + 1.0));
    sum / count
}

/// Root of the mean square; NaN of nothing.
pub fn rms(numbers: impl Iterator<Item = f64>) -> f64 {
    mean(numbers.map(|x| x * x)).sqrt()
}

/// The value of `y` where `x`, which grows from zero as `y` does, comes to `at`: on the straight
/// line between two rows; none beyond the last.
pub(crate) fn crossing(x: &[f64], y: &[f64], at: f64) -> Option<f64> {
    let after = x.iter().position(|&x| x >= at)?;
    let (before, from) = after.checked_sub(1).map_or((0.0, 0.0), |i| (x[i], y[i]));
    let part = (at - before) / (x[after] - before);
    Some(from + part * (y[after] - from))
}

/// A column in the middle of a window of another, on the straight line of least squares through the rows
/// in it: their mean is that of where they happen to lie.
pub(crate) fn at_middle(x: &[f64], y: &[f64], from: f64, to: f64) -> Option<f64> {
    let middle = 0.5 * (from + to);
    let rows = x.iter().zip(y).filter(|(x, _)| (from..to).contains(*x));
    let rows: Vec<_> = rows.map(|(x, y)| (x - middle, *y)).collect();
    (!rows.is_empty()).then(|| line(&rows)[0])
}

/// The straight line of least squares through points: its value at zero and its slope, none where all lie at one place.
pub fn line(points: &[(f64, f64)]) -> [f64; 2] {
    let mean = |of: fn(&(f64, f64)) -> f64| mean(points.iter().map(of));
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let spread = mean(|p| p.0 * p.0) - x * x;
    let slope = (mean(|p| p.0 * p.1) - x * y) / spread;
    if spread > 0.0 {
        [y - slope * x, slope]
    } else {
        [y, 0.0]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_that_lie_to_one_side_do_not_shift_the_middle() {
        let x = [0.0, 0.6, 0.7, 0.75, 1.0, 9.0];
        let y = x.map(|x| 3.0 + 2.0 * x);
        let found = at_middle(&x, &y, 0.5, 1.5).unwrap();
        assert!((found - 5.0).abs() < 1e-12, "{found}");
        let one_row = at_middle(&x, &y, 8.0, 11.0);
        assert_eq!(one_row, Some(21.0), "one row is all there is");
        assert_eq!(at_middle(&x, &y, 2.0, 3.0), None);
    }
}

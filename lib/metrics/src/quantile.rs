//! Quantiles by weight.

use std::cmp::Ordering;

use rayon::prelude::*;

/// Values with weights, in ascending order.
#[derive(Clone, Debug)]
pub struct Weighted {
    sorted: Vec<(f64, f64)>,
    total: f64,
}

/// By value, then weight: equal pairs are alike, so the order is unique.
pub(crate) fn by_value(a: &(f64, f64), b: &(f64, f64)) -> Ordering {
    a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
}

impl Weighted {
    /// From pairs of value and weight; weights are positive, values are numbers.
    pub fn new(mut pairs: Vec<(f64, f64)>) -> Self {
        pairs.par_sort_unstable_by(by_value);
        Self::of_sorted(pairs)
    }

    /// From pairs in the order of [`by_value`].
    pub(crate) fn of_sorted(pairs: Vec<(f64, f64)>) -> Self {
        let total = pairs.iter().map(|(_, w)| w).sum();
        Self {
            sorted: pairs,
            total,
        }
    }

    /// Sum of the weights.
    pub fn total(&self) -> f64 {
        self.total
    }

    /// For each of the ascending `shares` (0 to 1), the smallest value that at least this
    /// share of the weight does not exceed; NaN without values.
    pub fn quantiles<const N: usize>(&self, shares: [f64; N]) -> [f64; N] {
        let mut found = [self.max(); N];
        let mut next = 0;
        let mut reached = 0.0;
        for &(value, weight) in &self.sorted {
            reached += weight;
            // Rounding of the running sum must not push a quantile to the next value.
            while next < N && reached >= shares[next] * self.total * (1.0 - 1e-12) {
                found[next] = value;
                next += 1;
            }
        }
        found
    }

    /// Largest value; NaN without values.
    pub fn max(&self) -> f64 {
        self.sorted.last().map_or(f64::NAN, |(value, _)| *value)
    }

    /// Weighted mean; NaN without values.
    pub fn mean(&self) -> f64 {
        self.sorted.iter().map(|(v, w)| v * w).sum::<f64>() / self.total
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_count_as_repetitions() {
        let weighted = Weighted::new(vec![(3.0, 1.0), (1.0, 2.0), (2.0, 5.0)]);
        let repeated: Vec<_> = [1.0, 1.0, 2.0, 2.0, 2.0, 2.0, 2.0, 3.0]
            .map(|v| (v, 1.0))
            .to_vec();
        let shares = [0.05, 0.25, 0.26, 0.5, 0.875, 0.88, 1.0];
        let expected = [1.0, 1.0, 2.0, 2.0, 2.0, 3.0, 3.0];
        assert_eq!(weighted.quantiles(shares), expected);
        assert_eq!(Weighted::new(repeated).quantiles(shares), expected);
        assert_eq!((weighted.mean(), weighted.max()), (15.0 / 8.0, 3.0));
    }

    #[test]
    fn rounding_of_the_sum_does_not_move_a_quantile() {
        let tenths: Vec<_> = (1..=10).map(|v| (f64::from(v), 0.1)).collect();
        let weighted = Weighted::new(tenths);
        for tenth in 1..=10 {
            let share = f64::from(tenth) / 10.0;
            assert_eq!(weighted.quantiles([share]), [f64::from(tenth)]);
        }
    }

    #[test]
    fn nothing_has_no_quantiles() {
        let none = Weighted::new(Vec::new());
        assert!(none.max().is_nan() && none.mean().is_nan());
        assert!(none.quantiles([0.5])[0].is_nan());
    }
}

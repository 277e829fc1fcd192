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
fn by_value(a: &(f64, f64), b: &(f64, f64)) -> Ordering {
    a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1))
}

impl Weighted {
    /// From pairs of value and weight; weights are positive, values are numbers.
    pub fn new(mut pairs: Vec<(f64, f64)>) -> Self {
        pairs.par_sort_unstable_by(by_value);
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

/// Bins of [`quantiles_up_to`].
const BINS: usize = 4096;

/// [`Weighted::quantiles`] of values from 0 to `largest`, of `total` weight, that `each` visits, twice, so that they
/// need not be kept: of `BINS` even bins only those that hold a quantile are listed.
pub(crate) fn quantiles_up_to<const N: usize>(
    largest: f64,
    total: f64,
    each: impl Fn(&mut dyn FnMut(f64, f64)),
    shares: [f64; N],
) -> [f64; N] {
    let bin = |value: f64| ((value / largest * BINS as f64) as usize).min(BINS - 1);
    let mut weights = vec![0.0; BINS];
    each(&mut |value, weight| weights[bin(value)] += weight);
    let mut near = shares.map(|share| Near::new(&weights, share * total * (1.0 - 1e-12)));
    each(&mut |value, weight| {
        for near in &mut near {
            if bin(value) == near.bin {
                near.pairs.push((value, weight));
            }
        }
    });
    near.map(Near::value)
}

/// The bin of a quantile.
struct Near {
    bin: usize,
    /// Weight of the bins below.
    below: f64,
    /// Weight up to the quantile.
    goal: f64,
    pairs: Vec<(f64, f64)>,
}

impl Near {
    fn new(weights: &[f64], goal: f64) -> Self {
        let (mut bin, mut below) = (0, 0.0);
        while bin < BINS - 1 && below + weights[bin] < goal {
            below += weights[bin];
            bin += 1;
        }
        Self {
            bin,
            below,
            goal,
            pairs: Vec::new(),
        }
    }

    fn value(mut self) -> f64 {
        self.pairs.sort_unstable_by(by_value);
        let mut reached = self.below;
        let at = self.pairs.iter().find(|(_, weight)| {
            reached += weight;
            reached >= self.goal
        });
        // Rounding may leave the sum of the bin below the goal.
        let last = self.pairs.last();
        at.or(last).map_or(f64::NAN, |(value, _)| *value)
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
    fn values_visited_have_the_quantiles_of_values_kept() {
        // Even, crowded near zero, and one far beyond all others; weights from 1 to 3.
        let spread = |power: i32| move |i: i32| (f64::from(i * 7919 % 10_007) / 1e4).powi(power);
        let lone = |i: i32| if i == 5 { 1e9 } else { f64::from(i) };
        let shares = [1e-4, 0.5, 0.95, 0.99, 1.0];
        let compare = |value: &dyn Fn(i32) -> f64| {
            let pair = |i: i32| (value(i), f64::from(i % 3 + 1));
            let kept = Weighted::new((0..20_000).map(pair).collect());
            let each = |visit: &mut dyn FnMut(f64, f64)| {
                (0..20_000)
                    .map(pair)
                    .for_each(|(value, weight)| visit(value, weight));
            };
            let visited = quantiles_up_to(kept.max(), kept.total(), each, shares);
            assert_eq!(visited, kept.quantiles(shares));
        };
        compare(&spread(1));
        compare(&spread(6));
        compare(&lone);
        compare(&|_| 0.0);
    }

    #[test]
    fn nothing_has_no_quantiles() {
        let none = Weighted::new(Vec::new());
        assert!(none.max().is_nan() && none.mean().is_nan());
        assert!(none.quantiles([0.5])[0].is_nan());
        let visited = quantiles_up_to(f64::NAN, 0.0, |_| {}, [0.5]);
        assert!(visited[0].is_nan());
    }
}

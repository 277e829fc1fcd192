//! Weighted quantiles.

use std::collections::BTreeMap;

/// Number of equal bins; only values in bins that contain a quantile are sorted.
const BINS: usize = 4096;

/// For each of the ascending `shares` (0 to 1), the smallest value not exceeded by at least this share of the weight; NaN
/// without values. `each` visits the values, from 0 to `largest`, with their weights, of sum `total`. It is called twice, so
/// that the values need not be stored.
pub(crate) fn quantiles<const N: usize>(
    largest: f64,
    total: f64,
    each: impl Fn(&mut dyn FnMut(f64, f64)),
    shares: [f64; N],
) -> [f64; N] {
    let bin = |value: f64| ((value / largest * BINS as f64) as usize).min(BINS - 1);
    let mut weights = vec![0.0; BINS];
    each(&mut |value, weight| weights[bin(value)] += weight);
    // Rounding of the running sum must not push a quantile to the next value.
    let found = shares.map(|share| {
        let goal = share * total * (1.0 - 1e-12);
        let (mut bin, mut below) = (0, 0.0);
        while bin < BINS - 1 && below + weights[bin] < goal {
            below += weights[bin];
            bin += 1;
        }
        (bin, below, goal)
    });
    let mut listed: BTreeMap<usize, Vec<(f64, f64)>> =
        found.iter().map(|(bin, ..)| (*bin, Vec::new())).collect();
    each(&mut |value, weight| {
        if let Some(pairs) = listed.get_mut(&bin(value)) {
            pairs.push((value, weight));
        }
    });
    for pairs in listed.values_mut() {
        // Ties are equal pairs, so the result does not depend on the order.
        pairs.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    }
    found.map(|(bin, mut reached, goal)| {
        let pairs = &listed[&bin];
        let at = pairs.iter().find(|(_, weight)| {
            reached += weight;
            reached >= goal
        });
        // Rounding may leave the sum of the bin below the goal: take the last value.
        at.or(pairs.last()).map_or(f64::NAN, |(value, _)| *value)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of<const N: usize>(pairs: &[(f64, f64)], shares: [f64; N]) -> [f64; N] {
        let largest = pairs
            .iter()
            .map(|(value, _)| *value)
            .fold(f64::NAN, f64::max);
        let total = pairs.iter().map(|(_, weight)| weight).sum();
        let each = |visit: &mut dyn FnMut(f64, f64)| pairs.iter().for_each(|&(v, w)| visit(v, w));
        quantiles(largest, total, each, shares)
    }

    #[test]
    fn weights_count_as_repetitions_and_rounding_moves_nothing() {
        let repeated = [1.0, 1.0, 2.0, 2.0, 2.0, 2.0, 2.0, 3.0].map(|value| (value, 1.0));
        for pairs in [&[(3.0, 1.0), (1.0, 2.0), (2.0, 5.0)][..], &repeated] {
            let found = of(pairs, [0.05, 0.25, 0.26, 0.5, 0.875, 0.88, 1.0]);
            assert_eq!(found, [1.0, 1.0, 2.0, 2.0, 2.0, 3.0, 3.0]);
        }
        let tenths: Vec<_> = (1..=10).map(|v| (f64::from(v), 0.1)).collect();
        for tenth in 1..=10 {
            assert_eq!(of(&tenths, [f64::from(tenth) / 10.0]), [f64::from(tenth)]);
        }
        assert!(of(&[], [0.5])[0].is_nan());
    }

    #[test]
    fn bins_have_the_quantiles_of_all_values_in_order() {
        // Uniform, dense bins zero, with one outlier, and all equal; weights from 1 to 3.
        let spread = |i: i32, power| (f64::from(i * 7919 % 10_007) / 1e4).powi(power);
        let kinds: [&dyn Fn(i32) -> f64; 4] = [
            &|i| spread(i, 1),
            &|i| spread(i, 6),
            &|i| if i == 5 { 1e9 } else { f64::from(i) },
            &|_| 0.0,
        ];
        for value in kinds {
            let mut pairs: Vec<_> = (0..20_000)
                .map(|i| (value(i), f64::from(i % 3 + 1)))
                .collect();
            let found = of(&pairs, [1e-4, 0.5, 0.95, 0.99, 1.0]);
            pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
            let total: f64 = pairs.iter().map(|(_, weight)| weight).sum();
            for (found, share) in found.into_iter().zip([1e-4, 0.5, 0.95, 0.99, 1.0]) {
                let mut reached = 0.0;
                let first = pairs.iter().find(|(_, weight)| {
                    reached += weight;
                    reached >= share * total * (1.0 - 1e-12)
                });
                assert_eq!(found, first.unwrap().0, "{share}");
            }
        }
    }
}

//! Noise of grey values, and the voxels that it puts in doubt.

use std::cmp::Reverse;

use crate::{Grey, Histogram};

/// Median distance from the mean of a bell curve, in standard deviations.
const MEDIAN: f64 = 0.6745;

impl Histogram {
    /// Standard deviation of the noise: of the lower flank of the darkest phase or the upper flank of the brightest by
    /// `grey`, whichever is larger. Voxels of two phases reach neither; a flank that is cut off at the end of the scale has
    /// no width. What is around a round field of view does not count.
    pub fn noise(&self, grey: &Grey) -> f64 {
        let mut counts = self.counts.clone();
        if let Some(padding) = self.padding {
            counts[padding.place] -= padding.voxels;
        }
        let (first, last) = grey.outer_thresholds();
        let below = |value: f64| {
            let places = (0..counts.len()).take_while(|i| self.scale.value(*i) < value);
            places.count()
        };
        let dark = flank(counts[..below(first)].iter());
        let bright = flank(counts[below(last)..].iter().rev());
        let step = self.scale.value(1) - self.scale.value(0);
        dark.max(bright) * step
    }

    /// Share of the voxels that have another phase where thresholds are `by` lower than where they are `by` higher.
    pub fn in_doubt(&self, grey: &Grey, by: f64) -> f64 {
        let [low, high] = [-by, by].map(|by| grey.moved(by));
        let doubtful = |(value, _): &(f64, u64)| low.phase(*value) != high.phase(*value);
        let voxels: u64 = self.values().filter(doubtful).map(|(_, n)| n).sum();
        voxels as f64 / self.counts.iter().sum::<u64>() as f64
    }
}

/// Standard deviation of the bell curve that begins with the first of `counts`, by the half before its middle: what is on
/// its other side may be mixed with another phase. The middle is that of the shortest range with a quarter of all voxels;
/// the median of the distances from there is not moved by hot and dark pixels.
fn flank<'a>(counts: impl Iterator<Item = &'a u64>) -> f64 {
    let counts: Vec<u64> = counts.copied().collect();
    let quarter = counts.iter().sum::<u64>().div_ceil(4);
    let (mut from, mut voxels) = (0, 0);
    // Of equal ranges the one with most voxels.
    let mut shortest = None;
    for to in 0..counts.len() {
        voxels += counts[to];
        while voxels > 0 && voxels - counts[from] >= quarter {
            voxels -= counts[from];
            from += 1;
        }
        if voxels >= quarter {
            let range = (to - from, Reverse(voxels), from);
            shortest = Some(shortest.map_or(range, |least| range.min(least)));
        }
    }
    let Some((length, _, start)) = shortest else {
        return 0.0;
    };
    // In halves: the middle may lie between two values, and half of its own voxels are on either side.
    let middle = 2 * start + length;
    let before = |i: usize| counts[i] as f64 * if 2 * i == middle { 0.5 } else { 1.0 };
    let flank = || (0..=middle / 2).rev();
    let mut left = 0.5 * flank().map(before).sum::<f64>();
    let median = flank().find(|i| {
        left -= before(*i);
        left <= 0.0
    });
    // The voxels of a value are spread evenly over the step around it.
    let distance = |i: usize| 0.5 * (middle + 1 - 2 * i) as f64 + left / before(i);
    median
        .filter(|i| 2 * i < middle)
        .map_or(0.0, |i| distance(i) / MEDIAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bell(i: usize, mean: f64, deviation: f64) -> f64 {
        (-0.5 * ((i as f64 - mean) / deviation).powi(2)).exp() / deviation
    }

    /// Closed form: a bell curve has its own deviation, whatever lies beyond its middle; a single value has none.
    #[test]
    fn the_outer_flank_tells_the_deviation() {
        for deviation in [2.0, 5.0, 13.0] {
            let count = |i| 1e6 * (bell(i, 60.0, deviation) + 0.5 * bell(i, 90.0, 12.0));
            let mut counts: Vec<u64> = (0..100).map(|i| count(i).round() as u64).collect();
            counts[0] += 2000;
            let found = flank(counts.iter());
            assert!(
                (found / deviation - 1.0).abs() < 0.2,
                "{deviation}: {found}"
            );
        }
        assert_eq!(flank([0, 0, 9, 0].iter()), 0.0);
        assert_eq!(flank([0, 0].iter()), 0.0);
        assert_eq!(flank([].iter()), 0.0);
    }
}

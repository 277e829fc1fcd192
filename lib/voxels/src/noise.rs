//! Noise of grey values, and the voxels that it puts in doubt.

use std::fmt;

use crate::{Grey, Histogram};

/// Share of the voxels in doubt from which phases overlap: their bell curves are then closer than 4 standard deviations.
const OVERLAP: f64 = 0.05;
/// Median distance from the mean of a bell curve, in standard deviations.
const MEDIAN: f64 = 0.6745;

/// Voxels whose phase the noise decides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Doubt {
    /// Standard deviation of the grey values of one phase.
    pub noise: f64,
    /// Share of the voxels that have another phase where thresholds are lower than where they are higher by the noise.
    pub share: f64,
}

impl Histogram {
    /// The voxels that the noise puts in doubt. It is that of the outer flank of the darkest or the brightest phase by `grey`,
    /// the wider: voxels of two phases reach neither, and one may be cut off at the end of the scale. What is around a round
    /// field of view does not count.
    pub fn doubt(&self, grey: &Grey) -> Doubt {
        let mut counts: Vec<f64> = self.counts.iter().map(|n| *n as f64).collect();
        if let Some(padding) = self.padding {
            counts[padding.place] -= padding.voxels as f64;
        }
        let phase = |i: usize| grey.phase(self.scale.value(i));
        let last = counts.len() - 1;
        let dark = (0..=last).take_while(|i| phase(*i) == phase(0)).count();
        let bright = (0..=last).take_while(|i| phase(last - i) == phase(last));
        let bright: Vec<f64> = bright.map(|i| counts[last - i]).collect();
        let steps = flank(&counts[..dark]).max(flank(&bright));
        // In whole steps: between two ranges of whole numbers no value is.
        let mut scale = self.scale;
        scale.first = 0;
        let noise = scale.value(steps.round() as usize);
        let [low, high] = [-noise, noise].map(|by| grey.moved(by));
        let doubtful = |(value, _): &(f64, u64)| low.phase(*value) != high.phase(*value);
        let voxels: u64 = self.values().filter(doubtful).map(|(_, n)| n).sum();
        let share = voxels as f64 / self.counts.iter().sum::<u64>() as f64;
        Doubt { noise, share }
    }
}

impl Doubt {
    /// Whether so many voxels are in doubt that the phases overlap.
    pub fn overlaps(&self) -> bool {
        self.share >= OVERLAP
    }
}

impl fmt::Display for Doubt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (percent, noise) = (100.0 * self.share, self.noise);
        write!(
            f,
            "{percent:.1} % of the voxels are in doubt, within the noise (a standard deviation of {noise}) of a threshold"
        )
    }
}

/// Standard deviation, in steps, of the bell curve that begins with the first of `counts`, by quantiles of the half before its
/// middle, that of the shortest range with a quarter of the voxels: what is behind may be mixed with another phase, and hot
/// and dark pixels move no quantile. Less than a step is none.
fn flank(counts: &[f64]) -> f64 {
    let total: f64 = counts.iter().sum();
    // The voxels of a value are spread evenly over the step around it.
    let quantile = |share: f64| {
        let mut left = share * total;
        let found = counts.iter().position(|n| {
            left -= n;
            left <= 0.0 && *n > 0.0
        });
        found.map_or(0.0, |i| i as f64 + 1.0 + left / counts[i])
    };
    let length = |percent: &u8| {
        let share = f64::from(*percent) / 100.0;
        quantile(share + 0.25) - quantile(share)
    };
    // Half of the phase is before its middle, and what is mixed in is behind: the middle is hardly beyond half of all.
    let shortest = (0..=40).min_by(|a, b| length(a).total_cmp(&length(b)));
    let middle = f64::from(shortest.unwrap_or(0)) / 100.0 + 0.125;
    let deviation = (quantile(middle) - quantile(0.5 * middle)) / MEDIAN;
    if deviation < 1.0 { 0.0 } else { deviation }
}

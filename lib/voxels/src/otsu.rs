//! Thresholds that part the grey values of a stack into phases (Otsu 1979).

use std::ops::Range;
use std::str::FromStr;

use crate::histogram::{FEW, Histogram, Padding};
use crate::levels::Levels;
use crate::{Grey, Phase};

/// Distance of the means of neighbouring phases over the sum of their standard deviations, below
/// which they are not two: one bell curve cut in half has 1.32.
const PARTED: f64 = 1.4;
/// Share of the voxels from which on the value at the corners of all pages is padding.
const PADDING: f64 = 0.01;

/// Grey values of wood and adhesive by Otsu's thresholds. They are to be looked at.
#[derive(Clone, Debug, PartialEq)]
pub struct Proposal {
    /// What is proposed.
    pub grey: Grey,
    /// What was left out for it, as sentences.
    pub left_out: Vec<String>,
}

/// Grey values that are asked for.
#[derive(Clone, Debug, PartialEq)]
pub enum GreyLevels {
    /// Void, wood and adhesive by two thresholds.
    Auto,
    /// Void and undamaged wood by one.
    AutoWood,
    /// These.
    Given(Grey),
}

impl FromStr for GreyLevels {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "auto" => Ok(Self::Auto),
            "auto-wood" => Ok(Self::AutoWood),
            ranges => ranges.parse().map(Self::Given),
        }
    }
}

impl Histogram {
    /// Void, wood and adhesive, or void and wood alone, by the thresholds that make the variance between them
    /// largest; each class takes in its upper one.
    ///
    /// The order void, wood, adhesive is that of X-ray absorption. Hot and dark pixels do not count,
    /// nor does what is around a round field of view.
    ///
    /// # Errors
    /// A sentence where the phases are not found.
    pub fn propose(&self, wood_alone: bool) -> Result<Proposal, String> {
        let phases = if wood_alone { 2 } else { 3 };
        let total: u64 = self.counts.iter().sum();
        if let Some(padding) = self.padding {
            let mut counts = self.counts.clone();
            counts[padding.place] -= padding.voxels;
            // Void, too, may be one value and at all corners: there must be phases without it.
            if padding.voxels as f64 >= PADDING * total as f64 && values(&counts) >= phases {
                return self.parted(&counts, phases, Some(padding));
            }
        }
        self.parted(&self.counts, phases, None)
    }

    /// The proposal by `counts`, which are without the `padding`.
    fn parted(
        &self,
        counts: &[u64],
        phases: usize,
        padding: Option<Padding>,
    ) -> Result<Proposal, String> {
        let total: u64 = counts.iter().sum();
        let few = (FEW * total as f64) as u64;
        let mut range = shrunk(counts, 0..counts.len());
        let (levels, edges) = loop {
            let kept = &counts[range.clone()];
            if values(kept) < phases {
                return Err(too_few(phases, total - kept.iter().sum::<u64>()));
            }
            let levels = Levels::of(kept);
            let edges = levels.edges(phases);
            if levels.voxels(0, edges[1]) <= few {
                range.start += edges[1] * levels.width;
            } else if levels.voxels(edges[phases - 1], edges[phases]) <= few {
                range.end = range.start + edges[phases - 1] * levels.width;
            } else {
                break (levels, edges);
            }
            range = shrunk(counts, range);
        };
        let bright = |p: &Padding| counts[p.place + 1..].iter().sum::<u64>() <= few;
        let top = padding.filter(bright).map(|padding| padding.value);
        let threshold = |edge: &usize| self.scale.value(range.start + levels.place(*edge));
        let thresholds: Vec<f64> = edges[1..phases].iter().map(threshold).collect();
        let grey = Grey::of_thresholds(&thresholds, top, self.scale.whole);
        for (i, edges) in edges.windows(3).enumerate() {
            let apart = levels.apart([edges[0], edges[1], edges[2]]);
            if apart < PARTED || levels.voxels(edges[0], edges[1]) <= few {
                return Err(hardly_parted(i, apart, &grey));
            }
        }
        let outliers = total - counts[range.clone()].iter().sum::<u64>();
        let hot = (outliers > 0).then(|| {
            let [low, high] = [range.start, range.end - 1].map(|place| self.scale.value(place));
            format!(
                "{outliers} hot or dark voxels, below {low} or above {high}, do not count for it; --despeckle 1 gives single ones the phase around them"
            )
        });
        let around = padding.map(|Padding { value, voxels, .. }| {
            let phase = grey.phase(value).unwrap_or(Phase::Void);
            format!(
                "{voxels} voxels of {value} reach in from the corners of all pages, as around a round field of view: they do not count for it and become {phase}; --crop keeps what is inside"
            )
        });
        let left_out = hot.into_iter().chain(around).collect();
        Ok(Proposal { grey, left_out })
    }
}

/// Values that voxels have.
fn values(counts: &[u64]) -> usize {
    counts.iter().filter(|n| **n > 0).count()
}

/// The part of `range` between its first and last value that voxels have.
fn shrunk(counts: &[u64], range: Range<usize>) -> Range<usize> {
    let mut used = range.clone().filter(|&place| counts[place] > 0);
    let first = used.next().unwrap_or(range.start);
    first..used.next_back().unwrap_or(first) + 1
}

fn too_few(phases: usize, left_out: u64) -> String {
    let number = ["two", "three"][phases - 2];
    let besides = match left_out {
        0 => String::new(),
        n => format!(
            " besides {n} hot or dark voxels, each kind fewer than {} %",
            100.0 * FEW
        ),
    };
    let wood = match phases {
        3 => ", or take --grey auto-wood for wood without adhesive",
        _ => "",
    };
    format!(
        "it holds fewer than {number} grey values{besides}; {number} phases need {number}: name them with --labels{wood}"
    )
}

/// The sentence about phases of which the `lower` and the next are not two.
fn hardly_parted(lower: usize, apart: f64, grey: &Grey) -> String {
    let [lower, upper] = [lower, lower + 1].map(|phase| Phase::ALL[phase]);
    format!(
        "its grey values do not part {lower} from {upper}: the means of the two are {apart:.2} times the sum of their deviations apart, and {PARTED} are needed; look at --histogram and give ranges, such as --grey {grey}, or take --grey auto-wood for wood without adhesive"
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::histogram::Scale;

    fn of_counts(counts: Vec<u64>) -> Histogram {
        Histogram {
            scale: Scale::whole(0, counts.len()),
            counts,
            padding: None,
        }
    }

    /// Bell curves of grey values with their means, deviations and numbers of voxels.
    fn of_peaks(values: usize, peaks: &[(f64, f64, f64)]) -> Histogram {
        let bell = |x: f64, (mean, s, n): &(f64, f64, f64)| {
            n / s * (-0.5 * ((x - mean) / s).powi(2)).exp() / std::f64::consts::TAU.sqrt()
        };
        let count = |i| peaks.iter().map(|peak| bell(i as f64, peak)).sum::<f64>();
        of_counts((0..values).map(|i| count(i).round() as u64).collect())
    }

    fn phases<const N: usize>(grey: &Grey, values: [f64; N]) -> [u8; N] {
        values.map(|v| grey.phase(v).unwrap() as u8)
    }

    /// Equal peaks: thresholds lie midway; closed form.
    #[test]
    fn thresholds_lie_between_peaks() {
        for (values, first, apart, s) in [(256, 40.0, 80.0, 6.0), (65536, 8000.0, 12_000.0, 900.0)]
        {
            let peaks = [0.0, 1.0, 2.0].map(|i| (first + i * apart, s, 1e6));
            let grey = of_peaks(values, &peaks).propose(false).unwrap().grey;
            let beside = [0.4, 0.6, 1.4, 1.6].map(|i| first + i * apart);
            assert_eq!(phases(&grey, beside), [0, 1, 1, 2]);
        }
        let peaks = of_peaks(256, &[(60.0, 8.0, 1e6), (160.0, 8.0, 1e6)]);
        let said = peaks.propose(true).unwrap().grey.to_string();
        let from: f64 = said[5..said.len() - 2].parse().unwrap();
        assert!((from - 110.5).abs() <= 1.0, "{said}");
    }

    #[test]
    fn three_values_are_parted_and_two_are_not() {
        let mut counts = vec![0; 256];
        (counts[3], counts[90], counts[91]) = (5, 7, 2);
        let grey = of_counts(counts).propose(false).unwrap().grey;
        assert_eq!(phases(&grey, [3.0, 90.0, 91.0]), [0, 1, 2]);
        let mut two = of_counts(vec![1, 0, 4]);
        let said = two.propose(false).unwrap_err();
        assert!(
            said.contains("three") && said.contains("auto-wood"),
            "{said}"
        );
        two.scale.first = -128;
        assert_eq!(two.propose(true).unwrap().grey.to_string(), "wood=-127..");
        let one = of_counts(vec![0, 9]).propose(true);
        let said = one.unwrap_err();
        assert!(
            said.contains("two") && !said.contains("auto-wood"),
            "{said}"
        );
    }

    /// One bell curve has no two phases, and what is thinner than hot pixels is none.
    #[test]
    fn what_is_no_phase_is_not_proposed() {
        let wood = [(60.0, 8.0, 1e6), (160.0, 8.0, 1e6)];
        let said = of_peaks(256, &wood).propose(false).unwrap_err();
        for part in ["do not part", "auto-wood", "--grey wood="] {
            assert!(said.contains(part), "{said}");
        }
        let said = of_peaks(256, &wood[..1]).propose(true).unwrap_err();
        assert!(said.contains("void from wood"), "{said}");
        for (voxels, proposed) in [(3e4, false), (6e4, true)] {
            let peaks = [wood[0], wood[1], (240.0, 2.0, voxels)];
            assert_eq!(of_peaks(256, &peaks).propose(false).is_ok(), proposed);
        }
    }
}

//! How often each grey value stands in a stack, and thresholds between three phases.

use rayon::prelude::*;

use crate::sample::Sample;
use crate::{Crop, Error, Grey, Stack};

/// Voxels of each grey value of a stack of integers of 8 or 16 bits.
#[derive(Clone, Debug, PartialEq)]
pub struct Histogram {
    /// The value of the first entry.
    pub lowest: i64,
    /// Voxels of that value, of the next ...
    pub counts: Vec<u64>,
}

impl Histogram {
    /// Counts the voxels of `crop`, page by page on all threads.
    ///
    /// # Errors
    /// A page that cannot be read, pixels that are not one integer of 8 or 16 bits, or a crop
    /// that reaches out of the stack.
    pub fn of(stack: &Stack, crop: &Crop) -> Result<Self, Error> {
        crop.check(stack.dims()).map_err(Error::Usage)?;
        stack.check_numbers()?;
        stack.fits(stack.reading_bytes())?;
        let format = stack.format();
        let (lowest, values) = match (format.sample, format.channels) {
            (Sample::U8, 1) => (0, 1 << 8),
            (Sample::I8, 1) => (-(1 << 7), 1 << 8),
            (Sample::U16, 1) => (0, 1 << 16),
            (Sample::I16, 1) => (-(1 << 15), 1 << 16),
            _ => {
                return Err(Error::Usage(format!(
                    "{}: a histogram is made of one integer of 8 or 16 bits a pixel, and its pages are {format}",
                    stack.name()
                )));
            }
        };
        let add = |mut a: Vec<u64>, b: Vec<u64>| {
            a.iter_mut().zip(b).for_each(|(a, b)| *a += b);
            a
        };
        let count = |mut counts: Vec<u64>, page: &[u8]| {
            let pixel = format.sample.bytes();
            for row in crop.rows(format, page) {
                for value in row.chunks_exact(pixel) {
                    counts[(format.sample.value(value) as i64 - lowest) as usize] += 1;
                }
            }
            counts
        };
        let none = || vec![0; values];
        let counts = (crop.ranges()[2].clone().into_par_iter())
            .try_fold(none, |counts, z| {
                let mut page = Vec::new();
                stack.read_page(z, &mut page)?;
                Ok::<_, Error>(count(counts, &page))
            })
            .try_reduce(none, |a, b| Ok(add(a, b)))?;
        Ok(Self { lowest, counts })
    }

    /// Wood and adhesive by two thresholds that part void, wood and adhesive such that the
    /// variance between the three is largest (Otsu 1979, for two thresholds), each class taking
    /// in its upper threshold.
    ///
    /// The order void, wood, adhesive is that of X-ray absorption; it is a proposal to look at,
    /// not a measurement. At most 256 levels are told apart between the lowest and the highest
    /// value found.
    ///
    /// # Errors
    /// A sentence where fewer than three values were found.
    pub fn otsu(&self) -> Result<Grey, String> {
        let levels = Levels::of(self, 3)?;
        let last = levels.count();
        let mut best = (f64::NEG_INFINITY, 1, 2);
        for a in 1..last - 1 {
            for b in a + 1..last {
                let between = levels.weight(0, a) + levels.weight(a, b) + levels.weight(b, last);
                if between > best.0 {
                    best = (between, a, b);
                }
            }
        }
        Ok(Grey::between(levels.value(best.1), levels.value(best.2)))
    }

    /// Undamaged wood by the threshold that parts void and wood such that the variance between
    /// the two is largest (Otsu 1979), as [`Histogram::otsu`] for a stack without adhesive.
    ///
    /// # Errors
    /// A sentence where fewer than two values were found.
    pub fn otsu_of_wood(&self) -> Result<Grey, String> {
        let levels = Levels::of(self, 2)?;
        let last = levels.count();
        let between = |a: usize| levels.weight(0, a) + levels.weight(a, last);
        let first = 1;
        let best = (first..last).fold(
            first,
            |best, a| {
                if between(a) > between(best) { a } else { best }
            },
        );
        Ok(Grey::wood_from(levels.value(best)))
    }
}

/// A histogram in at most 256 levels between the lowest and the highest value found.
struct Levels {
    /// Number and sum of the values of the levels below each.
    below: Vec<(f64, f64)>,
    /// The lowest value found and the values in a level.
    lowest: i64,
    width: usize,
}

impl Levels {
    fn of(histogram: &Histogram, phases: usize) -> Result<Self, String> {
        const LEVELS: usize = 256;
        let used = |n: &u64| *n > 0;
        let counts = &histogram.counts;
        let (Some(first), Some(last)) =
            (counts.iter().position(used), counts.iter().rposition(used))
        else {
            return Err("there is no voxel".into());
        };
        if counts.iter().filter(|n| used(n)).count() < phases {
            let number = ["two", "three"][phases - 2];
            return Err(format!(
                "it holds fewer than {number} grey values; {number} phases need {number}: name them with --labels"
            ));
        }
        let width = (last - first + 1).div_ceil(LEVELS);
        let mut below = vec![(0.0, 0.0)];
        for level in counts[first..=last].chunks(width) {
            let (mut n, mut sum) = below[below.len() - 1];
            for count in level {
                n += *count as f64;
            }
            sum += (below.len() as f64 - 1.0) * level.iter().sum::<u64>() as f64;
            below.push((n, sum));
        }
        Ok(Self {
            below,
            lowest: histogram.lowest + first as i64,
            width,
        })
    }

    fn count(&self) -> usize {
        self.below.len() - 1
    }

    /// Its share of the sum over the classes of n mean^2, which is largest where the variance
    /// between is.
    fn weight(&self, from: usize, to: usize) -> f64 {
        let (low, high) = (self.below[from], self.below[to]);
        let (n, sum) = (high.0 - low.0, high.1 - low.1);
        if n > 0.0 { sum * sum / n } else { 0.0 }
    }

    /// The value at a threshold. Levels without a voxel may go to either side: half way.
    fn value(&self, level: usize) -> i64 {
        let empty = (level..self.count()).take_while(|&i| self.below[i].0 == self.below[i + 1].0);
        self.lowest + ((level + empty.count() / 2) * self.width) as i64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bell curves of grey values with their means, deviations and numbers of voxels.
    fn of_peaks(values: usize, peaks: &[(f64, f64, f64)]) -> Histogram {
        let bell = |x: f64| {
            let parts = peaks.iter().map(|(mean, s, n)| {
                n / s * (-0.5 * ((x - mean) / s).powi(2)).exp()
                    / (2.0 * std::f64::consts::PI).sqrt()
            });
            parts.sum::<f64>().round() as u64
        };
        Histogram {
            lowest: 0,
            counts: (0..values).map(|i| bell(i as f64)).collect(),
        }
    }

    /// Three equal peaks: thresholds lie midway; closed form.
    #[test]
    fn thresholds_lie_between_three_peaks() {
        let phase = |grey: &Grey, v: f64| grey.phase(v).unwrap();
        use crate::Phase::{Adhesive, Void, Wood};
        let narrow = of_peaks(
            256,
            &[(40.0, 6.0, 1e6), (120.0, 6.0, 1e6), (200.0, 6.0, 1e6)],
        );
        let grey = narrow.otsu().unwrap();
        let found = [70.0, 90.0, 150.0, 170.0].map(|v| phase(&grey, v));
        assert_eq!(found, [Void, Wood, Wood, Adhesive]);
        let wide = of_peaks(
            65536,
            &[
                (8000.0, 900.0, 1e7),
                (20_000.0, 900.0, 1e7),
                (32_000.0, 900.0, 1e7),
            ],
        );
        let grey = wide.otsu().unwrap();
        let found = [13_000.0, 15_000.0, 25_000.0, 27_000.0].map(|v| phase(&grey, v));
        assert_eq!(found, [Void, Wood, Wood, Adhesive]);
    }

    /// Two equal peaks: the threshold lies midway; closed form.
    #[test]
    fn the_threshold_of_wood_alone_lies_between_two_peaks() {
        let peaks = of_peaks(256, &[(60.0, 8.0, 1e6), (160.0, 8.0, 1e6)]);
        let said = peaks.otsu_of_wood().unwrap().to_string();
        let from: f64 = said[5..said.len() - 2].parse().unwrap();
        assert!((from - 110.5).abs() <= 1.0, "{said}");
    }

    #[test]
    fn three_values_are_parted_and_two_are_not() {
        let mut counts = vec![0; 256];
        (counts[3], counts[90], counts[91]) = (5, 7, 2);
        let three = Histogram { lowest: 0, counts };
        let grey = three.otsu().unwrap();
        let found = [3.0, 90.0, 91.0].map(|v| grey.phase(v).unwrap() as u8);
        assert_eq!(found, [0, 1, 2]);
        let two = Histogram {
            lowest: -128,
            counts: vec![1, 0, 4],
        };
        assert!(two.otsu().unwrap_err().contains("three"));
        assert_eq!(two.otsu_of_wood().unwrap().to_string(), "wood=-127..");
        let one = Histogram {
            lowest: 0,
            counts: vec![0, 9],
        };
        assert!(one.otsu_of_wood().unwrap_err().contains("two"));
    }
}

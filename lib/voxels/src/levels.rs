//! Counts in few levels, and the classes that part them best.

/// Most levels that are told apart.
const LEVELS: usize = 256;

/// Counts in at most 256 levels.
pub(crate) struct Levels {
    /// Number, sum and sum of squares of the values of the levels below each.
    below: Vec<[f64; 3]>,
    /// Values in a level.
    pub(crate) width: usize,
}

impl Levels {
    pub(crate) fn of(counts: &[u64]) -> Self {
        let width = counts.len().div_ceil(LEVELS);
        let mut below = vec![[0.0; 3]];
        for (i, level) in counts.chunks(width).enumerate() {
            let (n, value) = (level.iter().sum::<u64>() as f64, i as f64);
            let [number, sum, squares] = below[i];
            below.push([number + n, sum + n * value, squares + n * value * value]);
        }
        Self { below, width }
    }

    fn count(&self) -> usize {
        self.below.len() - 1
    }

    fn sums(&self, from: usize, to: usize) -> [f64; 3] {
        [0, 1, 2].map(|i| self.below[to][i] - self.below[from][i])
    }

    pub(crate) fn voxels(&self, from: usize, to: usize) -> u64 {
        self.sums(from, to)[0] as u64
    }

    /// Its share of the sum over the classes of n mean^2, which is largest where the variance
    /// between is.
    fn weight(&self, from: usize, to: usize) -> f64 {
        let [n, sum, _] = self.sums(from, to);
        if n > 0.0 { sum * sum / n } else { 0.0 }
    }

    /// The first level of each of two or three phases, and the end of the last.
    pub(crate) fn edges(&self, phases: usize) -> Vec<usize> {
        let last = self.count();
        let mut best = (f64::NEG_INFINITY, Vec::new());
        for a in 1..last {
            // With two phases the third class is empty.
            let seconds = if phases == 2 {
                last..last + 1
            } else {
                a + 1..last
            };
            for b in seconds {
                let weight = self.weight(0, a) + self.weight(a, b) + self.weight(b, last);
                if weight > best.0 {
                    best = (weight, vec![0, a, b, last]);
                }
            }
        }
        best.1.truncate(phases + 1);
        best.1
    }

    /// Distance of the means of two neighbouring classes over the sum of their standard deviations.
    pub(crate) fn apart(&self, [from, to, end]: [usize; 3]) -> f64 {
        let class = |from, to| {
            let [n, sum, squares] = self.sums(from, to);
            let mean = sum / n;
            (mean, (squares / n - mean * mean).max(0.0).sqrt())
        };
        let ((low, low_s), (high, high_s)) = (class(from, to), class(to, end));
        (high - low) / (low_s + high_s)
    }

    /// The place of the threshold at a level. Levels without a voxel may go to either side: half way.
    pub(crate) fn place(&self, level: usize) -> usize {
        let empty = (level..self.count()).take_while(|&i| self.voxels(i, i + 1) == 0);
        (level + empty.count() / 2) * self.width
    }
}

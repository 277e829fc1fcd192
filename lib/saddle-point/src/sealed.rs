//! Mean pressures of sealed liquid, which the multigrid cycle cannot resolve.

use crate::components::components;
use crate::csr::{Csr, value_at};
use crate::vector::Real;

/// Row sums of a component below this fraction of its diagonals are lost in the cycle's single precision. At 2e-9 presses
/// with air were not solved.
const SEALED: f64 = 1e-6;
/// Row sums below this fraction are rounding in double precision.
const ROUNDING: f64 = 1e-13;
/// Net displaced volume in a pocket, over the sum of its absolute values, below which it is rounding: the body carries the
/// pocket along.
const CARRIED: f64 = 1e-6;

/// Pockets of liquid that are sealed, or nearly: connected cells on which the Poisson operator is singular, or nearly. Almost no
/// flow changes their volume, so their mean residual depends on mean pressure and bodies only: `-C p + s V`, with leaks counted
/// to C.
pub(crate) struct Sealed {
    /// Cells of each pocket.
    pockets: Vec<Vec<u32>>,
    /// Number of cells over the sum of `C`, for each pocket; 0 if that sum is zero.
    stiffness: Vec<f64>,
}

impl Sealed {
    /// The sealed pockets of the Poisson operator `matrix` with compressibilities `c`.
    pub(crate) fn find(matrix: &Csr<f64>, c: &[f64]) -> Self {
        let (mut pockets, mut stiffness) = (Vec::new(), Vec::new());
        let neighbours = |row: u32| matrix.row(row as usize).0.iter().copied();
        for pocket in components(matrix.n_rows(), neighbours) {
            let (mut leak, mut whole, mut soft) = (0.0_f64, 0.0, 0.0_f64);
            for row in pocket.iter().map(|&row| row as usize) {
                leak += matrix.row(row).1.iter().sum::<f64>();
                whole += value_at(matrix.row(row), row);
                soft += c[row];
            }
            if leak.abs() > SEALED * whole {
                continue;
            }
            let soft = soft.max(if leak > ROUNDING * whole { leak } else { 0.0 });
            let cells = pocket.len() as f64;
            stiffness.push(if soft > 0.0 { cells / soft } else { 0.0 });
            pockets.push(pocket);
        }
        Self { pockets, stiffness }
    }

    /// Whether there are no sealed pockets.
    pub(crate) fn is_empty(&self) -> bool {
        self.pockets.is_empty()
    }

    /// Mean over each pocket.
    pub(crate) fn means<T: Real>(&self, x: &[T]) -> Vec<f64> {
        let mean = |pocket: &Vec<u32>| {
            let sum: f64 = pocket.iter().map(|&row| x[row as usize].into()).sum();
            sum / pocket.len() as f64
        };
        self.pockets.iter().map(mean).collect()
    }

    /// Subtracts a value on each pocket.
    pub(crate) fn subtract<T: Real>(&self, values: &[f64], x: &mut [T]) {
        for (pocket, &value) in self.pockets.iter().zip(values) {
            let value = T::nearest(value);
            for &row in pocket {
                x[row as usize] = x[row as usize] - value;
            }
        }
    }

    /// Subtracts the mean over each pocket.
    pub(crate) fn remove_mean<T: Real>(&self, x: &mut [T]) {
        self.subtract(&self.means(x), x);
    }

    /// Mean over each pocket of the volumes `column` that a body displaces at unit speed; 0 if it carries the pocket along.
    pub(crate) fn displaced(&self, column: &[f64]) -> Vec<f64> {
        let parts: Vec<f64> = column.iter().map(|moved| moved.abs()).collect();
        let moved = (self.means(column).into_iter()).zip(self.means(&parts));
        let moved = moved.map(|(moved, parts)| match moved.abs() > CARRIED * parts {
            true => moved,
            false => 0.0,
        });
        moved.collect()
    }

    /// Negative mean pressures due to mean volume residuals.
    pub(crate) fn negative_pressures(&self, residuals: impl Iterator<Item = f64>) -> Vec<f64> {
        residuals.zip(&self.stiffness).map(|(r, s)| r * s).collect()
    }

    /// Force on a body that displaces `moved` on the mean, due to the mean volumes `volumes` pushed into the pockets.
    pub(crate) fn force(&self, moved: &[f64], volumes: &[f64]) -> f64 {
        let pockets = self.pockets.iter().zip(&self.stiffness);
        let of = |(((pocket, stiffness), moved), volume): (((&Vec<u32>, &f64), &f64), &f64)| {
            pocket.len() as f64 * moved * volume * stiffness
        };
        pockets.zip(moved).zip(volumes).map(of).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two cells whose row sums are the fraction `leak` of their diagonals.
    fn sealed(leak: f64) -> Sealed {
        let matrix = Csr::assemble(2, 2, |row, entries| {
            entries.add(row, 1.0);
            entries.add(1 - row, leak - 1.0);
        });
        Sealed::find(&matrix.unwrap(), &[1e-17, 3e-17])
    }

    #[test]
    fn what_leaks_counts_with_what_yields_unless_it_is_rounding() {
        let stiffness = |leak| sealed(leak).stiffness;
        assert_eq!(stiffness(2e-15), [2.0 / 4e-17]);
        assert!((stiffness(1e-9)[0] * 1e-9 - 1.0).abs() < 1e-6);
        assert!(stiffness(3e-6).is_empty());
    }

    #[test]
    fn a_pocket_that_a_body_carries_along_does_not_hold_it() {
        let resistance = |column: [f64; 2]| {
            let moved = sealed(0.0).displaced(&column);
            sealed(0.0).force(&moved, &moved)
        };
        assert_eq!(resistance([0.1, 1e-9 - 0.1]), 0.0);
        let whole: f64 = 0.1 - 0.0999;
        assert!((resistance([0.1, -0.0999]) * 4e-17 / whole.powi(2) - 1.0).abs() < 1e-9);
    }
}

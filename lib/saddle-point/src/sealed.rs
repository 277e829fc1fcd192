//! Mean pressures of sealed and leaking liquid, which the multigrid cycle cannot resolve.

use crate::components::components;
use crate::csr::{Csr, value_at};
use crate::vector::Real;

/// Row sums of a component below this fraction of its diagonals are lost in the cycle's single precision. At 2e-9 presses
/// with air were not solved.
const SEALED: f64 = 1e-6;
/// Row sums below this fraction are rounding in double precision.
const ROUNDING: f64 = 1e-13;
/// Estimated leak over compressibility from which a pocket leaks. Below it the leak is left out, which does no harm until it is
/// a hundred times the estimate.
const LEAKING: f64 = 1e-2;
/// Net displaced volume in a pocket, over the sum of its absolute values, below which it is rounding: the body carries the
/// pocket along.
const CARRIED: f64 = 1e-6;

/// Pockets of liquid that are sealed, or nearly: connected cells on which the Poisson operator is singular, or nearly. Almost no
/// flow changes the volume of a sealed one, so its mean residual depends on mean pressure and bodies only: `-C p + s V`. That of
/// a leaking one depends on the flow through its openings, whose resistance the operator only estimates.
pub(crate) struct Sealed {
    /// Cells of each pocket.
    pockets: Vec<Vec<u32>>,
    /// Number of cells over the sum of `C`, for each pocket; 0 if that sum is zero, or if the pocket leaks.
    stiffness: Vec<f64>,
    /// Number of cells over the estimated leak, for each pocket; 0 if it is sealed.
    leak_stiffness: Vec<f64>,
}

impl Sealed {
    /// The sealed pockets of the Poisson operator `matrix` with compressibilities `c`.
    pub(crate) fn find(matrix: &Csr<f64>, c: &[f64]) -> Self {
        let mut found = Self {
            pockets: Vec::new(),
            stiffness: Vec::new(),
            leak_stiffness: Vec::new(),
        };
        let neighbours = |row: u32| matrix.row(row as usize).0.iter().copied();
        for pocket in components(matrix.n_rows(), neighbours) {
            let (mut leak, mut whole, mut soft) = (0.0_f64, 0.0, 0.0);
            for row in pocket.iter().map(|&row| row as usize) {
                leak += matrix.row(row).1.iter().sum::<f64>();
                whole += value_at(matrix.row(row), row);
                soft += c[row];
            }
            if leak.abs() > SEALED * whole {
                continue;
            }
            let cells = pocket.len() as f64;
            let [sealed, leaking] = match leak - soft > (ROUNDING * whole).max(LEAKING * soft) {
                true => [0.0, cells / leak],
                false if soft > 0.0 => [cells / soft, 0.0],
                false => [0.0; 2],
            };
            found.stiffness.push(sealed);
            found.leak_stiffness.push(leaking);
            found.pockets.push(pocket);
        }
        found
    }

    /// Whether all pockets leak, if there are any.
    pub(crate) fn is_empty(&self) -> bool {
        self.stiffness.iter().all(|stiffness| *stiffness == 0.0)
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

    /// Subtracts the mean over each pocket; returns the means.
    pub(crate) fn remove_means<T: Real>(&self, x: &mut [T]) -> Vec<f64> {
        let means = self.means(x);
        self.subtract(&means, x);
        means
    }

    /// Subtracts the estimated mean pressures of leaking pockets due to mean volume residuals.
    pub(crate) fn subtract_leak_pressures<T: Real>(&self, residuals: &[f64], p: &mut [T]) {
        let pressures = residuals.iter().zip(&self.leak_stiffness);
        let pressures: Vec<f64> = pressures.map(|(r, s)| r * s).collect();
        self.subtract(&pressures, p);
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
    fn what_leaks_more_than_it_yields_is_not_sealed_unless_by_rounding() {
        let of = |leak| sealed(leak);
        assert_eq!(of(2e-15).stiffness, [2.0 / 4e-17]);
        assert_eq!(of(2e-15).leak_stiffness, [0.0]);
        assert_eq!(of(1e-9).stiffness, [0.0]);
        assert!((of(1e-9).leak_stiffness[0] * 1e-9 - 1.0).abs() < 1e-6);
        assert!(of(3e-6).pockets.is_empty());
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

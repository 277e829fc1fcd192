//! Mean pressures of sealed liquid, which the multigrid cycle cannot resolve.

use crate::csr::Csr;
use crate::pockets::{ClosedPockets, sum_and_diagonal};

/// Row sums of a component below this fraction of its diagonals are lost in the cycle's single precision. At 2e-9 presses
/// with air were not solved.
const SEALED: f64 = 1e-6;
/// Row sums below this fraction are rounding in double precision.
const ROUNDING: f64 = 1e-13;
/// Net displaced volume in a pocket, over the sum of its absolute values, below which it is rounding: the body carries the
/// pocket along.
const CARRIED: f64 = 1e-6;

/// Pockets of liquid that are sealed, or nearly, and their stiffness. Almost no flow changes their volume, so their mean
/// residual depends on mean pressure and bodies only: `-C p + s V`, with leaks counted to C.
pub(crate) struct Sealed {
    pub(crate) pockets: ClosedPockets,
    /// Number of cells over the sum of `C`, for each pocket; 0 if that sum is zero.
    stiffness: Vec<f64>,
}

impl Sealed {
    /// The sealed pockets of the Poisson operator `matrix` with compressibilities `c`.
    pub(crate) fn find(matrix: &Csr<f64>, c: &[f64]) -> Self {
        let sums = |pocket: &[u32]| {
            (pocket.iter()).fold((0.0, 0.0), |(leak, whole), &row| {
                let (sum, diagonal) = sum_and_diagonal(matrix, row);
                (leak + sum, whole + diagonal)
            })
        };
        let pockets = ClosedPockets::of(matrix, |pocket| {
            let (leak, whole) = sums(pocket);
            leak.abs() <= SEALED * whole
        });
        let stiffness = |pocket: &Vec<u32>| {
            let (leak, whole) = sums(pocket);
            let leak = if leak > ROUNDING * whole { leak } else { 0.0 };
            let soft: f64 = pocket.iter().map(|&row| c[row as usize]).sum();
            match soft.max(leak) {
                soft if soft > 0.0 => pocket.len() as f64 / soft,
                _ => 0.0,
            }
        };
        Self {
            stiffness: pockets.members.iter().map(stiffness).collect(),
            pockets,
        }
    }

    /// Whether there are no sealed pockets.
    pub(crate) fn is_empty(&self) -> bool {
        self.stiffness.is_empty()
    }

    /// Adds the mean pressures that follow from the volume residuals `r` to the pressures `p`.
    pub(crate) fn add_mean_pressures(&self, r: &[f64], p: &mut [f64]) {
        self.add(&self.pockets.means(r), &self.stiffness, p);
    }

    /// The same from the mean residuals `r`, in pockets in which the body displaces nothing.
    pub(crate) fn add_means_of_undisplaced(
        &self,
        response: &PocketResponse,
        r: &[f64],
        p: &mut [f64],
    ) {
        let stiffness: Vec<f64> = (self.stiffness.iter().zip(&response.0))
            .map(|(stiffness, pocket)| if pocket.moved == 0.0 { *stiffness } else { 0.0 })
            .collect();
        self.add(r, &stiffness, p);
    }

    fn add(&self, r: &[f64], stiffness: &[f64], p: &mut [f64]) {
        let means: Vec<f64> = r.iter().zip(stiffness).map(|(r, s)| r * s).collect();
        self.pockets.subtract(&means, p);
    }

    /// The pockets' response to a body that displaces the volumes `column` at unit speed.
    pub(crate) fn response_to(&self, column: &[f64]) -> PocketResponse {
        let parts: Vec<f64> = column.iter().map(|moved| moved.abs()).collect();
        let moved = (self.pockets.means(column).into_iter()).zip(self.pockets.means(&parts));
        let moved = moved.map(|(moved, parts)| match moved.abs() > CARRIED * parts {
            true => moved,
            false => 0.0,
        });
        let pockets = (self.pockets.members.iter()).zip(&self.stiffness);
        PocketResponse(
            (moved.zip(pockets))
                .map(|(moved, (pocket, stiffness))| DisplacedPocket {
                    moved,
                    total: moved * pocket.len() as f64,
                    // Other pockets are not affected.
                    stiffness: if moved == 0.0 { 0.0 } else { *stiffness },
                })
                .collect(),
        )
    }
}

/// Response of sealed pockets to a body that displaces liquid in them.
pub(crate) struct PocketResponse(Vec<DisplacedPocket>);

struct DisplacedPocket {
    /// Mean and sum over the pocket of the volumes that the body displaces at unit speed.
    moved: f64,
    total: f64,
    stiffness: f64,
}

impl PocketResponse {
    /// Force on the body at unit speed.
    pub(crate) fn resistance(&self) -> f64 {
        let of = |pocket: &DisplacedPocket| pocket.total * pocket.moved * pocket.stiffness;
        self.0.iter().map(of).sum()
    }

    /// Force on the body at rest due to the mean residuals `r`.
    pub(crate) fn force_at_rest(&self, r: &[f64]) -> f64 {
        let of = |(pocket, r): (&DisplacedPocket, &f64)| -pocket.total * r * pocket.stiffness;
        self.0.iter().zip(r).map(of).sum()
    }

    /// Negative mean pressures due to the mean residuals `r` and the body's speed.
    pub(crate) fn negative_pressures(&self, r: &[f64], speed: f64) -> Vec<f64> {
        let of =
            |(pocket, r): (&DisplacedPocket, &f64)| (r - pocket.moved * speed) * pocket.stiffness;
        self.0.iter().zip(r).map(of).collect()
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
        let resistance = |moved: [f64; 2]| sealed(0.0).response_to(&moved).resistance();
        assert_eq!(resistance([0.1, 1e-9 - 0.1]), 0.0);
        let whole: f64 = 0.1 - 0.0999;
        assert!((resistance([0.1, -0.0999]) * 4e-17 / whole.powi(2) - 1.0).abs() < 1e-9);
    }
}

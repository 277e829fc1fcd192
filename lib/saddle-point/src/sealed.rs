//! Mean pressures of liquid that is sealed off, which the multigrid cycle cannot tell.

use crate::csr::Csr;
use crate::pockets::{ClosedPockets, sum_and_diagonal};

/// Row sums of a component below this fraction of its diagonals are lost in the cycle's single precision; by 2e-9 presses with
/// air were not solved.
const SEALED: f64 = 1e-6;
/// Row sums below this fraction are rounding in double precision.
const ROUNDING: f64 = 1e-13;
/// Part of what a body displaces in a pocket below which the whole is rounding: it carries the pocket along.
const CARRIED: f64 = 1e-6;

/// Liquid that is closed off or nearly, and what it resists with. Next to no flow changes the volume of one: its mean
/// residual is of mean pressure and bodies alone, `-C p + s V`, with what leaks counted to C.
pub(crate) struct Sealed {
    pub(crate) pockets: ClosedPockets,
    /// Mean of `1/C`; none where that is zero.
    stiffness: Vec<f64>,
}

impl Sealed {
    /// Those of the Poisson operator `matrix`, of the compressibility `c`.
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

    /// Whether there are none.
    pub(crate) fn is_empty(&self) -> bool {
        self.stiffness.is_empty()
    }

    /// Adds the means that follow from the volumes `r` to the pressures `p`.
    pub(crate) fn begin(&self, r: &[f64], p: &mut [f64]) {
        self.add(&self.pockets.means(r), &self.stiffness, p);
    }

    /// The same of mean volumes `r` where a body displaces nothing.
    pub(crate) fn begin_others(&self, held: &Held, r: &[f64], p: &mut [f64]) {
        let stiffness: Vec<f64> = (self.stiffness.iter().zip(&held.0))
            .map(|(stiffness, held)| if held.moved == 0.0 { *stiffness } else { 0.0 })
            .collect();
        self.add(r, &stiffness, p);
    }

    fn add(&self, r: &[f64], stiffness: &[f64], p: &mut [f64]) {
        let means: Vec<f64> = r.iter().zip(stiffness).map(|(r, s)| r * s).collect();
        self.pockets.subtract(&means, p);
    }

    /// What a body meets that displaces `column` in each cell at unit speed.
    pub(crate) fn hold(&self, column: &[f64]) -> Held {
        let parts: Vec<f64> = column.iter().map(|moved| moved.abs()).collect();
        let moved = (self.pockets.means(column).into_iter()).zip(self.pockets.means(&parts));
        let moved = moved.map(|(moved, parts)| match moved.abs() > CARRIED * parts {
            true => moved,
            false => 0.0,
        });
        let pockets = (self.pockets.members.iter()).zip(&self.stiffness);
        Held(
            (moved.zip(pockets))
                .map(|(moved, (pocket, stiffness))| HeldPocket {
                    moved,
                    whole: moved * pocket.len() as f64,
                    // Others stay as they began.
                    stiffness: if moved == 0.0 { 0.0 } else { *stiffness },
                })
                .collect(),
        )
    }
}

/// Sealed pockets and a body that displaces liquid in them.
pub(crate) struct Held(Vec<HeldPocket>);

struct HeldPocket {
    /// Mean over the pocket of what the body displaces in it at unit speed, and the whole.
    moved: f64,
    whole: f64,
    stiffness: f64,
}

impl Held {
    /// Force on the body by its unit speed.
    pub(crate) fn resistance(&self) -> f64 {
        let of = |held: &HeldPocket| held.whole * held.moved * held.stiffness;
        self.0.iter().map(of).sum()
    }

    /// Force on the body, at rest, by the mean volumes `r`.
    pub(crate) fn push(&self, r: &[f64]) -> f64 {
        let of = |(held, r): (&HeldPocket, &f64)| -held.whole * r * held.stiffness;
        self.0.iter().zip(r).map(of).sum()
    }

    /// Mean pressures, taken negative, by the mean volumes `r` and the body's speed.
    pub(crate) fn suction(&self, r: &[f64], speed: f64) -> Vec<f64> {
        let of = |(held, r): (&HeldPocket, &f64)| (r - held.moved * speed) * held.stiffness;
        self.0.iter().zip(r).map(of).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two cells whose rows leak a part of their diagonals.
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
        let resistance = |moved: [f64; 2]| sealed(0.0).hold(&moved).resistance();
        assert_eq!(resistance([0.1, 1e-9 - 0.1]), 0.0);
        let whole: f64 = 0.1 - 0.0999;
        assert!((resistance([0.1, -0.0999]) * 4e-17 / whole.powi(2) - 1.0).abs() < 1e-9);
    }
}

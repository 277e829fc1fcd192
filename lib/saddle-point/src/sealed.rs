//! Mean pressures of liquid that is sealed off, which the multigrid cycle cannot tell.

use crate::csr::Csr;
use crate::pockets::ClosedPockets;
use crate::vector::Work;

/// Row sums of a component below this fraction of its diagonals are lost in the cycle's single precision.
const SEALED: f64 = 1e-8;
/// Closed pockets and what their compressible liquid resists with. No flow changes the volume of one: its mean
/// residual is of mean pressure and bodies alone, `-C p + s V`.
pub(crate) struct Sealed {
    pub(crate) pockets: ClosedPockets,
    /// Mean of `1/C`; none where that is zero.
    stiffness: Vec<f64>,
}

impl Sealed {
    /// Those of the Poisson operator `matrix`, of the compressibility `c`.
    pub(crate) fn find(matrix: &Csr<f64>, c: &[f64]) -> Self {
        let pockets = ClosedPockets::find(matrix, SEALED);
        let stiffness = |c: f64| if c > 0.0 { 1.0 / c } else { 0.0 };
        Self {
            stiffness: pockets.means(c).into_iter().map(stiffness).collect(),
            pockets,
        }
    }

    /// Whether there are none.
    pub(crate) fn is_empty(&self) -> bool {
        self.stiffness.is_empty()
    }

    /// Adds the means that follow from the volumes `r` to the pressures `p`.
    pub(crate) fn begin(&self, r: &[f64], p: &mut [f64]) {
        let means: Vec<f64> = (self.pockets.means(r).iter())
            .zip(&self.stiffness)
            .map(|(r, stiffness)| r * stiffness)
            .collect();
        self.pockets.subtract(&means, p);
    }

    /// What a body meets that displaces `column` in each cell at unit speed.
    pub(crate) fn hold(&self, column: &[Work]) -> Held {
        let moved = self.pockets.means(column);
        // Others stay as they began.
        let stiffness = (moved.iter().zip(&self.stiffness))
            .map(|(moved, stiffness)| if *moved == 0.0 { 0.0 } else { *stiffness })
            .collect();
        Held {
            whole: (moved.iter().zip(self.pockets.sizes()))
                .map(|(moved, size)| moved * size)
                .collect(),
            moved,
            stiffness,
        }
    }
}

/// Sealed pockets and a body that displaces liquid in them.
pub(crate) struct Held {
    /// Mean over each pocket of what the body displaces in it at unit speed, and the whole.
    moved: Vec<f64>,
    whole: Vec<f64>,
    stiffness: Vec<f64>,
}

impl Held {
    /// Force on the body by its unit speed.
    pub(crate) fn resistance(&self) -> f64 {
        (self.whole.iter().zip(&self.moved).zip(&self.stiffness))
            .map(|((whole, moved), stiffness)| whole * moved * stiffness)
            .sum()
    }

    /// Force on the body, at rest, by the mean volumes `r`.
    pub(crate) fn push(&self, r: &[f64]) -> f64 {
        (self.whole.iter().zip(r).zip(&self.stiffness))
            .map(|((whole, r), stiffness)| -whole * r * stiffness)
            .sum()
    }

    /// Mean pressures, taken negative, by the mean volumes `r` and the body's speed.
    pub(crate) fn suction(&self, r: &[f64], speed: f64) -> Vec<f64> {
        (self.moved.iter().zip(r).zip(&self.stiffness))
            .map(|((moved, r), stiffness)| (r - moved * speed) * stiffness)
            .collect()
    }
}

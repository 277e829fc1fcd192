//! The preconditioner of the coupled system: Chebyshev iteration for the velocities, an approximate Schur complement for the
//! pressures, and a Vanka sweep for both.

use crate::SolveError;
use crate::chebyshev::Chebyshev;
use crate::csr::Csr;
use crate::fgmres::Precondition;
use crate::schur::Schur;
use crate::sealed::Sealed;
use crate::system::SaddleSystem;
use crate::vanka::Vanka;
use crate::vector::{Real, Work, for_each};

/// Degree of the Chebyshev polynomial for `A^-1`. Lower degrees cost more in iterations than they save: a hard step of a bond
/// of 100 x 394 x 100 voxels takes 69 iterations with degree 14 and 25 with 24.
const DEGREE: usize = 24;
/// Largest over smallest eigenvalue of `D^-1 A` in the interval of the polynomial.
const RATIO: f64 = 400.0;

/// `[Ahat, 0; -G, -Shat]^-1`, then one sweep of [`Vanka`] for the remaining residual.
pub(crate) struct Preconditioner<'a> {
    g: &'a Csr<f64>,
    g_transposed: &'a Csr<f64>,
    c: &'a [f64],
    chebyshev: Chebyshev<'a>,
    /// `D^-1/2` of the velocity block.
    scale: &'a [Work],
    schur: Schur,
    vanka: Vanka,
    /// Right-hand side of the pressure solve, and residual of the volume balance after it.
    volume: Vec<Work>,
    left: Vec<Work>,
}

impl<'a> Preconditioner<'a> {
    pub(crate) fn new(
        system: &SaddleSystem<'a>,
        g_transposed: &'a Csr<f64>,
    ) -> Result<Self, SolveError> {
        Ok(Self {
            g: system.g,
            g_transposed,
            c: system.c,
            vanka: Vanka::new(system),
            chebyshev: Chebyshev::new(system.a, DEGREE, RATIO),
            scale: &system.a.scale,
            schur: Schur::new(system, g_transposed)?,
            volume: vec![Work::default(); system.g.n_rows()],
            left: Vec::new(),
        })
    }

    /// Sealed pockets, whose mean pressures [`Precondition::apply`] does not change.
    pub(crate) fn sealed(&self) -> &Sealed {
        &self.schur.sealed
    }

    /// Upper bound of the eigenvalues of `D^-1 A`.
    pub(crate) fn bound(&self) -> f64 {
        self.chebyshev.bound
    }
}

impl Precondition for Preconditioner<'_> {
    /// `u = Ahat^-1 r_u`, `p = -Shat^-1 (r_p + G u)`; then the sweep.
    fn apply(&mut self, r: &[Work], z: &mut Vec<Work>) {
        let (r_u, r_p) = r.split_at(self.g.n_columns());
        z.resize(r.len(), Work::default());
        let (velocity, pressure) = z.split_at_mut(r_u.len());
        self.chebyshev.apply(r_u, velocity);
        let (g, u) = (self.g, &*velocity);
        for_each(&mut self.volume, |cell, out| {
            *out = r_p[cell] + Work::nearest(g.row_times_wide(cell, u));
        });
        self.left.clone_from(&self.volume);
        self.schur.apply_negative(&mut self.volume, pressure);
        let (c, p) = (self.c, &*pressure);
        for_each(&mut self.left, |cell, left| {
            *left += Work::nearest(c[cell]) * p[cell]
        });
        let g_transposed = self.g_transposed;
        let push = |face| Work::nearest(g_transposed.row_times_wide(face, p));
        let left = (self.chebyshev.residual(push), &self.left[..]);
        self.vanka.sweep(left, self.scale, velocity, pressure);
    }

    fn strengthen(&mut self) -> bool {
        self.chebyshev.widen()
    }

    fn correct_in_double(&self, r: &[f64], x: &mut [f64]) -> bool {
        let (faces, sealed) = (self.g.n_columns(), self.sealed());
        sealed.add_mean_pressures(&r[faces..], &mut x[faces..]);
        !sealed.is_empty()
    }
}

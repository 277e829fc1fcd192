//! The preconditioner of the coupled system: Chebyshev iteration for the velocities, an approximate Schur complement for the
//! pressures.

use crate::SolveError;
use crate::chebyshev::Chebyshev;
use crate::csr::Csr;
use crate::fgmres::Precondition;
use crate::schur::Schur;
use crate::sealed::Sealed;
use crate::system::SaddleSystem;
use crate::vector::{Real, Work, for_each};

/// Largest over smallest eigenvalue of `D^-1 A` in the interval of the polynomial. From 400 to 1600 a bond takes about the same
/// time to solve; 100 and 200 take more iterations than they save.
const RATIO: f64 = 400.0;

/// `[Ahat, 0; -G, -Shat]^-1`.
pub(crate) struct Preconditioner<'a> {
    g: &'a Csr<f64>,
    chebyshev: Chebyshev<'a>,
    schur: Schur,
    /// Right-hand side of the pressure solve.
    volume: Vec<Work>,
}

impl<'a> Preconditioner<'a> {
    pub(crate) fn new(
        system: &SaddleSystem<'a>,
        g_transposed: &Csr<f64>,
    ) -> Result<Self, SolveError> {
        Ok(Self {
            g: system.g,
            chebyshev: Chebyshev::new(system.a, RATIO),
            schur: Schur::new(system, g_transposed)?,
            volume: vec![Work::default(); system.g.n_rows()],
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
    /// `u = Ahat^-1 r_u`, `p = -Shat^-1 (r_p + G u)`.
    fn apply(&mut self, r: &[Work], z: &mut Vec<Work>) {
        let (r_u, r_p) = r.split_at(self.g.n_columns());
        z.resize(r.len(), Work::default());
        let (velocity, pressure) = z.split_at_mut(r_u.len());
        self.chebyshev.apply(r_u, velocity);
        let (g, u) = (self.g, &*velocity);
        for_each(&mut self.volume, |cell, out| {
            *out = r_p[cell] + Work::nearest(g.row_times_wide(cell, u));
        });
        self.schur.apply_negative(&mut self.volume, pressure);
    }

    fn strengthen(&mut self) -> bool {
        self.chebyshev.widen()
    }

    fn correct_in_double(&self, r: &[f64], x: &mut [f64]) -> bool {
        let (faces, sealed) = (self.g.n_columns(), self.sealed());
        let means = sealed.means(&r[faces..]).into_iter();
        sealed.subtract(&sealed.negative_pressures(means), &mut x[faces..]);
        !sealed.is_empty()
    }
}

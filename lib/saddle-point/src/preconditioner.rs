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

/// Mean widths whose square is the largest over the smallest eigenvalue of the polynomial's interval. In a slit of n cells it
/// is 1.6 n^2: the slowest mode has pi^2 eta/n^2, the diagonal is 8 eta, and the eigenvalues end at 2. Widths differ; in wood,
/// factors from 1.2 to 2 take the same time.
const WIDTHS: f64 = 2.0;

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
            chebyshev: Chebyshev::new(system.a, (WIDTHS * mean_width(system)).powi(2)),
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

    fn correct_in_double(&self, r: &[f64], x: &mut [f64]) -> bool {
        let (faces, sealed) = (self.g.n_columns(), self.sealed());
        sealed.add_mean_pressures(&r[faces..], &mut x[faces..]);
        !sealed.is_empty()
    }
}

/// Mean width of the channels, cells: their volume over half the area of their walls, the closed sides of cells.
fn mean_width(system: &SaddleSystem) -> f64 {
    let sides = || (0..system.cells()).map(|cell| system.g.row(cell).0.len());
    // Four in plane strain. A cell with several neighbours at one side has more.
    let all = sides().max().unwrap_or(0).min(6);
    let walls: usize = sides().map(|open| all.saturating_sub(open)).sum();
    (2.0 * system.cells() as f64 / walls as f64).max(1.0)
}

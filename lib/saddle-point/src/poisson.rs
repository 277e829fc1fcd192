//! The scalar operator `G W G^T + C`, and its solution.

use crate::amg::Amg;
use crate::csr::Csr;
use crate::pcg::pcg;
use crate::pockets::ClosedPockets;
use crate::{SolveError, check_length};

/// `L = G W G^T + C` with its multigrid hierarchy; `G` is cells x faces, `W` and `C` diagonal.
///
/// It is solved to move volume; in the saddle-point solve a cycle of the same hierarchy with
/// `W = D_B^-1` is the friction part of the pressure preconditioner.
///
/// `C` may be zero. Cells cut off from every free surface then form closed pockets in which the
/// solution is fixed up to a constant; it is chosen with zero mean, and the mean of the right-hand
/// side over the pocket, which no displacement can remove, is ignored.
pub struct Poisson {
    matrix: Csr<f64>,
    amg: Amg,
    pockets: ClosedPockets,
}

impl Poisson {
    /// Assembles `L` from `G`, its transpose, the face weights `W` and the cell diagonal `C`, and
    /// builds the multigrid hierarchy.
    ///
    /// # Errors
    /// [`SolveError::Length`] when lengths disagree, [`SolveError::Matrix`] when a weight or an
    /// entry is negative or not finite.
    pub fn new(
        g: &Csr<f64>,
        g_transposed: &Csr<f64>,
        weight: &[f64],
        c: &[f64],
    ) -> Result<Self, SolveError> {
        check_length("face weights", weight.len(), g.n_columns())?;
        check_length(
            "rows of the transposed flux operator",
            g_transposed.n_rows(),
            g.n_columns(),
        )?;
        check_length("cell diagonal", c.len(), g.n_rows())?;
        for (name, values) in [("face weight", weight), ("cell diagonal", c)] {
            if let Some(at) = values.iter().position(|v| !(*v >= 0.0 && v.is_finite())) {
                return Err(SolveError::Matrix(format!(
                    "{name} {} at index {at}; it must be finite and not negative",
                    values[at]
                )));
            }
        }
        let matrix = operator(g, g_transposed, weight, c)?;
        let amg = Amg::new(&matrix)?;
        let pockets = ClosedPockets::find(&matrix);
        Ok(Self {
            matrix,
            amg,
            pockets,
        })
    }

    /// Number of cells.
    pub fn n_cells(&self) -> usize {
        self.matrix.n_rows()
    }

    /// Solves `L psi = rhs` to `|L psi - rhs| <= tolerance |rhs|` by conjugate gradients with
    /// multigrid, from zero. Returns the number of iterations.
    ///
    /// # Errors
    /// [`SolveError::Length`], [`SolveError::NotFinite`] or [`SolveError::NotConverged`]; `psi`
    /// then holds the last iterate.
    pub fn solve(
        &self,
        rhs: &[f64],
        psi: &mut Vec<f64>,
        tolerance: f64,
        max_iterations: usize,
    ) -> Result<usize, SolveError> {
        check_length("right-hand side", rhs.len(), self.n_cells())?;
        if let Some(row) = rhs.iter().position(|v| !v.is_finite()) {
            return Err(SolveError::NotFinite { row });
        }
        rayon::scope(|_| {
            let mut rhs = rhs.to_vec();
            self.pockets.remove_mean(&mut rhs);
            let outcome = pcg(
                &self.matrix,
                &self.amg,
                &rhs,
                psi,
                tolerance,
                max_iterations,
            );
            self.pockets.remove_mean(psi);
            if outcome.residual <= tolerance {
                Ok(outcome.iterations)
            } else {
                Err(SolveError::NotConverged {
                    iterations: outcome.iterations,
                    residual: outcome.residual,
                    tolerance,
                })
            }
        })
    }
}

/// `G W G^T + C`.
pub(crate) fn operator(
    g: &Csr<f64>,
    g_transposed: &Csr<f64>,
    weight: &[f64],
    c: &[f64],
) -> Result<Csr<f64>, SolveError> {
    Csr::assemble(g.n_rows(), g.n_rows(), |cell, entries| {
        entries.add(cell, c[cell]);
        let (faces, fluxes) = g.row(cell);
        for (&face, &flux) in faces.iter().zip(fluxes) {
            let along = flux * weight[face as usize];
            let (cells, values) = g_transposed.row(face as usize);
            for (&other, &value) in cells.iter().zip(values) {
                entries.add(other as usize, along * value);
            }
        }
    })
}

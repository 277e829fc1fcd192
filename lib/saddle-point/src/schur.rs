//! Approximate inverse of the pressure Schur complement.

use crate::SolveError;
use crate::amg::Amg;
use crate::csr::Csr;
use crate::sealed::Sealed;
use crate::system::SaddleSystem;
use crate::vector::{Real, Work, for_each};

/// `S^-1 ~ E + (G D_B^-1 G^T + C)^-1`, after Cahouet & Chabard (1988, Int. J. Numer. Meth. Fluids 8, 869-895), with Darcy
/// friction joined to inertia. The part of inertia and lumen friction `D_B` is one multigrid cycle. `E`, which stands for the
/// viscosity around a cell, is what that part lacks of the inverse diagonal.
pub(crate) struct Schur {
    amg: Amg,
    /// Sealed pockets, whose mean pressures are not changed here, and leaking ones.
    pub(crate) sealed: Sealed,
    viscous: Vec<Work>,
    friction_part: Vec<Work>,
}

impl Schur {
    pub(crate) fn new(system: &SaddleSystem, g_transposed: &Csr<f64>) -> Result<Self, SolveError> {
        let weight: Vec<f64> = system.friction.iter().map(|d| 1.0 / d).collect();
        let matrix = friction_poisson(system.g, g_transposed, &weight, system.c)?;
        let matrix = match system.pockets {
            0 => matrix,
            _ => with_positive_couplings_lumped(&matrix)?,
        };
        Ok(Self {
            amg: Amg::new(&matrix)?,
            sealed: Sealed::find(&matrix, system.c),
            viscous: viscous_part(system, &weight),
            friction_part: vec![0.0; system.g.n_rows()],
        })
    }

    /// `p = -S^-1 r`, without the means over sealed pockets. The means over all pockets are removed from `r`.
    pub(crate) fn apply_negative(&mut self, r: &mut [Work], p: &mut [Work]) {
        let means = self.sealed.remove_means(r);
        self.amg.cycle(r, &mut self.friction_part);
        self.sealed.remove_means(&mut self.friction_part);
        let (viscous, friction_part) = (&self.viscous[..], &self.friction_part[..]);
        for_each(p, |i, p| *p = -(friction_part[i] + viscous[i] * r[i]));
        self.sealed.subtract_leak_pressures(&means, p);
    }
}

/// `matrix` with its positive couplings lumped on the diagonal. A pocket of air and cells that share faces with it have
/// such couplings, but the smoother is bounded only for non-positive ones. The change is positive semi-definite.
fn with_positive_couplings_lumped(matrix: &Csr<f64>) -> Result<Csr<f64>, SolveError> {
    let n = matrix.n_rows();
    Csr::assemble(n, n, |row, entries| {
        let (columns, values) = matrix.row(row);
        for (&column, &value) in columns.iter().zip(values) {
            let place = if value > 0.0 { row } else { column as usize };
            entries.add(place, value);
        }
    })
}

/// The diagonal `E = diag(G D^-1 G^T + C)^-1 - diag(G D_B^-1 G^T + C)^-1`, at least 0, with the diagonal `D` of `A`. `mobility`
/// is `D_B^-1`.
fn viscous_part(system: &SaddleSystem, mobility: &[f64]) -> Vec<Work> {
    let diagonal: Vec<f64> = system.a.diagonal().map(|d| 1.0 / d).collect();
    let part = |cell: usize| {
        let (faces, areas) = system.g.row(cell);
        let response = |weight: &[f64]| {
            let terms = (faces.iter().zip(areas)).map(|(&face, a)| a * a * weight[face as usize]);
            terms.fold(system.c[cell], |sum, term| sum + term)
        };
        let lacking = 1.0 / response(&diagonal) - 1.0 / response(mobility);
        // Not a number in a cell without faces and compressibility: 0.
        Work::nearest(lacking.max(0.0))
    };
    (0..system.g.n_rows()).map(part).collect()
}

/// `G W G^T + C`.
fn friction_poisson(
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::VelocityBlock;

    /// The response of a single cell is that of the diagonal of A if that resists more than friction, else that of friction.
    #[test]
    fn a_single_cell_responds_by_the_diagonal() {
        let a = VelocityBlock::assemble(2, |face, row| row.add(face, [4.0, 8.0][face])).unwrap();
        let g = Csr::assemble(1, 2, |_, row| (0..2).for_each(|face| row.add(face, 0.5)));
        let g = g.unwrap();
        let response = |friction: f64| {
            let system = SaddleSystem {
                c: &[0.1],
                friction: &[friction; 2],
                ..SaddleSystem::still(&a, &g, &[1.0; 2], &[0.0; 2])
            };
            let (mut r, mut p) = ([1.0], [0.0]);
            let schur = Schur::new(&system, &g.transpose());
            schur.unwrap().apply_negative(&mut r, &mut p);
            f64::from(p[0])
        };
        let by_diagonal = -1.0 / (0.1 + 0.25 / 4.0 + 0.25 / 8.0);
        for friction in [1e-3, 1.0, 5.0] {
            assert!((response(friction) / by_diagonal - 1.0).abs() < 1e-5);
        }
        assert!((response(50.0) * (0.1 + 0.5 / 50.0) + 1.0).abs() < 1e-5);
    }
}

//! Approximate inverse of the pressure Schur complement.

use crate::SolveError;
use crate::amg::Amg;
use crate::csr::Csr;
use crate::sealed::Sealed;
use crate::system::SaddleSystem;
use crate::vector::{Real, Work, for_each};

/// `2 eta` times the response `sum g^2/A_ff` of a full cell's faces: six of area one, with `A_ff = 8 eta`.
const FULL_CELL: f64 = 1.5;

/// `S^-1 ~ E + (G D_B^-1 G^T + C)^-1`, after Cahouet & Chabard (1988, Int. J. Numer. Meth. Fluids 8, 869-895), with Darcy
/// friction joined to inertia. The viscous part is the local viscosity, `E = 2 eta`, or less in cells whose fluxes respond
/// more than those of a full cell. The part of inertia and lumen friction `D_B` is one multigrid cycle.
pub(crate) struct Schur {
    amg: Amg,
    /// Sealed pockets, whose mean pressures are not changed here.
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
            viscous: viscous_part(system),
            friction_part: vec![0.0; system.g.n_rows()],
        })
    }

    /// `p = -S^-1 r` without the means over sealed pockets, which are removed from `r`.
    pub(crate) fn apply_negative(&mut self, r: &mut [Work], p: &mut [Work]) {
        let pockets = &self.sealed.pockets;
        pockets.remove_mean(r);
        self.amg.cycle(r, &mut self.friction_part);
        pockets.remove_mean(&mut self.friction_part);
        let (viscous, friction_part) = (&self.viscous[..], &self.friction_part[..]);
        for_each(p, |i, p| *p = -(friction_part[i] + viscous[i] * r[i]));
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

/// The diagonal `E`.
fn viscous_part(system: &SaddleSystem) -> Vec<Work> {
    let diagonal: Vec<f64> = system.a.diagonal().collect();
    let part = |(cell, two_eta): (usize, &f64)| {
        let (faces, areas) = system.g.row(cell);
        let response: f64 = (faces.iter().zip(areas))
            .map(|(&face, area)| area * area / diagonal[face as usize])
            .sum();
        // Without faces the response is -0, the empty sum.
        let full = if response > 0.0 {
            FULL_CELL / response
        } else {
            *two_eta
        };
        let viscous = two_eta.min(full);
        if cell < system.cells() {
            return Work::nearest(viscous);
        }
        // The gas of a pocket is softer than the liquid around it: take what the friction part lacks of 1/S.
        let friction: f64 = (faces.iter().zip(areas))
            .map(|(&face, area)| area * area / system.friction[face as usize])
            .sum();
        let c = system.c[cell];
        let whole = 1.0 / (c + 1.0 / (viscous + 1.0 / friction));
        Work::nearest(whole - 1.0 / (c + friction))
    };
    system.two_eta.iter().enumerate().map(part).collect()
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

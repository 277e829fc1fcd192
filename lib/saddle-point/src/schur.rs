//! Approximate inverse of the pressure Schur complement.

use crate::SolveError;
use crate::amg::{Amg, Workspace};
use crate::csr::Csr;
use crate::pockets::ClosedPockets;
use crate::poisson::operator;
use crate::system::SaddleSystem;
use crate::vector::{Real, Work, for_chunks};

/// `S^-1 ~ 2 eta I + (G D_B^-1 G^T + C)^-1`: the viscous part by the local viscosity, and the part
/// of inertia and lumen friction `D_B` by a multigrid cycle (after Cahouet & Chabard 1988, Int. J.
/// Numer. Meth. Fluids 8, 869-895, with Darcy friction joined to inertia).
pub(crate) struct Schur {
    amg: Amg,
    pockets: ClosedPockets,
    two_eta: Vec<Work>,
    workspace: Workspace,
    friction_part: Vec<Work>,
}

impl Schur {
    pub(crate) fn new(system: &SaddleSystem, g_transposed: &Csr<f64>) -> Result<Self, SolveError> {
        let weight: Vec<f64> = system.friction.iter().map(|d| 1.0 / d).collect();
        let matrix = operator(system.g, g_transposed, &weight, system.c)?;
        Ok(Self {
            amg: Amg::new(&matrix)?,
            pockets: ClosedPockets::find(&matrix),
            two_eta: system.two_eta.iter().map(|&v| Work::nearest(v)).collect(),
            workspace: Workspace::default(),
            friction_part: Vec::new(),
        })
    }

    /// `p = -S^-1 r`; `r` loses its mean over closed pockets.
    pub(crate) fn apply_negative(&mut self, r: &mut [Work], p: &mut [Work]) {
        self.pockets.remove_mean(r);
        (self.amg).cycle(r, &mut self.friction_part, &mut self.workspace);
        self.pockets.remove_mean(&mut self.friction_part);
        let (two_eta, friction_part) = (&self.two_eta, &self.friction_part);
        for_chunks(p, |start, part| {
            for (i, p) in part.iter_mut().enumerate() {
                *p = -(friction_part[start + i] + two_eta[start + i] * r[start + i]);
            }
        });
    }
}

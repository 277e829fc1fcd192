//! Approximate inverse of the pressure Schur complement.

use crate::SolveError;
use crate::csr::Csr;
use crate::pcg::PcgSpace;
use crate::poisson::Poisson;
use crate::system::SaddleSystem;
use crate::vector::{Real, Work, for_chunks};

/// `S^-1 ~ 2 eta I + (G D_B^-1 G^T + C)^-1`: the viscous part by the local viscosity, and the part
/// of inertia and lumen friction `D_B` by a Poisson solve (after Cahouet & Chabard 1988, Int. J.
/// Numer. Meth. Fluids 8, 869-895, with Darcy friction joined to inertia).
pub(crate) struct Schur {
    poisson: Poisson,
    two_eta: Vec<Work>,
    cycles_each: usize,
    space: PcgSpace<Work>,
    friction_part: Vec<Work>,
    /// Cycles spent so far.
    pub(crate) cycles: usize,
}

impl Schur {
    pub(crate) fn new(
        system: &SaddleSystem,
        g_transposed: &Csr<f64>,
        cycles_each: usize,
    ) -> Result<Self, SolveError> {
        let weight: Vec<f64> = system.friction.iter().map(|d| 1.0 / d).collect();
        Ok(Self {
            poisson: Poisson::new(system.g, g_transposed, &weight, system.c)?,
            two_eta: system.two_eta.iter().map(|&v| Work::nearest(v)).collect(),
            cycles_each,
            space: PcgSpace::default(),
            friction_part: Vec::new(),
            cycles: 0,
        })
    }

    /// `p = -S^-1 r`; `r` is changed.
    pub(crate) fn apply_negative(&mut self, r: &mut [Work], p: &mut [Work]) {
        (self.poisson).apply(
            r,
            &mut self.friction_part,
            self.cycles_each,
            &mut self.space,
        );
        self.cycles += self.cycles_each;
        let (two_eta, friction_part) = (&self.two_eta, &self.friction_part);
        for_chunks(p, |start, part| {
            for (i, p) in part.iter_mut().enumerate() {
                *p = -(friction_part[start + i] + two_eta[start + i] * r[start + i]);
            }
        });
    }
}

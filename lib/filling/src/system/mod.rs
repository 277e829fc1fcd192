//! The unknowns and the coupled system of one step: viscosity, mass and wall friction A, fluxes G,
//! compressibility C, and the forces on bodies that follow from a solution.
//!
//! Per step the scheme minimises over the face velocities u, with pressures p as multipliers,
//!
//! E = sum_f rho V_f/(2 dt) (u - u*)^2 + sum_c eta phi_c o_c sum_d (D_d u_d)^2
//!   + 1/2 sum_e eta phi_e (shear of the edge)^2 + 1/2 sum_walls A_s beta (u_f - U_b)^2
//!   - sum_c phi_c p_c Phi_c - sum_c phi_c o_c (p_c^2/2 - p_c p*_c)/(K dt),
//!
//! which gives [A, -G^T; -G, -C] [u; p] = [b; -g]. Velocities are in m/s, lengths in cells h,
//! viscosities in units of a reference eta_0, pressures in units of eta_0/h, forces in units of
//! eta_0 h; in plane strain the depth is one cell.

mod couplings;
mod dofs;
mod fluxes;
mod operator;
mod terms;
mod viscosity;
mod walls;

use rayon::prelude::*;
use saddle_point::{Csr, Load, SaddleSystem};

use couplings::Couplings;

pub(crate) use dofs::{Dofs, NONE};
pub(crate) use operator::{Before, Operator};
pub(crate) use viscosity::{Sheared, varies};
pub(crate) use walls::WidthRule;

#[cfg(test)]
mod statics;

/// Unknowns per task and partial sum; part of the result of sums.
const CHUNK: usize = 1 << 12;

/// Numbers that scale the terms of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scales {
    /// Inertia, rho h^2/(eta_0 dt).
    pub(crate) inertia: f64,
    /// Compressibility, eta_0/(K dt).
    pub(crate) compressibility: f64,
    /// Body force per face volume, rho h^2 g/eta_0, m/s.
    pub(crate) gravity: [f64; 3],
    /// 1/(k h): influence length of the wall law, cells; infinite without friction.
    pub(crate) influence_length: f64,
    /// Which width of the lumen the wall law takes.
    pub(crate) width: WidthRule,
}

/// The assembled system of a step, for bodies at given speeds.
pub(crate) struct System {
    a: Csr<f64>,
    /// Liquid fluxes, cells x faces.
    pub(crate) g: Csr<f64>,
    c: Vec<f64>,
    friction: Vec<f64>,
    two_eta: Vec<f64>,
    mass: Vec<f64>,
    couplings: Couplings,
    /// Right-hand sides with all bodies at rest.
    resting: [Vec<f64>; 2],
    bodies: Vec<[f64; 3]>,
    b: Vec<f64>,
    source: Vec<f64>,
}

impl System {
    /// What the solver takes.
    pub(crate) fn saddle(&self) -> SaddleSystem<'_> {
        SaddleSystem {
            a: &self.a,
            g: &self.g,
            c: &self.c,
            friction: &self.friction,
            two_eta: &self.two_eta,
            b: &self.b,
            volume_source: &self.source,
        }
    }

    /// Sets the velocities of the bodies, m/s.
    pub(crate) fn steer(&mut self, bodies: &[[f64; 3]]) {
        self.bodies = bodies.to_vec();
        let couplings = &self.couplings;
        let [momentum, source] = &self.resting;
        self.b = (momentum.par_iter().enumerate())
            .map(|(face, b)| b + couplings.dragged(face, bodies))
            .collect();
        self.source = (source.par_iter().enumerate())
            .map(|(cell, g)| g + couplings.displaced(cell, bodies))
            .collect();
    }

    /// How the speed of body `clamped` against y enters the system, for a force of `force` on it
    /// along y (units of eta_0 h); to be solved with that body at rest.
    pub(crate) fn load(&self, clamped: usize, force: f64) -> Load {
        let mut unit = vec![[0.0; 3]; self.bodies.len()];
        unit[clamped][1] = -1.0;
        let mut resting = self.bodies.clone();
        resting[clamped] = [0.0; 3];
        let couplings = &self.couplings;
        let rigid = |bodies: &[[f64; 3]]| couplings.forces(bodies, &[], &[]).0[clamped][1];
        Load {
            momentum: (0..self.b.len())
                .into_par_iter()
                .map(|face| couplings.dragged(face, &unit))
                .collect(),
            source: (0..self.source.len())
                .into_par_iter()
                .map(|cell| couplings.displaced(cell, &unit))
                .collect(),
            resistance: rigid(&unit),
            force: force - rigid(&resting),
        }
    }

    /// Forces of the liquid on the bodies, in units of eta_0 h, and the power dissipated by
    /// viscosity and wall friction, in units of eta_0 h (m/s)^2.
    pub(crate) fn reactions(&self, u: &[f64], p: &[f64]) -> (Vec<[f64; 3]>, f64) {
        let (forces, of_bodies) = self.couplings.forces(&self.bodies, u, p);
        let mut product = vec![0.0; u.len()];
        self.a.multiply(u, &mut product);
        let of_liquid: f64 = (product.iter().zip(u).zip(&self.mass))
            .map(|((product, u), mass)| u * (product - mass * u))
            .sum();
        (forces, of_liquid + of_bodies)
    }
}

//! The unknowns and the coupled system of one step: viscosity, mass and wall friction A, fluxes G,
//! compressibility C, and the forces on bodies that follow from a solution.
//!
//! What a step minimises, and the system [A, -G^T; -G, -C] [u; p] = [b; -g] that follows, is in
//! docs/methods.md section 3.4. Velocities are in m/s, lengths in cells h,
//! viscosities in units of a reference eta_0, pressures in units of eta_0/h, forces in units of
//! eta_0 h; in plane strain the depth is one cell.

pub(crate) mod air;
mod assembly;
mod capillarity;
mod couplings;
mod dofs;
mod edge_rates;
mod edges;
mod fluxes;
mod lines;
mod menisci;
mod operator;
mod pins;
mod reactions;
mod response;
mod rolling;
mod sparse;
mod standing;
mod terms;
mod viscosity;
mod walls;

pub(crate) use assembly::{Before, System};
pub(crate) use capillarity::Pull;
pub(crate) use dofs::{Dofs, NONE};
pub(crate) use operator::Operator;
pub(crate) use reactions::Reactions;
pub(crate) use response::Found;
pub(crate) use viscosity::Sheared;
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
    /// Adhesion tension over eta_0, mean of advancing and receding, m/s.
    pub(crate) adhesion: f64,
    /// Half their difference.
    pub(crate) holding: f64,
    /// A cell in a step, h/dt, m/s.
    pub(crate) cell_per_step: f64,
    /// Slowest velocity that counts at the front, m/s.
    pub(crate) slow: f64,
    /// 1/(k h): influence length of the wall law, cells; infinite without friction.
    pub(crate) influence_length: f64,
    /// Which width of the lumen the wall law takes.
    pub(crate) width: WidthRule,
}

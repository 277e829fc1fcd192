//! Liquid in the halves of faces: the mass and the viscous stiffness of each face (docs/methods.md section 3.3).

use rayon::prelude::*;

use super::unknowns::FULL;
use super::viscosity::Viscosities;
use crate::geometry::{Face, Mesh};

/// Liquid fraction of the two halves of a face. A partly filled pore with a full one on one side only has all its liquid in
/// the half towards it: the pressure of the full pore drives the liquid up to the surface.
pub(crate) fn halves(mesh: &Mesh, fractions: &[f64], face: &Face) -> [f64; 2] {
    let full = |pore: usize| fractions[pore] >= FULL;
    let ends = face.pores();
    [0, 1].map(|half| {
        let (pore, other) = (ends[half], ends[1 - half]);
        let fraction = fractions[pore];
        if full(pore) || fraction == 0.0 {
            return fraction;
        }
        let mut opposite = mesh.faces_at(pore, usize::from(face.axis), half == 1);
        let behind = opposite.any(|face| full(mesh.faces[face].pores()[half]));
        match (full(other), behind) {
            (true, false) => 2.0 * fraction,
            (false, true) => 0.0,
            _ => fraction,
        }
    })
}

/// Liquid volume that moves with each face: its area share of the half pores on both sides.
pub(crate) fn masses(mesh: &Mesh, fractions: &[f64]) -> Vec<f64> {
    let mass = |(index, face): (usize, &Face)| {
        let parts = halves(mesh, fractions, face);
        if parts == [0.0; 2] {
            return 0.0;
        }
        let axis = usize::from(face.axis);
        let half = |((pore, up), part): ((usize, bool), f64)| {
            0.5 * part * mesh.volume(pore) * mesh.area_share(index, pore, axis, up)
        };
        (face.pores().into_iter().zip([true, false]))
            .zip(parts)
            .map(half)
            .sum::<f64>()
    };
    mesh.faces.par_iter().enumerate().map(mass).collect()
}

/// Sum over the halves of each face of liquid fraction times viscosity; without the viscosity where edges have their own.
pub(super) fn stiffnesses(mesh: &Mesh, fractions: &[f64], viscosities: &Viscosities) -> Vec<f64> {
    let own = viscosities.edges.is_empty();
    let viscosity = |pore: usize| if own { viscosities.pores[pore] } else { 1.0 };
    let of = |face: &Face| {
        let parts = halves(mesh, fractions, face);
        let [low, high] = face.pores().map(viscosity);
        parts[0] * low + parts[1] * high
    };
    mesh.faces.par_iter().map(of).collect()
}

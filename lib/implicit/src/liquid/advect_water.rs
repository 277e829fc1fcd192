//! Advection of the water that is dissolved in the liquid.

use super::transport::{MAX_SWEEPS, ROUNDING};
use crate::geometry::Mesh;

/// Advects the `water` by the liquid `flux` of each face; `volumes` are those before. The flux has the water fraction of the
/// donor before the step, or, if the donor passes on more than it held, the fraction mixed with its inflow.
pub(super) fn advect_water(mesh: &Mesh, volumes: &[f64], water: &mut [f64], flux: &[f64]) {
    let ends = |face: usize| {
        let f = mesh.faces[face];
        let [low, high] = f.pores();
        if flux[face] > 0.0 {
            (low, high)
        } else {
            (high, low)
        }
    };
    let moving: Vec<usize> = (0..flux.len()).filter(|&face| flux[face] != 0.0).collect();
    let mut parts: Vec<f64> = (volumes.iter().zip(&*water))
        .map(|(&volume, &water)| {
            let part = (water / volume).clamp(0.0, 1.0);
            if volume > 0.0 { part } else { 0.0 }
        })
        .collect();
    let mut out = vec![0.0; volumes.len()];
    for &face in &moving {
        out[ends(face).0] += flux[face].abs();
    }
    let flows_through = |pore: usize| out[pore] > volumes[pore];
    for _ in 0..MAX_SWEEPS {
        let mut sums: Vec<[f64; 2]> = (0..volumes.len())
            .map(|pore| [volumes[pore], water[pore]])
            .collect();
        for &face in &moving {
            let ((from, to), passed) = (ends(face), flux[face].abs());
            sums[to] = [sums[to][0] + passed, sums[to][1] + passed * parts[from]];
        }
        let mut change = 0.0_f64;
        for pore in (0..volumes.len()).filter(|&pore| flows_through(pore) && sums[pore][0] > 0.0) {
            let part = (sums[pore][1] / sums[pore][0]).clamp(0.0, 1.0);
            change = change.max((part - parts[pore]).abs());
            parts[pore] = part;
        }
        if change <= ROUNDING {
            break;
        }
    }
    for face in moving {
        let ((from, to), passed) = (ends(face), flux[face].abs() * parts[ends(face).0]);
        water[from] -= passed;
        water[to] += passed;
    }
}

//! Advection of the volume fractions by the face velocities: donor and acceptor (docs/methods.md section 3.9).

use rayon::prelude::*;

use super::advect_water::advect_water;
use super::overflow::overflow;
use crate::geometry::{Mesh, Neighbour};

/// Least ratio of the surface normal's component along the flow to that across it for which the flux takes the acceptor's
/// fraction. A smaller value would do so along surfaces parallel to the flow; a larger one smears fronts that are slightly
/// inclined.
const MIN_NORMAL: f64 = 0.7;
/// Courant number of a substep of the advection. A front keeps its shape to first order in it, and substeps cost next to
/// nothing compared with a solve.
const SUBSTEP_CFL: f64 = 0.25;

/// Volume, cells, that counts as none: the residue of rounding behind a front. A larger one would ignore liquid.
pub(crate) const TRACE: f64 = 1e-9;
/// Relative rounding error of volumes: 45 units in the last place. With less, the sweeps below never end; with a thousand times
/// as much, liquid is lost.
pub(super) const ROUNDING: f64 = 1e-14;
/// Bound on the sweeps that remove excess or negative volumes and that balance water; those that converge take fewer.
pub(super) const MAX_SWEEPS: usize = 100;

/// Liquid after an advection step.
pub(crate) struct Moved {
    /// Liquid volume of each pore at zero pressure, cells.
    pub(crate) volumes: Vec<f64>,
    /// Water volume of each pore; empty where water is not tracked.
    pub(crate) water: Vec<f64>,
    /// Liquid volume that left the domain, and the water in it.
    pub(crate) lost: [f64; 2],
}

/// Advects the liquid `volumes` (at zero pressure) and their `water` (may be empty) by the face velocities over `dt`, into
/// pores that can hold `capacities`. The flux out of a `full` pore is u a dt. Out of a partly filled one it has the fraction
/// of the donor, or, where the surface lies across the flow, that of the acceptor until the donor's air is used up (Hirt &
/// Nichols 1981, 10.1016/0021-9991(81)90145-5), and is never more than the donor holds.
pub(crate) fn transport(
    mesh: &Mesh,
    [volumes, water]: [&[f64]; 2],
    full: &[bool],
    capacities: &[f64],
    velocity: &[f64],
    dt: f64,
) -> Moved {
    let fastest = velocity.iter().fold(0.0_f64, |most, v| v.abs().max(most));
    // Rounding must not add a substep.
    let parts = (fastest * dt / SUBSTEP_CFL - 1e-9).ceil().max(1.0);
    let swept: Vec<f64> = (0..mesh.faces.len())
        .into_par_iter()
        .map(|face| velocity[face] * mesh.area(face) * dt / parts)
        .collect();
    let mut moved = Moved {
        volumes: volumes.to_vec(),
        water: water.to_vec(),
        lost: [0.0; 2],
    };
    for _ in 0..parts as usize {
        advect_substep(mesh, &mut moved, full, capacities, &swept);
    }
    moved
}

/// One substep: advects the liquid by the volumes `swept` by the faces.
fn advect_substep(
    mesh: &Mesh,
    moved: &mut Moved,
    full: &[bool],
    capacities: &[f64],
    swept: &[f64],
) {
    let (volumes, water) = (&mut moved.volumes, &mut moved.water);
    let volumes_before = volumes.clone();
    let pores = 0..mesh.pores.len();
    let fractions: Vec<f64> = (pores.clone().into_par_iter())
        .map(|pore| match full[pore] {
            true => 1.0,
            false => (volumes[pore] / mesh.volume(pore)).min(1.0),
        })
        .collect();
    let mut flux: Vec<f64> = (swept.par_iter().enumerate())
        .map(|(face, &swept)| swept.signum() * donor_acceptor(mesh, &fractions, face, swept))
        .collect();
    let shares: Vec<f64> = (pores.clone().into_par_iter())
        .map(|pore| match full[pore] {
            true => {
                share_beyond_the_front(mesh, full, &flux, pore, capacities[pore] - volumes[pore])
            }
            false if volumes[pore] == 0.0 => 1.0,
            false => (volumes[pore] / outflow(mesh, &flux, pore)).min(1.0),
        })
        .collect();
    flux.par_iter_mut().enumerate().for_each(|(face, flux)| {
        let f = mesh.faces[face];
        let ends = [f.low as usize, f.high as usize];
        let [donor, next] = if *flux > 0.0 {
            ends
        } else {
            [ends[1], ends[0]]
        };
        if !(full[donor] && full[next]) {
            *flux *= shares[donor];
        }
    });
    volumes
        .par_iter_mut()
        .enumerate()
        .for_each(|(pore, volume)| *volume -= mesh.net_outflow(pore, |face| flux[face]));
    return_overdraft(mesh, volumes, &mut flux);
    overflow(mesh, volumes, capacities, full, swept, &mut flux);
    if !water.is_empty() {
        advect_water(mesh, &volumes_before, water, &flux);
    }
    for (pore, volume) in volumes.iter_mut().enumerate() {
        if mesh.is_ghost(mesh.cell(pore)) {
            moved.lost[0] += std::mem::take(volume);
            moved.lost[1] += water.get_mut(pore).map_or(0.0, std::mem::take);
        }
    }
}

/// Share of its fluxes to pores that are not full which a full pore passes on: all that it has beyond what it `lacks` of its
/// capacity. A pore counts as full a little before it is.
fn share_beyond_the_front(
    mesh: &Mesh,
    full: &[bool],
    flux: &[f64],
    pore: usize,
    lacks: f64,
) -> f64 {
    let (mut inflow, mut beyond) = (0.0, 0.0);
    for neighbour in mesh.neighbours(pore) {
        let out = neighbour.sign() * flux[neighbour.face];
        match out > 0.0 && !full[neighbour.pore] {
            true => beyond += out,
            false => inflow -= out,
        }
    }
    match beyond > 0.0 {
        true => ((inflow - lacks) / beyond).clamp(0.0, 1.0),
        false => 1.0,
    }
}

/// Returns liquid to pores whose volume has become negative, which happens within the solver tolerance. It comes from the pores
/// that received theirs, in proportion; these may then be negative in the next sweep.
fn return_overdraft(mesh: &Mesh, volumes: &mut [f64], flux: &mut [f64]) {
    for _ in 0..MAX_SWEEPS {
        let mut returned: Vec<(usize, bool, f64)> = Vec::new();
        for pore in (0..volumes.len()).filter(|&pore| volumes[pore] < -ROUNDING) {
            let passed = |neighbour: &Neighbour| (neighbour.sign() * flux[neighbour.face]).max(0.0);
            let part = (-volumes[pore] / outflow(mesh, flux, pore)).min(1.0);
            let each = mesh.neighbours(pore);
            returned.extend(
                each.map(|neighbour| (neighbour.face, neighbour.up, part * passed(&neighbour))),
            );
        }
        if returned.is_empty() {
            break;
        }
        for (face, up, volume) in returned.into_iter().filter(|returned| returned.2 > 0.0) {
            move_through(mesh, volumes, flux, (face, up, -volume));
        }
    }
    for volume in volumes.iter_mut() {
        *volume = volume.max(0.0);
    }
}

/// Moves a volume through a face that is on the high (`up`) or low side of the donor; returns the acceptor.
pub(super) fn move_through(
    mesh: &Mesh,
    volumes: &mut [f64],
    flux: &mut [f64],
    (face, up, volume): (usize, bool, f64),
) -> usize {
    let [low, high] = mesh.faces[face].pores();
    let (from, to) = if up { (low, high) } else { (high, low) };
    volumes[from] -= volume;
    volumes[to] += volume;
    flux[face] += if up { volume } else { -volume };
    to
}

/// Difference of the volume fraction between the neighbours of a pore on both sides along each axis.
fn gradient(mesh: &Mesh, fractions: &[f64], pore: usize) -> [f64; 3] {
    std::array::from_fn(|axis| {
        let faces = [false, true].map(|up| mesh.faces_at(pore, axis, up));
        let change = |face: usize| {
            let [low, high] = mesh.faces[face].pores();
            fractions[high] - fractions[low]
        };
        faces.into_iter().flatten().map(change).sum()
    })
}

/// Liquid in the volume that a face sweeps out of its donor, by the donor's fraction or the acceptor's.
fn donor_acceptor(mesh: &Mesh, fractions: &[f64], face: usize, swept: f64) -> f64 {
    let axis = usize::from(mesh.faces[face].axis);
    let [low, high] = mesh.faces[face].pores();
    let (donor, next, sign) = match swept > 0.0 {
        true => (low, high, 1.0),
        false => (high, low, -1.0),
    };
    let (own, ahead, swept) = (fractions[donor], fractions[next], swept.abs());
    if own == 1.0 || own == 0.0 {
        return own * swept;
    }
    let gradient = gradient(mesh, fractions, donor);
    // Difference of the fraction along the flow, from the pore behind the donor to the acceptor.
    let change = sign * gradient[axis];
    let behind = ahead - change;
    let transverse = (0..3)
        .filter(|&a| a != axis)
        .map(|a| gradient[a] * gradient[a])
        .sum::<f64>()
        .sqrt();
    // Air with liquid on both sides is a bubble, not a surface, and is left behind.
    let hole = own <= ahead && own <= behind;
    if hole || change == 0.0 || change.abs() < MIN_NORMAL * transverse {
        return own * swept;
    }
    let volume = mesh.volume(donor);
    let air = (1.0 - own) * volume;
    (ahead * swept + ((1.0 - ahead) * swept - air).max(0.0)).min(own * volume)
}

/// Sum of the fluxes out of a pore.
fn outflow(mesh: &Mesh, flux: &[f64], pore: usize) -> f64 {
    let out = mesh
        .neighbours(pore)
        .map(|neighbour| (neighbour.sign() * flux[neighbour.face]).max(0.0));
    out.sum::<f64>().max(f64::MIN_POSITIVE)
}

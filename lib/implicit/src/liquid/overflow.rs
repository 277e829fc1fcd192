//! Overflow: liquid beyond the capacity of a pore goes on to its neighbours (docs/methods.md section 3.9).

use super::transport::{MAX_SWEEPS, ROUNDING, move_through};
use crate::geometry::{Mesh, Neighbour};

/// Excess, cells, that stays where it is: rounding of sums would pass less to and fro for ever.
const NEGLIGIBLE: f64 = 10.0 * ROUNDING;

/// A face through which excess may leave a pore.
#[derive(Clone, Copy)]
struct Outlet {
    neighbour: Neighbour,
    /// Volume that the face sweeps out of the pore in this substep.
    outflow: f64,
    /// Share of what came in on the opposite side, which would go straight on through this face.
    straight: f64,
    /// Volume that came in through this face.
    inflow: f64,
    area: f64,
    /// Volume that the neighbour can still take, and whether it is full.
    free: f64,
    full: bool,
}

/// Passes what pores hold above their `capacities` on to their neighbours. All pores do so at once, so their order does not
/// count. Pores that are `full` pass on nothing: their pressure does in the next step. `flux` is the volume through each face,
/// to which this adds; `swept` is what the face velocities sweep.
pub(super) fn overflow(
    mesh: &Mesh,
    volumes: &mut [f64],
    capacities: &[f64],
    full: &[bool],
    swept: &[f64],
    flux: &mut [f64],
) {
    let is_over =
        |volumes: &[f64], pore: usize| !full[pore] && volumes[pore] - capacities[pore] > NEGLIGIBLE;
    let mut over: Vec<usize> = (0..mesh.pores.len())
        .filter(|&pore| is_over(volumes, pore))
        .collect();
    for _ in 0..MAX_SWEEPS {
        let mut passed: Vec<(usize, bool, f64)> = Vec::new();
        for &pore in &over {
            let excess = volumes[pore] - capacities[pore];
            let free = |other: usize| match full[other] {
                true => 0.0,
                false => (capacities[other] - volumes[other]).max(0.0),
            };
            passed.extend(shares(
                &outlets(mesh, pore, free, full, swept, flux),
                excess,
            ));
        }
        if passed.is_empty() {
            return;
        }
        over.clear();
        over.extend((passed.into_iter()).map(|passed| move_through(mesh, volumes, flux, passed)));
        over.sort_unstable();
        over.dedup();
        over.retain(|&pore| is_over(volumes, pore));
    }
}

/// How much of an excess leaves through each outlet, as face, side and volume. It goes first where there is free volume,
/// along the flow and then anywhere; the rest goes to full pores along the flow, then back where it came from, then
/// anywhere. Passed on to other pores without free volume it would only come back. A neighbour never gets more than its free
/// volume, so one with next to none makes no difference.
fn shares(outlets: &[Outlet], excess: f64) -> Vec<(usize, bool, f64)> {
    type Weight = fn(&Outlet) -> f64;
    // Weight of an outlet, and whether free volume bounds its share.
    let stages: [(Weight, bool); 5] = [
        (|outlet| outlet.outflow + outlet.straight, true),
        (|outlet| outlet.area, true),
        (
            |outlet| if outlet.full { outlet.outflow } else { 0.0 },
            false,
        ),
        (|outlet| outlet.inflow, false),
        (|outlet| outlet.area, false),
    ];
    let mut given = vec![0.0; outlets.len()];
    let mut left = excess;
    for (weight, bounded) in stages {
        let takes = |&i: &usize| !bounded || outlets[i].free > given[i];
        let open: Vec<usize> = (0..outlets.len()).filter(takes).collect();
        let all: f64 = open.iter().map(|&i| weight(&outlets[i])).sum();
        if all <= NEGLIGIBLE {
            continue;
        }
        let mut passed = 0.0;
        for i in open {
            let share = left * weight(&outlets[i]) / all;
            let share = if bounded {
                share.min(outlets[i].free - given[i])
            } else {
                share
            };
            given[i] += share;
            passed += share;
        }
        left -= passed;
        if left <= NEGLIGIBLE {
            break;
        }
    }
    (outlets.iter().zip(given))
        .filter(|(_, given)| *given > 0.0)
        .map(|(Outlet { neighbour, .. }, given)| (neighbour.face, neighbour.up, given))
        .collect()
}

/// The faces of a pore as outlets.
fn outlets(
    mesh: &Mesh,
    pore: usize,
    free: impl Fn(usize) -> f64,
    full: &[bool],
    swept: &[f64],
    flux: &[f64],
) -> Vec<Outlet> {
    let outlet = |neighbour: Neighbour| {
        let (sign, area) = (neighbour.sign(), mesh.area(neighbour.face));
        let straight: f64 = (mesh.faces_at(pore, neighbour.axis, !neighbour.up))
            .map(|face| (sign * flux[face]).max(0.0))
            .sum();
        Outlet {
            neighbour,
            outflow: (sign * swept[neighbour.face]).max(0.0),
            straight: straight
                * mesh.area_share(neighbour.face, pore, neighbour.axis, neighbour.up),
            inflow: (-sign * flux[neighbour.face]).max(0.0),
            area,
            free: free(neighbour.pore),
            full: full[neighbour.pore],
        }
    };
    mesh.neighbours(pore).map(outlet).collect()
}

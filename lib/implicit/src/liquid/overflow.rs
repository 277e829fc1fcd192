//! Liquid beyond what a pore can hold goes on to pores beside it.

use super::transport::{PASSES, ROUNDING, pass};
use crate::geometry::{Mesh, Way};

/// Excess, cells, that stays where it is: less would be passed to and fro by the rounding of sums.
const NOTHING: f64 = 10.0 * ROUNDING;

/// A face by which excess may leave a pore.
#[derive(Clone, Copy)]
struct Outlet {
    way: Way,
    /// What flows there.
    flow: f64,
    /// What came in on the opposite side and would go straight on.
    straight: f64,
    /// What came in there.
    came: f64,
    area: f64,
    /// Room in the pore behind it, and whether that is full.
    room: f64,
    full: bool,
}

/// Passes what pores hold above their `capacities` on to their neighbours, all pores at once, so that their order does not
/// count: in proportion to what flows there, to those with room before others, which pass it on. What finds no room where
/// it flows goes back to where it came from. Pores that are `full` pass on nothing: their pressure does in the next step.
/// `flux` takes what crosses each face.
pub(super) fn overflow(
    mesh: &Mesh,
    volumes: &mut [f64],
    capacities: &[f64],
    full: &[bool],
    swept: &[f64],
    flux: &mut [f64],
) {
    let is_over =
        |volumes: &[f64], pore: usize| !full[pore] && volumes[pore] - capacities[pore] > NOTHING;
    let mut over: Vec<usize> = (0..mesh.pores.len())
        .filter(|&pore| is_over(volumes, pore))
        .collect();
    for _ in 0..PASSES {
        let mut passed: Vec<(usize, bool, f64)> = Vec::new();
        for &pore in &over {
            let excess = volumes[pore] - capacities[pore];
            let room = |other: usize| match full[other] {
                true => 0.0,
                false => (capacities[other] - volumes[other]).max(0.0),
            };
            passed.extend(shares(&ways(mesh, pore, room, full, swept, flux), excess));
        }
        if passed.is_empty() {
            return;
        }
        over.clear();
        over.extend((passed.into_iter()).map(|passed| pass(mesh, volumes, flux, passed)));
        over.sort_unstable();
        over.dedup();
        over.retain(|&pore| is_over(volumes, pore));
    }
}

/// How much of an excess goes by each of the ways: as much as there is room for where it flows, then anywhere, and the rest
/// to full pores where it flows, or back. What is sent on to others without room would only come to and fro. Little room takes little, so that room next to nothing does what none does.
fn shares(ways: &[Outlet], excess: f64) -> Vec<(usize, bool, f64)> {
    type Weight = fn(&Outlet) -> f64;
    let kinds: [(Weight, bool); 5] = [
        (|way| way.flow + way.straight, true),
        (|way| way.area, true),
        (|way| if way.full { way.flow } else { 0.0 }, false),
        (|way| way.came, false),
        (|way| way.area, false),
    ];
    let mut given = vec![0.0; ways.len()];
    let mut left = excess;
    for (weight, to_room) in kinds {
        let roomy = |&i: &usize| !to_room || ways[i].room > given[i];
        let open: Vec<usize> = (0..ways.len()).filter(roomy).collect();
        let all: f64 = open.iter().map(|&i| weight(&ways[i])).sum();
        if all <= NOTHING {
            continue;
        }
        let mut passed = 0.0;
        for i in open {
            let share = left * weight(&ways[i]) / all;
            let share = if to_room {
                share.min(ways[i].room - given[i])
            } else {
                share
            };
            given[i] += share;
            passed += share;
        }
        left -= passed;
        if left <= NOTHING {
            break;
        }
    }
    (ways.iter().zip(given))
        .filter(|(_, given)| *given > 0.0)
        .map(|(Outlet { way, .. }, given)| (way.face, way.up, given))
        .collect()
}

/// The faces of a pore.
fn ways(
    mesh: &Mesh,
    pore: usize,
    room: impl Fn(usize) -> f64,
    full: &[bool],
    swept: &[f64],
    flux: &[f64],
) -> Vec<Outlet> {
    let outlet = |way: Way| {
        let (sign, area) = (way.sign(), mesh.area(way.face));
        let straight: f64 = (mesh.faces_at(pore, way.axis, !way.up))
            .map(|face| (sign * flux[face]).max(0.0))
            .sum();
        let side = mesh.faces_at(pore, way.axis, way.up);
        let side = side.map(|face| mesh.area(face));
        Outlet {
            way,
            flow: (sign * swept[way.face]).max(0.0),
            straight: straight * area / side.sum::<f64>(),
            came: (-sign * flux[way.face]).max(0.0),
            area,
            room: room(way.beside),
            full: full[way.beside],
        }
    };
    mesh.ways(pore).map(outlet).collect()
}

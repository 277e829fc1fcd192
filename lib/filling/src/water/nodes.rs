//! The cells between which water moves.

use super::Medium;
use crate::geometry::{Lattice, OPEN};
use crate::liquid::{Bins, Particles, sub_cells};

/// No cell.
const NONE: u32 = u32::MAX;

/// A cell that holds liquid.
pub(super) struct Node {
    pub(super) cell: u32,
    /// Volume of the solids, cells.
    pub(super) solids: f64,
    /// Water over solids; that of the start without points.
    pub(super) ratio: f64,
    /// What its walls ask for, cells.
    pub(super) asked: f64,
    /// K to the neighbours below and above along each axis.
    conductance: [f64; 6],
    neighbour: [u32; 6],
}

impl Node {
    /// Water that comes from the neighbours of node `own`.
    pub(super) fn inflow(&self, ratio: &[f64], own: usize) -> f64 {
        let each = self.neighbour.iter().zip(self.conductance);
        let each = each.filter(|(n, _)| **n != NONE);
        each.map(|(&n, k)| k * (ratio[n as usize] - ratio[own]))
            .sum()
    }

    /// What a change of its X by one takes of water, with its neighbours' as they are.
    pub(super) fn diagonal(&self) -> f64 {
        self.solids + self.conductance.iter().sum::<f64>()
    }
}

/// The cells with liquid or points.
pub(super) fn nodes(
    medium: &Medium,
    lattice: &Lattice,
    phi: &[f32],
    particles: &Particles,
    bins: &Bins,
    asked: &[f64],
) -> Vec<Node> {
    let window = &lattice.window;
    let mut number = vec![NONE; window.len()];
    let mut nodes = Vec::new();
    let start = medium.water.start();
    for cell in 0..window.len() {
        let at = window.coordinates(cell);
        if !window.inner(at) || window.home(at) != at {
            continue;
        }
        let parts = &particles.parts[bins.of(cell)];
        let sum = |which: usize| parts.iter().map(|part| part[which]).sum::<f64>();
        let wet = || sub_cells(window, cell).any(|s| phi[s] * lattice.open[s] > 0.0);
        if parts.is_empty() && !wet() {
            continue;
        }
        let (solids, held) = (sum(0), sum(1));
        number[cell] = nodes.len() as u32;
        nodes.push(Node {
            cell: cell as u32,
            solids,
            ratio: if solids > 0.0 { held / solids } else { start },
            asked: asked[cell],
            conductance: [0.0; 6],
            neighbour: [NONE; 6],
        });
    }
    for n in 0..nodes.len() {
        let cell = nodes[n].cell as usize;
        for axis in 0..window.domain.axes {
            let high = cell + window.stride(axis);
            let home = window.index(window.home(window.coordinates(high)));
            let other = number[home];
            if other == NONE || lattice.face(axis, high) != OPEN {
                continue;
            }
            let area = passage(lattice, phi, axis, high);
            let dry = |n: usize| 1.0 / (1.0 + nodes[n].ratio);
            let k = medium.diffusion * area * 0.5 * (dry(n) + dry(other as usize));
            let far = other as usize;
            (
                nodes[n].conductance[2 * axis + 1],
                nodes[n].neighbour[2 * axis + 1],
            ) = (k, other);
            (
                nodes[far].conductance[2 * axis],
                nodes[far].neighbour[2 * axis],
            ) = (k, n as u32);
        }
    }
    leave_out_the_empty(&mut nodes);
    nodes
}

/// Takes neighbours and walls from cells that no point can feed: the liquid there is the fringe of another
/// cell's, and a balance without solids has no solution.
fn leave_out_the_empty(nodes: &mut [Node]) {
    let mut fed: Vec<bool> = nodes.iter().map(|node| node.solids > 0.0).collect();
    let mut front: Vec<usize> = (0..nodes.len()).filter(|&n| fed[n]).collect();
    while let Some(n) = front.pop() {
        let next = nodes[n].neighbour.iter().zip(nodes[n].conductance);
        for (&other, _) in next.filter(|(other, k)| **other != NONE && *k > 0.0) {
            if !std::mem::replace(&mut fed[other as usize], true) {
                front.push(other as usize);
            }
        }
    }
    for (node, _) in nodes.iter_mut().zip(fed).filter(|(_, fed)| !fed) {
        node.asked = 0.0;
        node.conductance = [0.0; 6];
    }
}

/// Liquid area of the low face along `axis` of a cell: of each pair of sub-cells at it the lesser.
fn passage(lattice: &Lattice, phi: &[f32], axis: usize, cell: usize) -> f64 {
    let window = &lattice.window;
    let step = window.sub_stride(axis);
    let first = window.first_sub(window.coordinates(cell));
    let low = first / step % window.sub_cells()[axis];
    let wet = |s: usize| f64::from(phi[s] * lattice.open[s]);
    let at_face = |s: &usize| s / step % window.sub_cells()[axis] == low;
    let (sum, count) = (sub_cells(window, cell).filter(at_face)).fold((0.0, 0), |(sum, n), s| {
        (sum + wet(s).min(wet(s - step)), n + 1)
    });
    sum / f64::from(count)
}

//! The balance of water in all pores: X of each, not below what walls leave.

use crate::system::PASSES;

/// Relative residual of the solution, so far below what a step moves that a run loses no water by it; a smaller one is rounding.
const TOLERANCE: f64 = 1e-10;
/// Part of the limit by which X may fall short of it: above what the solution is off by.
const HAIR: f64 = 10.0 * TOLERANCE;

/// A pore with liquid.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Node {
    pub(crate) pore: u32,
    /// Volume of the solids, cells.
    pub(crate) solids: f64,
    /// Water over solids.
    pub(crate) ratio: f64,
    /// What its walls ask for, cells.
    pub(crate) asked: f64,
    /// Nodes beside it, with what a difference of X passes on.
    pub(crate) beside: Vec<(u32, f64)>,
}

impl Node {
    /// Water that comes from the nodes beside node `own`.
    pub(crate) fn inflow(&self, ratio: &[f64], own: usize) -> f64 {
        let each = self.beside.iter();
        each.map(|&(n, k)| k * (ratio[n as usize] - ratio[own]))
            .sum()
    }

    /// What a change of its X by one takes of water, with its neighbours' as they are.
    fn diagonal(&self) -> f64 {
        self.solids + self.beside.iter().map(|(_, k)| k).sum::<f64>()
    }
}

/// X of each node, and whether it is held at the least that walls leave; `None` where no balance was found.
pub(crate) fn solve(nodes: &[Node], least: f64) -> Option<(Vec<f64>, Vec<bool>)> {
    let mut ratio: Vec<f64> = nodes.iter().map(|node| node.ratio).collect();
    let mut held: Vec<bool> = (nodes.iter())
        .map(|node| node.asked > 0.0 && node.ratio <= least * (1.0 + HAIR))
        .collect();
    // Pores change sides between those that still give all that is asked for and those at the limit.
    for _ in 0..PASSES {
        for (x, held) in ratio.iter_mut().zip(&held) {
            *x = if *held { least } else { *x };
        }
        if !gradients(nodes, &held, &mut ratio) {
            return None;
        }
        let mut turned = false;
        for (n, node) in nodes.iter().enumerate() {
            if node.asked == 0.0 {
                continue;
            }
            let supply = node.solids * (node.ratio - ratio[n]) + node.inflow(&ratio, n);
            let turn = match held[n] {
                true => supply > node.asked * (1.0 + HAIR),
                false => ratio[n] < least * (1.0 - HAIR),
            };
            held[n] ^= turn;
            turned |= turn;
        }
        if !turned {
            return Some((ratio, held));
        }
    }
    None
}

/// Solves V_s (X - X_0) = sum K (X_n - X) - q for the nodes that are not held by conjugate gradients with the diagonal;
/// whether that came to its tolerance.
fn gradients(nodes: &[Node], held: &[bool], ratio: &mut [f64]) -> bool {
    let defect = |ratio: &[f64], n: usize| {
        let node = &nodes[n];
        match held[n] {
            true => 0.0,
            false => node.inflow(ratio, n) - node.asked - node.solids * (ratio[n] - node.ratio),
        }
    };
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let count = nodes.len();
    let mut rest: Vec<f64> = (0..count).map(|n| defect(ratio, n)).collect();
    let scale: f64 = (nodes.iter().zip(held).filter(|(_, held)| !**held))
        .map(|(node, _)| (node.diagonal() * node.ratio).powi(2))
        .sum();
    let scaled = |rest: &[f64]| -> Vec<f64> {
        let each = rest.iter().zip(nodes);
        each.map(|(r, node)| r / node.diagonal()).collect()
    };
    let mut correction = scaled(&rest);
    let mut way = correction.clone();
    let mut size = dot(&rest, &correction);
    // But for rounding, as many steps as there are unknowns are enough.
    for _ in 0..=count {
        if dot(&rest, &rest) <= TOLERANCE * TOLERANCE * scale || size <= 0.0 {
            return true;
        }
        let image: Vec<f64> = (0..count)
            .map(|n| match held[n] {
                true => 0.0,
                false => nodes[n].solids * way[n] - nodes[n].inflow(&way, n),
            })
            .collect();
        let step = size / dot(&way, &image);
        for n in 0..count {
            ratio[n] += step * way[n];
            rest[n] -= step * image[n];
        }
        correction = scaled(&rest);
        let last = std::mem::replace(&mut size, dot(&rest, &correction));
        for (w, c) in way.iter_mut().zip(&correction) {
            *w = c + size / last * *w;
        }
    }
    false
}

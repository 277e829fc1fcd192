//! The balance of water in all cells: X of each, not below what walls leave.

use super::nodes::Node;

/// Relative residual of the solution, and iterations to reach it.
const TOLERANCE: f64 = 1e-10;
const MAX_ITERATIONS: usize = 2000;
/// Times that cells change sides between those that still give all that is asked for and those at the
/// limit, at most.
const MAX_TURNS: usize = 30;
/// Part of the limit by which X may fall short of it.
const HAIR: f64 = 1e-9;

/// X of each node, and whether it is held at the least that walls leave; `None` where no balance was found.
pub(super) fn solve(nodes: &[Node], least: f64) -> Option<(Vec<f64>, Vec<bool>)> {
    let mut ratio: Vec<f64> = nodes.iter().map(|node| node.ratio).collect();
    // Nothing to hold or to pass on: nothing changes.
    let idle = |node: &Node| node.diagonal() <= 0.0;
    let mut held: Vec<bool> = (nodes.iter())
        .map(|node| node.asked > 0.0 && node.ratio <= least * (1.0 + HAIR))
        .collect();
    for _ in 0..MAX_TURNS {
        for (x, held) in ratio.iter_mut().zip(&held) {
            *x = if *held { least } else { *x };
        }
        let free: Vec<bool> = (nodes.iter().zip(&held))
            .map(|(node, held)| !held && !idle(node))
            .collect();
        if !gradients(nodes, &free, &mut ratio) {
            return None;
        }
        let mut turned = false;
        for (n, node) in nodes
            .iter()
            .enumerate()
            .filter(|(_, node)| node.asked > 0.0)
        {
            let short = ratio[n] < least * (1.0 - HAIR);
            let supply = node.solids * (node.ratio - ratio[n]) + node.inflow(&ratio, n);
            let turn = match held[n] {
                true => supply > node.asked * (1.0 + HAIR),
                false => short && !idle(node),
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

/// Solves V_s (X - X_0) = sum K (X_n - X) - q for the free nodes by conjugate gradients with the diagonal;
/// whether that came to its tolerance.
fn gradients(nodes: &[Node], free: &[bool], ratio: &mut [f64]) -> bool {
    let defect = |ratio: &[f64], n: usize| {
        let node = &nodes[n];
        match free[n] {
            true => node.inflow(ratio, n) - node.asked - node.solids * (ratio[n] - node.ratio),
            false => 0.0,
        }
    };
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let count = nodes.len();
    let mut rest: Vec<f64> = (0..count).map(|n| defect(ratio, n)).collect();
    let scale: f64 = (nodes.iter().zip(free).filter(|(_, free)| **free))
        .map(|(node, _)| (node.diagonal() * node.ratio).powi(2))
        .sum();
    let scaled = |rest: &[f64]| -> Vec<f64> {
        let each = rest.iter().zip(nodes).zip(free);
        each.map(|((r, node), free)| if *free { r / node.diagonal() } else { 0.0 })
            .collect()
    };
    let mut correction = scaled(&rest);
    let mut way = correction.clone();
    let mut size = dot(&rest, &correction);
    for _ in 0..MAX_ITERATIONS {
        if dot(&rest, &rest) <= TOLERANCE * TOLERANCE * scale || size <= 0.0 {
            return true;
        }
        let image: Vec<f64> = (0..count)
            .map(|n| match free[n] {
                true => nodes[n].solids * way[n] - nodes[n].inflow(&way, n),
                false => 0.0,
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

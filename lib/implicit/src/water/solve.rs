//! Water balance of all pores: solves for the water ratio X of each, bounded from below by the limit of the walls' uptake.

use crate::settings::LINEAR_ITERATIONS;
use crate::system::MAX_PASSES;

/// Relative residual of the solution, small enough that a run conserves water; a smaller one is below rounding.
const TOLERANCE: f64 = 1e-10;
/// Relative tolerance on the lower limit of X, above the error of the solution.
const LIMIT_TOLERANCE: f64 = 10.0 * TOLERANCE;

/// A pore with liquid, as a node of the water balance.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Node {
    pub(crate) pore: u32,
    /// Volume of the solids, cells.
    pub(crate) solids: f64,
    /// X_0, water over solids by volume at the start of the step.
    pub(crate) ratio: f64,
    /// Water that its walls take if X stays above the limit, q, cells.
    pub(crate) demand: f64,
    /// Neighbouring nodes and the diffusive conductance K to each.
    pub(crate) neighbours: Vec<(u32, f64)>,
}

impl Node {
    /// Diffusive inflow into this node, number `own`.
    pub(crate) fn inflow(&self, ratio: &[f64], own: usize) -> f64 {
        let each = self.neighbours.iter();
        each.map(|&(n, k)| k * (ratio[n as usize] - ratio[own]))
            .sum()
    }

    /// Diagonal of the matrix.
    fn diagonal(&self) -> f64 {
        self.solids + self.neighbours.iter().map(|(_, k)| k).sum::<f64>()
    }
}

/// X of each node, at least `min_ratio`, and whether it is at that limit; `None` where the active set did not settle.
pub(crate) fn solve(nodes: &[Node], min_ratio: f64) -> Option<(Vec<f64>, Vec<bool>)> {
    let mut ratio: Vec<f64> = nodes.iter().map(|node| node.ratio).collect();
    let mut at_limit: Vec<bool> = (nodes.iter())
        .map(|node| node.demand > 0.0 && node.ratio <= min_ratio * (1.0 + LIMIT_TOLERANCE))
        .collect();
    // Active set: nodes switch between meeting the whole demand and resting at the limit.
    for _ in 0..MAX_PASSES {
        for (x, at_limit) in ratio.iter_mut().zip(&at_limit) {
            *x = if *at_limit { min_ratio } else { *x };
        }
        if !conjugate_gradients(nodes, &at_limit, &mut ratio) {
            return None;
        }
        let mut changed = false;
        for (n, node) in nodes.iter().enumerate() {
            if node.demand == 0.0 {
                continue;
            }
            let supply = node.solids * (node.ratio - ratio[n]) + node.inflow(&ratio, n);
            let switch = match at_limit[n] {
                true => supply > node.demand * (1.0 + LIMIT_TOLERANCE),
                false => ratio[n] < min_ratio * (1.0 - LIMIT_TOLERANCE),
            };
            at_limit[n] ^= switch;
            changed |= switch;
        }
        if !changed {
            return Some((ratio, at_limit));
        }
    }
    None
}

/// Solves V_s (X - X_0) = sum K (X_n - X) - q for the nodes that are not at the limit, by conjugate gradients with a diagonal
/// preconditioner. Returns whether it converged.
fn conjugate_gradients(nodes: &[Node], at_limit: &[bool], ratio: &mut [f64]) -> bool {
    let defect = |ratio: &[f64], n: usize| {
        let node = &nodes[n];
        match at_limit[n] {
            true => 0.0,
            false => node.inflow(ratio, n) - node.demand - node.solids * (ratio[n] - node.ratio),
        }
    };
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let count = nodes.len();
    let mut residual: Vec<f64> = (0..count).map(|n| defect(ratio, n)).collect();
    let free = nodes.iter().zip(at_limit).filter(|of| !*of.1);
    let scale: f64 = free
        .map(|(node, _)| (node.diagonal() * node.ratio).powi(2))
        .sum();
    let scaled = |residual: &[f64]| -> Vec<f64> {
        let each = residual.iter().zip(nodes);
        each.map(|(r, node)| r / node.diagonal()).collect()
    };
    let mut correction = scaled(&residual);
    let mut direction = correction.clone();
    let mut size = dot(&residual, &correction);
    for _ in 0..LINEAR_ITERATIONS {
        if dot(&residual, &residual) <= TOLERANCE * TOLERANCE * scale || size <= 0.0 {
            return true;
        }
        let image: Vec<f64> = (0..count)
            .map(|n| match at_limit[n] {
                true => 0.0,
                false => nodes[n].solids * direction[n] - nodes[n].inflow(&direction, n),
            })
            .collect();
        let step = size / dot(&direction, &image);
        for n in 0..count {
            ratio[n] += step * direction[n];
            residual[n] -= step * image[n];
        }
        correction = scaled(&residual);
        let previous = std::mem::replace(&mut size, dot(&residual, &correction));
        for (w, c) in direction.iter_mut().zip(&correction) {
            *w = c + size / previous * *w;
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pores that hold little water and exchange it fast: rounding makes three of them need five iterations.
    #[test]
    fn a_fast_exchange_between_few_pores_is_balanced() {
        let node = |pore: u32, ratio, neighbours: &[u32]| Node {
            pore,
            solids: 1e-6,
            ratio,
            demand: 0.0,
            neighbours: neighbours.iter().map(|&n| (n, 10.0)).collect(),
        };
        let nodes = [
            node(0, 1.0, &[1]),
            node(1, 2.0, &[0, 2]),
            node(2, 5.0, &[1]),
        ];
        let (ratio, _) = solve(&nodes, 0.1).unwrap();
        for x in ratio {
            assert!((x / (8.0 / 3.0) - 1.0).abs() < 1e-4, "{x}");
        }
    }
}

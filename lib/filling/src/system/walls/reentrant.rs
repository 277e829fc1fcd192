//! What flow along a re-entrant edge of voxels adds to friction and exchange beside it.
//!
//! Along such an edge flow is u ~ r^(2/3) sin(2 theta/3), which differences over a cell take for
//! linear. What they are off by is seen from afar as u + c r^(-2/3) sin(2 theta/3), and changes the
//! flux by pi c K^2, K the strength of the edge. One number for each place of an edge in the lattice makes
//! c zero: all friction and exchange within a cell of the edge times 1 + (g - 1) (1 - r), r the distance from
//! it. That g is found by solving the scheme around one edge with c r^(-2/3) fitted from 6 to 12 cells off;
//! between the places where columns of a face begin or cease to meet a wall, ln g is linear in both
//! directions to 0.03.
//!
//! Steps of less than a cell hinder one another: their g counts by the power of their length. Beside steps of one
//! or two cells the profile across the lumen is not that of a slit or a duct: neither the defect of the
//! differences over it nor the width along the wall counts there. How far that reaches is what tubes of voxels
//! say, no theory.

use crate::geometry::{Column, LONG, Reentrant};

/// Distance within which an edge multiplies, cells.
pub(in crate::system) const REACH: f64 = 1.0;
/// Distance within which it changes the profile at a wall, cells.
pub(super) const PROFILE: f64 = 1.5;
/// A wall this close beyond a quarter of a cell is on it.
const TOUCH: f64 = 1e-4;
/// ln g at the ends of the quarters of a cell, of an edge whose solid is below it, between which it is linear; symmetric.
const LN_G: [[f64; 8]; 8] = [
    [0.37, 0.61, -0.06, 0.20, -0.11, 0.31, 0.06, 0.37],
    [0.61, 0.89, 0.08, 0.39, 0.17, 0.58, 0.25, 0.61],
    [-0.06, 0.08, -0.34, -0.17, -0.36, -0.11, -0.26, -0.06],
    [0.20, 0.39, -0.17, 0.08, -0.14, 0.16, -0.06, 0.20],
    [-0.11, 0.17, -0.36, -0.14, -1.50, -0.70, -0.46, -0.11],
    [0.31, 0.58, -0.11, 0.16, -0.70, 0.10, -0.11, 0.30],
    [0.06, 0.25, -0.26, -0.06, -0.46, -0.11, -0.19, 0.05],
    [0.37, 0.61, -0.06, 0.20, -0.11, 0.30, 0.05, 0.37],
];

/// What edges do at a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::system) struct Beside {
    /// Factor of friction or exchange there.
    pub(in crate::system) factor: f64,
    /// How little the flow is that between plane walls: 1 within a cell of an edge, 0 from [`PROFILE`] on.
    pub(super) near: f64,
}

impl Beside {
    /// No edge is near.
    pub(in crate::system) const NONE: Self = Self {
        factor: 1.0,
        near: 0.0,
    };

    /// At a place in the plane across `edges`.
    pub(in crate::system) fn new(edges: &[Reentrant], place: [f64; 2]) -> Self {
        let mut beside = Self::NONE;
        for edge in edges {
            let way = [0, 1].map(|n| place[n] - edge.at[n]);
            let r = (way[0] * way[0] + way[1] * way[1]).sqrt();
            let part = 1.0 - r / REACH;
            if part > 1e-6 {
                beside.factor *= 1.0 + (g(edge) - 1.0) * part;
            }
            let near = (2.0 * (PROFILE - r)).clamp(0.0, 1.0);
            let steps = edge.straight.min(LONG - edge.straight).min(1.0);
            beside.near = beside.near.max(steps * near);
        }
        beside
    }
}

/// Edges around a face's centre, in the halves of its control volume below and above it.
pub(super) struct Edges {
    pub(super) centre: [f64; 2],
    pub(super) halves: [Vec<Reentrant>; 2],
}

impl Edges {
    /// What they do where a column along the tangential direction `t`, `off` cells beside the face,
    /// meets its wall at `side`.
    pub(super) fn beside(
        &self,
        t: usize,
        index: usize,
        off: f64,
        column: &Column,
        side: usize,
    ) -> Beside {
        let edges = &self.halves[index & 1];
        if edges.is_empty() {
            return Beside::NONE;
        }
        let mut place = self.centre;
        place[t] += [-1.0, 1.0][side] * column.distance[side];
        place[1 - t] += off + if index & 2 == 2 { 0.25 } else { -0.25 };
        Beside::new(edges, place)
    }
}

/// Factor at an edge.
fn g(edge: &Reentrant) -> f64 {
    let [[a, x], [b, y]] = [0, 1].map(|n| quarter(edge.at[n], edge.above[n]));
    let (a, b) = (a as usize, b as usize);
    let row = |i: usize| (1.0 - y) * LN_G[i][b] + y * LN_G[i][b + 1];
    (edge.straight.min(1.0) * ((1.0 - x) * row(a) + x * row(a + 1))).exp()
}

/// Row of the table and place within the quarter, from 0 to 1.
fn quarter(at: f64, above: bool) -> [f64; 2] {
    let at = if above { -at } else { at };
    let mut at = at - at.floor();
    if at > 1.0 - TOUCH {
        at = 0.0;
    }
    // The columns of a face meet no wall exactly on a quarter.
    let n = match at {
        a if a <= 0.25 + TOUCH => 0.0,
        a if a <= 0.5 + TOUCH => 1.0,
        a if a < 0.75 - TOUCH => 2.0,
        _ => 3.0,
    };
    [2.0 * n, (4.0 * at - n).clamp(0.0, 1.0)]
}

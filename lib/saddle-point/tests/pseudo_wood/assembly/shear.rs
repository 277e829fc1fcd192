//! Shear stresses of the edges between cells.

use super::{Cell, NONE, Point, Stokes, shift};
use saddle_point::RowEntries;

/// One edge between two tangential velocity components.
struct Edge {
    /// Faces: lower and upper of the first axis, lower and upper of the second.
    faces: [u32; 4],
    /// Velocities of the faces that are closed.
    fixed: [f64; 4],
    /// Weights of the shear stress common to both axes and of the rest of the first axis.
    weights: [f64; 2],
}

const SIGNS: [f64; 4] = [-1.0, 1.0, -1.0, 1.0];

impl Stokes {
    /// Shear stress of one edge in the row of one of its faces.
    pub(super) fn shear(
        &self,
        row: usize,
        axis: usize,
        tangent: usize,
        at: Point,
        entries: &mut RowEntries,
    ) -> f64 {
        let Some(edge) = self.edge(axis, tangent, at) else {
            return 0.0;
        };
        let mine = usize::from(edge.faces[1] as usize == row);
        let mut rhs = 0.0;
        for (weight, members) in edge.weights.iter().zip([0..4, 0..2]) {
            for other in members {
                let value = weight * SIGNS[mine] * SIGNS[other];
                match edge.faces[other] {
                    NONE => rhs -= value * edge.fixed[other],
                    id => entries.add(id as usize, value),
                }
            }
        }
        rhs
    }

    /// The edge at the lower corner of cell `at` in the plane of two axes.
    fn edge(&self, axis: usize, tangent: usize, at: Point) -> Option<Edge> {
        let low_axis = shift(at, axis, -1);
        let low_tangent = shift(at, tangent, -1);
        let corners = [at, low_axis, low_tangent, shift(low_axis, tangent, -1)];
        let kinds = corners.map(|corner| self.wood.at(corner));
        if kinds.contains(&Cell::Outside) {
            return None;
        }
        let (mut liquid, mut open, mut stiffness) = (0.0, 0.0, 0.0);
        for (kind, corner) in kinds.into_iter().zip(corners) {
            if kind.is_open() {
                open += 1.0;
            }
            if kind == Cell::Liquid {
                liquid += 1.0;
                stiffness += self.viscosity(corner) * self.open(corner);
            }
        }
        if liquid == 0.0 {
            return None;
        }
        stiffness *= 1.0 / open;
        let positions = [
            (axis, low_tangent),
            (axis, at),
            (tangent, low_axis),
            (tangent, at),
        ];
        let faces = positions.map(|(along, position)| self.face(along, position));
        let [here, left, below, corner] = kinds.map(Cell::is_open);
        // Two parallel faces see each other through each half of the edge that has no wall.
        let both = |a: bool, b: bool| if a && b { 0.5 } else { 0.0 };
        let mut first = both(corner, left) + both(below, here);
        let mut second = both(corner, below) + both(left, here);
        let closed = [
            !(corner && below),
            !(left && here),
            !(corner && left),
            !(below && here),
        ];
        let lost = |f: usize| faces[f] == NONE && !closed[f];
        if lost(0) || lost(1) {
            first = 0.0;
        }
        if lost(2) || lost(3) {
            second = 0.0;
        }
        let common = f64::min(first, second);
        Some(Edge {
            faces,
            fixed: positions.map(|(along, position)| self.closed_velocity(along, position)),
            weights: [common, first - common].map(|w| w * stiffness),
        })
    }
}

//! The walls a face velocity sees along a tangential direction.

use super::{Lattice, half};
use crate::geometry::solids::FAR;
use crate::geometry::{BodyId, OPEN, SIDE};

/// Distances to walls are exact to this, cells.
const TOUCH: f64 = 1e-6;
/// Distance given to a wall at the centre of the next face where that face is open, so that the wall
/// bounds that face's control volume alone: just too far to touch.
const BEYOND: f64 = 1.0 + 2.0 * TOUCH;

/// The column of half a face's control volume along one tangential direction, seen from the
/// face's centre height: what lies below and above.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Column {
    /// Distance to the wall below and above, cells; [`FAR`] when there is none.
    pub(crate) distance: [f64; 2],
    /// Whose wall it is: a body, [`SIDE`] for a symmetry plane, [`OPEN`] for none.
    pub(crate) body: [BodyId; 2],
}

impl Column {
    /// A column without walls.
    pub(crate) const FREE: Self = Self {
        distance: [FAR; 2],
        body: [OPEN; 2],
    };

    /// Whether the column is solid at the height of the face's centre, or bodies touch there.
    pub(crate) fn blocked(&self) -> bool {
        self.distance[0] + self.distance[1] <= TOUCH
    }

    /// Whether the wall below (0) or above (1) belongs to a body, and so exerts friction,
    /// and lies at most one cell away.
    pub(crate) fn touches(&self, side: usize) -> bool {
        self.body[side] < OPEN && self.distance[side] <= 1.0 + TOUCH
    }

    /// Width H of the lumen, from wall to wall, at most [`FAR`]. A symmetry plane mirrors the lumen.
    pub(crate) fn width(&self) -> f64 {
        let [a, b] = self.distance;
        let width = match self.body.map(|body| body == SIDE) {
            [false, false] => a + b,
            [true, false] | [false, true] => 2.0 * (a + b),
            [true, true] => FAR,
        };
        width.min(FAR)
    }
}

impl Lattice {
    /// The columns along `tangent` of the low face along `axis` of a cell: in 3D four, bit 0
    /// of their index the normal half, bit 1 the half along the other tangential direction;
    /// in plane strain two, and the others repeat them.
    pub(crate) fn columns(&self, axis: usize, cell: [usize; 3], tangent: usize) -> [Column; 4] {
        let n = self.column_count();
        let mut columns = [self.column(axis, cell, tangent, 0); 4];
        for (index, column) in columns.iter_mut().enumerate().skip(1) {
            *column = self.column(axis, cell, tangent, index & (n - 1));
        }
        columns
    }

    /// Columns per face and tangential direction: 4, in plane strain 2.
    pub(crate) fn column_count(&self) -> usize {
        1 << (self.window.domain.axes - 1)
    }

    /// One of [`Lattice::columns`].
    pub(crate) fn column(
        &self,
        axis: usize,
        cell: [usize; 3],
        tangent: usize,
        index: usize,
    ) -> Column {
        // A wall exactly a quarter cell away leaves the column open on its near side.
        const QUARTER: f64 = 0.25 - 1e-5;
        let mut from = self.window.face_centre(axis, cell);
        let other = 3 - axis - tangent;
        from[axis] += if index & 1 == 1 { QUARTER } else { -QUARTER };
        if other < self.window.domain.axes {
            from[other] += if index & 2 == 2 { QUARTER } else { -QUARTER };
        }
        let mut column = Column::FREE;
        let hits = self.solids.rays(from, tangent, FAR);
        for (side, hit) in hits.into_iter().enumerate() {
            if let Some(hit) = hit {
                column.distance[side] = hit.near;
                column.body[side] = hit.body;
                if (hit.near - 1.0).abs() < TOUCH
                    && (self.shifted(cell, tangent, side == 1))
                        .is_some_and(|next| self.face(axis, self.window.index(next)) == OPEN)
                {
                    column.distance[side] = BEYOND;
                }
            }
        }
        column
    }

    /// Whether no wall can lie within one cell of the face's centre along `tangent` (one
    /// exactly there included), by the open fractions of the sub-cells of the three cells
    /// along it; then no rays are needed for friction, and nothing is merged.
    pub(crate) fn clear(&self, axis: usize, cell: [usize; 3], tangent: usize) -> bool {
        let w = &self.window;
        if cell[axis] == 0 || cell[tangent] == 0 || cell[tangent] + 1 >= w.cells[tangent] {
            return false;
        }
        let all = self.all_parts();
        let (low, high) = (all & half(axis, false), all & half(axis, true));
        let start = w.index(cell) - w.stride(tangent);
        (0..3).all(|t| {
            let above = start + t * w.stride(tangent);
            let below = above - w.stride(axis);
            self.uniform[above].open & low == low && self.uniform[below].open & high == high
        })
    }
}

//! Passages narrower than what the centres of faces see.
//!
//! A face whose centre lies on a wall is closed, and its open part joins an open neighbour. A
//! passage one cell wide with both walls through face centres, or half a cell wide, has no such
//! neighbour: it would be blocked where the wood is open. One of the faces across it opens
//! instead and takes the open part of the others.

use rayon::prelude::*;

use super::{Lattice, PROBE};
use crate::solids::OPEN;

impl Lattice {
    /// Opens one face across every passage along `axis` that no open face serves.
    pub(super) fn open_narrow_passages(&mut self, axis: usize) {
        let orphans: Vec<usize> = (0..self.window.len())
            .into_par_iter()
            .with_min_len(1 << 12)
            .filter(|&index| self.is_orphan(axis, index))
            .collect();
        // In the order of the cells: a face that opens serves those after it.
        for index in orphans {
            if self.is_orphan(axis, index) {
                self.faces[axis][index] = OPEN;
            }
        }
    }

    /// Whether a closed face has an open half that borders on its centre and on no open face.
    fn is_orphan(&self, axis: usize, index: usize) -> bool {
        let cell = self.window.coordinates(index);
        if self.faces[axis][index] >= OPEN || !self.window.inner(cell) || self.wraps(axis, cell) {
            return false;
        }
        let open: Vec<usize> = (0..self.column_count())
            .filter(|&q| self.quadrant_sides(axis, cell, q) == [1.0, 1.0])
            .collect();
        // Half of the face, its quadrants side by side; and no wall close behind it.
        let half = match *open.as_slice() {
            [_] => self.column_count() == 2,
            [a, b] => (a ^ b).is_power_of_two(),
            _ => false,
        };
        half && open.iter().all(|&q| {
            self.receivers(axis, cell, q, None).0 == 0 && self.quadrant_passes(axis, cell, q)
        }) && self.connected(cell)
            && self.connected(self.below(axis, cell))
    }

    /// Whether a face lies next to a periodic side: the choice among the faces across a passage
    /// would not be the same for its images.
    fn wraps(&self, axis: usize, cell: [usize; 3]) -> bool {
        let w = &self.window;
        let home = w.home(cell);
        self.tangents(axis).iter().any(|&t| {
            let i = w.low[t] + home[t] as i64;
            w.domain.periodic(t) && (i == 0 || i + 1 == w.domain.cells[t] as i64)
        })
    }

    fn below(&self, axis: usize, mut cell: [usize; 3]) -> [usize; 3] {
        cell[axis] -= 1;
        cell
    }

    /// Whether the open sub-cells of a cell hang together by their faces: otherwise the cell's one
    /// pressure would join what a wall parts.
    fn connected(&self, cell: [usize; 3]) -> bool {
        let w = &self.window;
        let parts = [2, 2, w.parts(2)];
        let first = w.first_sub(cell);
        let mut open = 0_u8;
        for bit in 0..w.sub_per_cell() {
            let at = [bit & 1, bit >> 1 & 1, bit >> 2];
            let sub = first + (0..3).map(|a| at[a] * w.sub_stride(a)).sum::<usize>();
            open |= u8::from(f64::from(self.open[sub]) > PROBE) << bit;
        }
        let mut reached = open & open.wrapping_neg();
        loop {
            let mut next = reached;
            for bit in (0..w.sub_per_cell()).filter(|bit| reached >> bit & 1 == 1) {
                for axis in (0..3).filter(|&a| parts[a] == 2) {
                    next |= open & 1 << (bit ^ 1 << axis);
                }
            }
            if next == reached {
                return reached == open;
            }
            reached = next;
        }
    }
}

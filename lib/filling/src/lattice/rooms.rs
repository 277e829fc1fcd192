//! Whether a cell is one room: its one pressure must not join what a wall parts.

use super::{Lattice, PROBE};

impl Lattice {
    /// Whether the open sub-cells of a cell hang together by their faces.
    pub(super) fn is_one_room(&self, cell: [usize; 3]) -> bool {
        let w = &self.window;
        let first = w.first_sub(cell);
        let parts = [2, 2, w.parts(2)];
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
                    let other = 1_u8 << (bit ^ 1 << axis);
                    if open & other != 0 && next & other == 0 && self.passes(cell, bit, axis) {
                        next |= other;
                    }
                }
            }
            if next == reached {
                return reached == open;
            }
            reached = next;
        }
    }

    /// Whether no wall lies on the centre of the face between sub-cell number `bit` of a cell and
    /// the other one along `axis`.
    fn passes(&self, cell: [usize; 3], bit: usize, axis: usize) -> bool {
        let mut point = self.window.corner(cell);
        for (a, x) in point.iter_mut().enumerate() {
            let quarter = if a < self.window.domain.axes {
                0.25 + 0.5 * (bit >> a & 1) as f64
            } else {
                0.5
            };
            *x += if a == axis { 0.5 } else { quarter };
        }
        [PROBE, -PROBE].into_iter().all(|side| {
            let mut probe = point;
            probe[axis] += side;
            self.solids.at(probe).is_none()
        })
    }
}

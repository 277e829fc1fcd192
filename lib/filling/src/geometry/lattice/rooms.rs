//! Whether a cell is one room: its single pressure must not join spaces that a wall separates.

use super::{Lattice, PROBE};

impl Lattice {
    /// Whether the open sub-cells of a cell are connected through their faces.
    pub(super) fn is_one_room(&self, cell: [usize; 3]) -> bool {
        let w = &self.window;
        let whole = self.uniform[w.index(cell)].open;
        if whole == self.all_parts() {
            return true;
        }
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
                    let both = other | 1 << bit;
                    if open & other != 0
                        && next & other == 0
                        && (whole & both == both || self.passes(cell, bit, axis))
                    {
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

    /// Whether some corner of the face between sub-cell number `bit` and the other one along `axis`
    /// is open on both sides: walls are at least as thick as a sub-cell.
    fn passes(&self, cell: [usize; 3], bit: usize, axis: usize) -> bool {
        let w = &self.window;
        let corner = w.corner(cell);
        (0..8_usize).any(|end| {
            let point = std::array::from_fn(|a| {
                let half = 0.5 * (bit >> a & 1) as f64;
                corner[a]
                    + match (a == axis, a < w.domain.axes, end >> a & 1) {
                        (true, ..) => 0.5,
                        (_, false, _) => 0.5,
                        (.., 0) => half + PROBE,
                        _ => half + 0.5 - PROBE,
                    }
            });
            [PROBE, -PROBE].into_iter().all(|side| {
                let mut probe: [f64; 3] = point;
                probe[axis] += side;
                self.solids.at(probe).is_none()
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use physics::VoxelBlock;

    use crate::geometry::tests::{domain, lattice};

    /// Whether the cell at (3, 3) around which boxes leave a way is one room.
    fn is_one_room(axes: usize, boxes: &[([f64; 3], [f64; 3])]) -> bool {
        let cells = [8, 8, if axes == 3 { 8 } else { 1 }];
        let blocks = boxes
            .iter()
            .map(|&(low, high)| VoxelBlock::solid_box(low, high));
        let lattice = lattice(domain(cells, axes), vec![blocks.collect()]);
        let cell = lattice
            .window
            .local([3.0, 3.0, if axes == 3 { 3.0 } else { 0.0 }]);
        lattice.is_one_room(cell.map(|x| x.round() as usize))
    }

    /// A passage through the cell along x of a fifth of its height, with a wall as thick as a
    /// sub-cell on one side.
    #[test]
    fn a_passage_beside_a_wall_joins_the_halves_of_a_cell() {
        for low in [3.0, 3.3, 3.5, 3.8] {
            let floor = ([0.0; 3], [8.0, low, 8.0]);
            let roof = ([0.0, low + 0.2, 0.0], [8.0; 3]);
            assert!(is_one_room(2, &[floor, roof]), "{low}");
            assert!(is_one_room(3, &[floor, roof]), "{low}");
            let front = ([0.0; 3], [8.0, 8.0, low]);
            let back = ([0.0, 0.0, low + 0.2], [8.0; 3]);
            assert!(is_one_room(3, &[front, back]), "{low} along z");
            // A column of a fifth by a fifth.
            assert!(is_one_room(3, &[floor, roof, front, back]), "{low} both");
        }
    }

    #[test]
    fn a_wall_across_makes_two_rooms() {
        for axis in 0..3 {
            let (mut low, mut high) = ([0.0; 3], [8.0; 3]);
            (low[axis], high[axis]) = (3.25, 3.75);
            assert!(!is_one_room(3, &[(low, high)]), "{axis}");
        }
    }
}

//! Which sub-cells of each cell are open and which are solid throughout, as bits, so that most
//! questions about surroundings take a few bytes.

use rayon::prelude::*;

use crate::geometry::Window;

/// One bit per sub-cell of a cell: bit b of its number is its half along axis b.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Uniform {
    /// Sub-cells open throughout.
    pub(crate) open: u8,
    /// Sub-cells solid throughout.
    pub(crate) solid: u8,
}

/// Those of every cell of `window` with the fractions `open` of its sub-cells.
pub(super) fn uniform(window: &Window, open: &[f32]) -> Vec<Uniform> {
    let [nx, ny, _] = window.cells;
    let mut cells = vec![Uniform::default(); window.len()];
    cells.par_chunks_mut(nx).enumerate().for_each(|(r, row)| {
        for half in 0..window.sub_per_cell() / 2 {
            let (y, z) = (half & 1, half >> 1);
            let first = window.first_sub([0, r % ny, r / ny]);
            let start = first + y * window.sub_stride(1) + z * window.sub_stride(2);
            let (pairs, _) = open[start..start + 2 * nx].as_chunks::<2>();
            for (cell, pair) in row.iter_mut().zip(pairs) {
                for (x, &o) in pair.iter().enumerate() {
                    let bit = 2 * half + x;
                    cell.open |= u8::from(o == 1.0) << bit;
                    cell.solid |= u8::from(o == 0.0) << bit;
                }
            }
        }
    });
    cells
}

/// The bits of the sub-cells in the low or high half of a cell along `axis`.
#[inline]
pub(crate) fn half(axis: usize, high: bool) -> u8 {
    const LOW: [u8; 3] = [0b0101_0101, 0b0011_0011, 0b0000_1111];
    if high { !LOW[axis] } else { LOW[axis] }
}

#[cfg(test)]
mod tests {
    use physics::VoxelBlock;

    use super::*;
    use crate::geometry::tests::{domain, lattice};

    #[test]
    fn bits_are_those_of_the_fractions() {
        for axes in [2, 3] {
            let cells = [5, 4, if axes == 3 { 3 } else { 1 }];
            let block = VoxelBlock::solid_box([1.5, 0.2, -1.0], [3.5, 2.0, 2.5]);
            let lattice = lattice(domain(cells, axes), vec![vec![block]]);
            let window = &lattice.window;
            let (mut open, mut solid) = (0, 0);
            for index in 0..window.len() {
                let first = window.first_sub(window.coordinates(index));
                for bit in 0..window.sub_per_cell() {
                    let sub = first
                        + (0..3)
                            .map(|a| (bit >> a & 1) * window.sub_stride(a))
                            .sum::<usize>();
                    let Uniform { open: o, solid: s } = lattice.uniform[index];
                    assert_eq!(o >> bit & 1 == 1, lattice.open[sub] == 1.0);
                    assert_eq!(s >> bit & 1 == 1, lattice.open[sub] == 0.0);
                    for axis in 0..axes {
                        assert_eq!(half(axis, true) >> bit & 1, (bit >> axis & 1) as u8);
                        assert_eq!(half(axis, false) >> bit & 1, 1 - (bit >> axis & 1) as u8);
                    }
                    (open, solid) = (
                        open + u32::from(o >> bit & 1),
                        solid + u32::from(s >> bit & 1),
                    );
                }
            }
            assert!(open > 0 && solid > 0);
        }
    }
}

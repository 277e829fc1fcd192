//! The part of the domain that a step works on, and its index space.

use physics::{Boundary, Dimensions, GridBox};

/// Layers of cells kept around the liquid, so that neighbours of a liquid cell always have an
/// index and a particle cannot leave the arrays within one step.
pub(crate) const PAD: usize = 3;

/// Domain in cell units: sizes and sides.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Domain {
    /// Cells along x, y, z.
    pub(crate) cells: [usize; 3],
    /// What happens at the sides normal to each axis.
    pub(crate) boundary: [Boundary; 3],
    /// Axes with velocities: 2 in plane strain, else 3.
    pub(crate) axes: usize,
}

impl Domain {
    /// The domain of a scene's grid.
    pub(crate) fn new(grid: &GridBox, boundary: [Boundary; 3], dimensions: Dimensions) -> Self {
        let axes = match dimensions {
            Dimensions::Two => 2,
            Dimensions::Three => 3,
        };
        Self {
            cells: grid.cells,
            boundary,
            axes,
        }
    }

    /// Whether the domain repeats along `axis`.
    pub(crate) fn periodic(&self, axis: usize) -> bool {
        axis < self.axes && self.boundary[axis] == Boundary::Periodic
    }
}

/// A box of cells with padding; cells, faces and sub-cells of a step are indexed in it.
///
/// One index serves cells and faces: face (axis, c) is the low face of cell c along that
/// axis. Sub-cells are half cells, 2 x 2 x 2 of them in a cell, in plane strain 2 x 2 x 1.
/// x runs fastest everywhere. Padding may lie outside the domain: beyond a symmetry plane it
/// is solid, beyond an open side empty, beyond a periodic side an image of the other side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Window {
    /// Domain index of the first cell; negative in the padding.
    pub(crate) low: [i64; 3],
    /// Cells along x, y, z, with padding.
    pub(crate) cells: [usize; 3],
    /// The whole domain.
    pub(crate) domain: Domain,
}

impl Window {
    /// The window that holds the cells `from..to` (domain indices) and the padding.
    /// A periodic axis is always covered whole.
    pub(crate) fn around(domain: Domain, from: [i64; 3], to: [i64; 3]) -> Self {
        let mut window = Self {
            low: [0; 3],
            cells: [1; 3],
            domain,
        };
        for axis in 0..domain.axes {
            let n = domain.cells[axis] as i64;
            let (a, b) = if domain.periodic(axis) {
                (0, n)
            } else {
                (from[axis].clamp(0, n - 1), to[axis].clamp(1, n))
            };
            window.low[axis] = a - PAD as i64;
            window.cells[axis] = (b.max(a + 1) - a) as usize + 2 * PAD;
        }
        window
    }

    /// Number of cells.
    pub(crate) fn len(&self) -> usize {
        self.cells.iter().product()
    }

    /// Distance in the index between neighbours along `axis`.
    #[inline]
    pub(crate) fn stride(&self, axis: usize) -> usize {
        match axis {
            0 => 1,
            1 => self.cells[0],
            _ => self.cells[0] * self.cells[1],
        }
    }

    /// Index of the cell at window coordinates.
    #[inline]
    pub(crate) fn index(&self, [i, j, k]: [usize; 3]) -> usize {
        (k * self.cells[1] + j) * self.cells[0] + i
    }

    /// Window coordinates of a cell.
    #[inline]
    pub(crate) fn coordinates(&self, index: usize) -> [usize; 3] {
        let row = index / self.cells[0];
        [
            index % self.cells[0],
            row % self.cells[1],
            row / self.cells[1],
        ]
    }

    /// Low corner of a cell in cell units of the domain.
    #[inline]
    pub(crate) fn corner(&self, cell: [usize; 3]) -> [f64; 3] {
        std::array::from_fn(|a| (self.low[a] + cell[a] as i64) as f64)
    }

    /// Centre of the low face along `axis` of a cell, in cell units of the domain.
    #[inline]
    pub(crate) fn face_centre(&self, axis: usize, cell: [usize; 3]) -> [f64; 3] {
        let corner = self.corner(cell);
        std::array::from_fn(|a| corner[a] + if a == axis { 0.0 } else { 0.5 })
    }

    /// Position relative to the window's low corner, in cells, of a point of the domain.
    #[inline]
    pub(crate) fn local(&self, point: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|a| point[a] - self.low[a] as f64)
    }

    /// Sub-cells per cell along `axis`.
    #[inline]
    pub(crate) fn parts(&self, axis: usize) -> usize {
        if axis < self.domain.axes { 2 } else { 1 }
    }

    /// Sub-cells of a cell: 8, in plane strain 4.
    pub(crate) fn sub_per_cell(&self) -> usize {
        1 << self.domain.axes
    }

    /// Sub-cells along x, y, z.
    pub(crate) fn sub_cells(&self) -> [usize; 3] {
        std::array::from_fn(|a| self.cells[a] * self.parts(a))
    }

    /// Number of sub-cells.
    pub(crate) fn sub_len(&self) -> usize {
        self.sub_cells().iter().product()
    }

    /// Distance in the sub-cell index between neighbours along `axis`.
    #[inline]
    pub(crate) fn sub_stride(&self, axis: usize) -> usize {
        match axis {
            0 => 1,
            1 => 2 * self.cells[0],
            _ => 4 * self.cells[0] * self.cells[1],
        }
    }

    /// Index of the low sub-cell of the cell at window coordinates.
    #[inline]
    pub(crate) fn first_sub(&self, [i, j, k]: [usize; 3]) -> usize {
        2 * i + 2 * j * self.sub_stride(1) + self.parts(2) * k * self.sub_stride(2)
    }

    /// Whether all neighbours of a cell, diagonal ones too, are in the window.
    #[inline]
    pub(crate) fn inner(&self, cell: [usize; 3]) -> bool {
        (0..self.domain.axes).all(|a| cell[a] >= 1 && cell[a] + 1 < self.cells[a])
    }

    /// Whether the cell is in the domain, not in padding beyond one of its sides.
    #[inline]
    pub(crate) fn in_domain(&self, cell: [usize; 3]) -> bool {
        (0..3).all(|a| {
            let i = self.low[a] + cell[a] as i64;
            i >= 0 && i < self.domain.cells[a] as i64
        })
    }

    /// The cell of the domain that a cell is or, beyond a periodic side, is an image of.
    #[inline]
    pub(crate) fn home(&self, mut cell: [usize; 3]) -> [usize; 3] {
        for (axis, place) in cell.iter_mut().enumerate() {
            if self.domain.periodic(axis) {
                let n = self.domain.cells[axis] as i64;
                let i = (self.low[axis] + *place as i64).rem_euclid(n);
                *place = (i - self.low[axis]) as usize;
            }
        }
        cell
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indices_and_images() {
        let domain = Domain {
            cells: [10, 6, 1],
            boundary: [Boundary::Periodic, Boundary::Symmetry, Boundary::Symmetry],
            axes: 2,
        };
        let w = Window::around(domain, [4, 2, 0], [5, 4, 1]);
        assert_eq!((w.low, w.cells), ([-3, -1, 0], [16, 2 + 2 * PAD, 1]));
        for index in 0..w.len() {
            assert_eq!(w.index(w.coordinates(index)), index);
        }
        assert_eq!(w.home([0, 2, 0]), [10, 2, 0]);
        assert_eq!(w.home([13, 2, 0]), [3, 2, 0]);
        assert_eq!(w.sub_cells(), [32, 16, 1]);
        assert!(w.in_domain([3, 1, 0]) && !w.in_domain([2, 1, 0]));
    }
}

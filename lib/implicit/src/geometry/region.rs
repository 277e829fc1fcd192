//! Sets of cells of a box, such as the active cells around the liquid.

use super::mesh::Topology;

/// A set of cells of a box, numbered x first, then y, then z.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Region {
    size: [usize; 3],
    cells: Vec<bool>,
}

impl Region {
    /// All cells of a box, or none.
    pub(crate) fn new(size: [usize; 3], all: bool) -> Self {
        Self {
            size,
            cells: vec![all; size.iter().product()],
        }
    }

    pub(crate) fn contains(&self, cell: usize) -> bool {
        self.cells[cell]
    }

    pub(crate) fn add(&mut self, cell: usize) {
        self.cells[cell] = true;
    }

    /// Whether the set includes all cells of `other`.
    pub(crate) fn covers(&self, other: &Self) -> bool {
        let mut pairs = self.cells.iter().zip(&other.cells);
        pairs.all(|(own, other)| *own || !other)
    }

    /// The set dilated by `by` cells along each axis, across `periodic` sides too.
    pub(crate) fn grown(&self, by: usize, periodic: [bool; 3]) -> Self {
        let mut region = self.clone();
        let mut counts = Vec::new();
        for (axis, &n) in self.size.iter().enumerate() {
            let stride: usize = self.size[..axis].iter().product();
            for line in 0..region.cells.len() / n {
                let start = line / stride * stride * n + line % stride;
                let at = |i: usize| start + i * stride;
                // Prefix counts of set cells along the line, extended by its periodic images on both sides.
                let before = if periodic[axis] { by.min(n) } else { 0 };
                counts.clear();
                counts.push(0_usize);
                for i in 0..n + 2 * before {
                    let is_member = region.cells[at((i + n - before) % n)];
                    counts.push(counts[i] + usize::from(is_member));
                }
                for i in 0..n {
                    let low = (i + before).saturating_sub(by);
                    let high = (i + before + by + 1).min(n + 2 * before);
                    region.cells[at(i)] = counts[high] > counts[low];
                }
            }
        }
        region
    }

    /// The set eroded by one cell: cells whose neighbours, across edges and corners too, all belong to the set.
    pub(crate) fn inner(&self, periodic: [bool; 3]) -> Self {
        let complement = |region: &Self| Self {
            size: region.size,
            cells: region.cells.iter().map(|is_member| !is_member).collect(),
        };
        complement(&complement(self).grown(1, periodic))
    }

    /// The set as a bit mask, for checkpoints.
    pub(crate) fn bits(&self) -> Vec<u32> {
        let word = |cells: &[bool]| {
            let bits = cells.iter().enumerate();
            bits.fold(0, |word, (bit, &is_member)| {
                word | u32::from(is_member) << bit
            })
        };
        self.cells.chunks(32).map(word).collect()
    }

    /// The set from a bit mask; `None` where the mask has the wrong length.
    pub(crate) fn of_bits(size: [usize; 3], bits: &[u32]) -> Option<Self> {
        let mut region = Self::new(size, false);
        let fits = bits.len() == region.cells.len().div_ceil(32);
        for (cell, is_member) in region.cells.iter_mut().enumerate() {
            *is_member = fits && bits[cell / 32] >> (cell % 32) & 1 == 1;
        }
        fits.then_some(region)
    }
}

impl Topology {
    /// Cells with a pore for which `holds` is true.
    pub(crate) fn cells_with(&self, holds: impl Fn(usize) -> bool) -> Region {
        let mut region = Region::new(self.size, false);
        for (pore, of) in self.pores.iter().enumerate() {
            if holds(pore) {
                region.add(of.cell as usize);
            }
        }
        region
    }

    /// [`Topology::inner`].
    pub(super) fn inner_cells(&self) -> Region {
        let (range, rows) = (&self.range, self.layout.len());
        let is_cut = |row: usize| {
            range.start > 0 && row == range.start || range.end < rows && row + 1 == range.end
        };
        let mut inner = self.region.inner(self.periodic());
        for (cell, is_member) in inner.cells.iter_mut().enumerate() {
            *is_member &= !is_cut(self.row(cell));
        }
        inner
    }

    /// Whether a face borders on an inner cell. Only such faces have wall couplings and edges, and may move; liquid that comes
    /// farther waits for the next mesh.
    pub(crate) fn is_inner(&self, face: usize) -> bool {
        (self.faces[face].pores().iter()).any(|&pore| self.inner.contains(self.cell(pore)))
    }

    /// Whether these pores may go on beyond the active cells.
    pub(crate) fn is_cut(&self, pores: &[u32]) -> bool {
        let mut pores = pores.iter().map(|&pore| pore as usize);
        pores.any(|pore| !self.inner.contains(self.cell(pore)))
    }

    /// Cells that are wholly open, as are all their neighbours: no wall acts on their faces.
    pub(crate) fn wall_free_cells(&self) -> Region {
        let mut open = Region::new(self.size, false);
        let whole = (1_u32 << self.k.pow(3)) - 1;
        for pore in &self.pores {
            if u32::from(pore.voxels) == whole {
                open.add(pore.cell as usize);
            }
        }
        open.inner(self.periodic())
    }

    /// Whether both cells of a face are in `clear`, the set of [`Self::wall_free_cells`].
    pub(crate) fn is_wall_free(&self, face: usize, clear: &Region) -> bool {
        (self.faces[face].pores().iter()).all(|&pore| clear.contains(self.cell(pore)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cells(region: &Region) -> Vec<usize> {
        (0..region.cells.len())
            .filter(|&cell| region.contains(cell))
            .collect()
    }

    #[test]
    fn regions_grow_along_each_axis_and_over_periodic_sides() {
        let mut region = Region::new([4, 3, 1], false);
        region.add(0);
        assert_eq!(cells(&region.grown(1, [false; 3])), [0, 1, 4, 5]);
        let over_x = region.grown(1, [true, false, false]);
        assert_eq!(cells(&over_x), [0, 1, 3, 4, 5, 7]);
        assert!(over_x.covers(&region) && !region.covers(&over_x));
        assert_eq!(cells(&region.grown(9, [true, false, true])).len(), 12);
        assert_eq!(cells(&over_x.inner([true, false, false])), [0]);
        assert_eq!(Region::of_bits([4, 3, 1], &over_x.bits()), Some(over_x));
        assert_eq!(Region::of_bits([4, 3, 1], &[0, 0]), None);
    }
}

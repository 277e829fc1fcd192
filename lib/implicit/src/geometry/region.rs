//! Some of the cells of a box: those that a mesh has pores in, near liquid, and those of a mesh with something in common.

use super::mesh::{Face, Mesh};

/// Some of the cells of a box, x first, then y, then z.
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

    /// Whether all cells of `other` are among these.
    pub(crate) fn covers(&self, other: &Self) -> bool {
        let mut pairs = self.cells.iter().zip(&other.cells);
        pairs.all(|(own, other)| *own || !other)
    }

    /// The cells at most `by` from these along each axis, over `periodic` sides too.
    pub(crate) fn grown(&self, by: usize, periodic: [bool; 3]) -> Self {
        let mut region = self.clone();
        let mut counts = Vec::new();
        for (axis, &n) in self.size.iter().enumerate() {
            let stride: usize = self.size[..axis].iter().product();
            for line in 0..region.cells.len() / n {
                let start = line / stride * stride * n + line % stride;
                let at = |i: usize| start + i * stride;
                // Cells of the line and of its images on both sides up to each.
                let before = if periodic[axis] { by.min(n) } else { 0 };
                counts.clear();
                counts.push(0_usize);
                for i in 0..n + 2 * before {
                    let held = region.cells[at((i + n - before) % n)];
                    counts.push(counts[i] + usize::from(held));
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

    /// The cells whose neighbours, edges and corners in, are all among these.
    pub(crate) fn inner(&self, periodic: [bool; 3]) -> Self {
        let turned = |region: &Self| Self {
            size: region.size,
            cells: region.cells.iter().map(|held| !held).collect(),
        };
        turned(&turned(self).grown(1, periodic))
    }

    /// The cells as bits, for checkpoints.
    pub(crate) fn bits(&self) -> Vec<u32> {
        let word = |cells: &[bool]| {
            let bits = cells.iter().enumerate();
            bits.fold(0, |word, (bit, &held)| word | u32::from(held) << bit)
        };
        self.cells.chunks(32).map(word).collect()
    }

    /// The cells of a box by their bits; `None` where there are more or fewer.
    pub(crate) fn of_bits(size: [usize; 3], bits: &[u32]) -> Option<Self> {
        let mut region = Self::new(size, false);
        let fits = bits.len() == region.cells.len().div_ceil(32);
        for (cell, held) in region.cells.iter_mut().enumerate() {
            *held = fits && bits[cell / 32] >> (cell % 32) & 1 == 1;
        }
        fits.then_some(region)
    }
}

impl Mesh {
    /// Cells with a pore that `holds` liquid.
    pub(crate) fn cells_with(&self, holds: impl Fn(usize) -> bool) -> Region {
        let mut region = Region::new(self.size, false);
        for (pore, of) in self.pores.iter().enumerate() {
            if holds(pore) {
                region.add(of.cell as usize);
            }
        }
        region
    }

    /// Which faces are beside a cell whose neighbours are all in the region: only these can have liquid.
    pub(crate) fn inner_faces(&self) -> Vec<bool> {
        let inner = self.region.inner(self.periodic());
        let holds = |face: &Face| {
            face.ends()
                .iter()
                .any(|&pore| inner.contains(self.cell(pore)))
        };
        self.faces.iter().map(holds).collect()
    }

    /// Cells that are open, as are all of their neighbours: no wall is near.
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

    /// Whether both cells of a face are among those.
    pub(crate) fn is_wall_free(&self, face: usize, clear: &Region) -> bool {
        (self.faces[face].ends().iter()).all(|&pore| clear.contains(self.cell(pore)))
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

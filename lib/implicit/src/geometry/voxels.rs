//! The voxels of a mesh: where they lie in the lattice, what fills them, and which lie beside them.

use physics::Boundary;

use super::chords::Place;
use super::lattice::{Lattice, MIRROR, OPEN};
use super::mesh::Mesh;
use super::rows::Kind;

impl Mesh {
    /// Where in the lattice a voxel of a cell lies; `None` beyond the layers of a part or an open side.
    pub(crate) fn lattice_place(
        &self,
        lattice: &Lattice,
        cell: usize,
        voxel: [usize; 3],
    ) -> Option<Place> {
        let [x, y, z] = self.place(cell);
        let across = lattice.across();
        let sub = |i: usize, a: usize| (i * self.k + voxel[a]).checked_sub(self.beyond[a] * self.k);
        let (x, z) = (sub(x, 0)?, sub(z, 2)?);
        if x >= across[0] || z >= across[1] {
            return None;
        }
        let at = x + across[0] * z;
        let row = y + self.range.start;
        let (b, rows) = (voxel[1], self.rows());
        match rows.kind(row) {
            Kind::Below => {
                let layer = (rows.below - 1 - row) * self.k + (self.k - 1 - b);
                (layer < lattice.below.len()).then_some(Place::Below(layer, at))
            }
            Kind::Gap => Some(Place::Gap(at)),
            Kind::Above => {
                let layer = (row - rows.below - rows.gap) * self.k + b;
                (layer < lattice.above.len()).then_some(Place::Above(layer, at))
            }
        }
    }

    /// What fills a voxel of a cell.
    pub(crate) fn code(&self, lattice: &Lattice, cell: usize, voxel: [usize; 3]) -> u8 {
        match self.lattice_place(lattice, cell, voxel) {
            Some(Place::Below(layer, at)) => lattice.below[layer][at],
            Some(Place::Gap(at)) => lattice.gap[at],
            Some(Place::Above(layer, at)) => lattice.above[layer][at],
            None if self.boundary[1] == Boundary::Open || self.is_beyond(cell) => OPEN,
            None => MIRROR,
        }
    }

    /// The voxel next to one along an axis: its cell and place; `None` beyond the mesh.
    pub(crate) fn next_voxel(
        &self,
        cell: usize,
        mut voxel: [usize; 3],
        axis: usize,
        up: bool,
    ) -> Option<(usize, [usize; 3])> {
        let last = self.k - 1;
        let crosses = voxel[axis] == if up { last } else { 0 };
        if !crosses {
            voxel[axis] = if up { voxel[axis] + 1 } else { voxel[axis] - 1 };
            return Some((cell, voxel));
        }
        voxel[axis] = if up { 0 } else { last };
        self.neighbour(cell, axis, up).map(|cell| (cell, voxel))
    }
}

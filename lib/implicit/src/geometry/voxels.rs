//! The voxels of a mesh: where they lie in the lattice, what fills them, and which lie beside them.

use physics::Boundary;

use super::chords::VoxelPlace;
use super::lattice::{Lattice, MIRROR, OPEN};
use super::mesh::{Face, Mesh, Pore, others};
use super::rows::RowKind;

/// Friction and exchange at half a voxel from a re-entrant edge over those of flow that is linear there, by how many voxels
/// there are in the edge of a cell and along how many of the two axes the edge lies within a cell. Along such an edge flow is
/// u ~ r^(2/3) sin(2 theta/3); with these factors one alone adds no c r^(-2/3) sin(2 theta/3) far from it.
const REENTRANT: [[f64; 3]; 2] = [[1.246, 1.0, 1.0], [1.493, 1.358, 1.245]];

/// Cells along a wall, rounded up, within which [`Mesh::step_proximity`] sees a step: what it says near the end of a mesh
/// is not what it says in a longer one.
pub(crate) const STEP_REACH: usize = 2;

/// A voxel: its cell and its place in it.
type VoxelAt = (usize, [usize; 3]);

impl Mesh {
    /// Where in the lattice a voxel of the cell at a place lies; `None` beyond the layers of a part or an open side.
    pub(crate) fn lattice_place(
        &self,
        lattice: &Lattice,
        [x, y, z]: [usize; 3],
        voxel: [usize; 3],
    ) -> Option<VoxelPlace> {
        let across = lattice.layer_size();
        let sub =
            |i: usize, a: usize| (i * self.k + voxel[a]).checked_sub(self.ghost_layers[a] * self.k);
        let (x, z) = (sub(x, 0)?, sub(z, 2)?);
        if x >= across[0] || z >= across[1] {
            return None;
        }
        let at = x + across[0] * z;
        let row = y + self.range.start;
        let (b, rows) = (voxel[1], self.rows());
        match rows.kind(row) {
            RowKind::Below => {
                let layer = (rows.below - 1 - row) * self.k + (self.k - 1 - b);
                (layer < lattice.below.len()).then_some(VoxelPlace::Below(layer, at))
            }
            RowKind::Gap => Some(VoxelPlace::Gap(at)),
            RowKind::Above => {
                let layer = (row - rows.below - rows.gap) * self.k + b;
                (layer < lattice.above.len()).then_some(VoxelPlace::Above(layer, at))
            }
        }
    }

    /// Places in their cell of the voxels of a pore.
    pub(crate) fn voxels(&self, pore: usize) -> impl Iterator<Item = [usize; 3]> {
        let Pore { voxels, .. } = self.pores[pore];
        (0..8)
            .filter(move |bit| voxels >> bit & 1 == 1)
            .map(|bit| self.voxel(bit))
    }

    /// Whether the voxel at a place in its cell is one of a pore's.
    pub(crate) fn has_voxel(&self, pore: usize, voxel: [usize; 3]) -> bool {
        self.pores[pore].voxels >> self.bit(voxel) & 1 == 1
    }

    /// Whether a face is open at the column of voxels along its axis through a place in a cell.
    pub(crate) fn is_open(&self, face: usize, at: [usize; 3]) -> bool {
        let Face { open, axis, .. } = self.faces[face];
        let [s, t] = others(usize::from(axis));
        open >> (at[s] + self.k * at[t]) & 1 == 1
    }

    /// The bit of the voxel at a place in its cell.
    pub(super) fn bit(&self, [x, y, z]: [usize; 3]) -> usize {
        x + self.k * (y + self.k * z)
    }

    /// Open voxels of a cell of the region.
    pub(super) fn open_voxels(&self, cell: usize) -> u8 {
        (0..self.k.pow(3))
            .filter(|_| self.region.contains(cell))
            .filter(|&bit| self.code(cell, self.voxel(bit)) == OPEN)
            .fold(0, |open, bit| open | 1 << bit)
    }

    /// What fills a voxel of a cell.
    pub(crate) fn code(&self, cell: usize, voxel: [usize; 3]) -> u8 {
        self.codes[self.k * self.k * self.k * cell + self.bit(voxel)]
    }

    /// What fills a voxel of a cell, by the lattice.
    pub(super) fn lattice_code(&self, lattice: &Lattice, cell: usize, voxel: [usize; 3]) -> u8 {
        match self.lattice_place(lattice, self.place(cell), voxel) {
            Some(VoxelPlace::Below(layer, at)) => lattice.below[layer][at],
            Some(VoxelPlace::Gap(at)) => lattice.gap[at],
            Some(VoxelPlace::Above(layer, at)) => lattice.above[layer][at],
            None if self.boundary[1] == Boundary::Open || self.is_ghost(cell) => OPEN,
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
        self.next_cell(cell, axis, up).map(|cell| (cell, voxel))
    }

    /// Logarithm of the factor of friction and exchange between an open voxel and the one next to it along the first of two
    /// axes, by re-entrant edges of walls at either side of them along the second, in cells as high as wide.
    pub(crate) fn ln_reentrant_factor(
        &self,
        at: VoxelAt,
        [t, across]: [usize; 2],
        up: bool,
    ) -> f64 {
        let mut sum = 0.0;
        for side in [false, true] {
            let step = |at: VoxelAt, axis: usize, up: bool| self.next_voxel(at.0, at.1, axis, up);
            let wall = |at: VoxelAt| self.is_wall(at);
            // Beyond a mirror is no edge.
            let Some(beside) = step(at, across, side) else {
                continue;
            };
            let ends = step(at, t, up).zip(step(beside, t, up));
            let Some((next, opposite)) = ends else {
                continue;
            };
            // The solid voxel, and which way the edge lies from it.
            let (solid, towards) = match [next, beside, opposite].map(wall) {
                [Some(true), Some(false), Some(false)] => (next, [!up, side]),
                [Some(false), Some(true), Some(false)] => (beside, [up, !side]),
                [Some(false), Some(false), Some(true)] => (opposite, [!up, !side]),
                _ => continue,
            };
            let [along, aside] = towards;
            // Whether the walls on both sides of the edge are a cell long, for cells of two voxels.
            let is_long = |axis: usize, up: bool, normal: usize, out: bool| {
                let open = |at: VoxelAt| step(at, normal, out).and_then(wall) == Some(false);
                step(solid, axis, !up).is_some_and(|on| wall(on) == Some(true) && open(on))
            };
            let whole = is_long(t, along, across, aside) && is_long(across, aside, t, along);
            let within = |axis: usize, up: bool| {
                let last = self.k - 1;
                usize::from(at.1[axis] != if up { last } else { 0 })
            };
            let full = REENTRANT[self.k - 1][within(t, up) + within(across, side)].ln();
            sum += if self.k == 1 || whole {
                full
            } else {
                0.5 * full
            };
        }
        sum
    }

    /// Whether a voxel is solid; `None` beyond a mirror.
    fn is_wall(&self, (cell, voxel): VoxelAt) -> Option<bool> {
        let code = self.code(cell, voxel);
        (code != MIRROR).then_some(code != OPEN)
    }

    /// How near a wall at an open voxel along the first of two axes ends in a step along the second: 1 within a cell, 0 from
    /// one and a half on.
    pub(crate) fn step_proximity(&self, start: VoxelAt, [t, across]: [usize; 2], up: bool) -> f64 {
        let is_wall = |at: VoxelAt| self.is_wall(at);
        let mut nearest = f64::INFINITY;
        for side in [false, true] {
            let mut at = start;
            for n in 0..(3 * self.k).div_ceil(2) {
                let Some(next) = self.next_voxel(at.0, at.1, across, side) else {
                    break;
                };
                if is_wall(next) != Some(false) {
                    break;
                }
                if self.next_voxel(next.0, next.1, t, up).and_then(is_wall) != Some(true) {
                    nearest = nearest.min((n as f64 + 0.5) / self.k as f64);
                    break;
                }
                at = next;
            }
        }
        (2.0 * (1.5 - nearest)).clamp(0.0, 1.0)
    }
}

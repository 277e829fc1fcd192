//! The voxels of a mesh: their place in the lattice, their codes and neighbours, re-entrant edges and steps of walls.

use physics::Boundary;

use super::chords::VoxelAddress;
use super::lattice::{Lattice, MIRROR, OPEN};
use super::mesh::{Topology, others};
use super::pore::{Face, Pore};
use super::rows::RowKind;

/// Factors on friction and shear half a voxel from a re-entrant edge, relative to linear profiles (docs/methods.md section
/// 3.5). Rows: one or two voxels along the edge of a cell; columns: the number of the two transverse axes along which the
/// edge lies inside a cell. Flow along such an edge is u ~ r^(2/3) sin(2 theta/3); with these factors a single edge adds no
/// far field c r^(-2/3) sin(2 theta/3).
const REENTRANT_FACTORS: [[f64; 3]; 2] = [[1.246, 1.0, 1.0], [1.493, 1.358, 1.245]];

/// Reach of [`Topology::step_proximity`] along a wall, cells, rounded up. Nearer to the end of a mesh its result may change when
/// the mesh grows.
pub(crate) const STEP_REACH: usize = 2;

/// A voxel: its cell and its position in the cell.
type VoxelAt = (usize, [usize; 3]);

impl Topology {
    /// Lattice address of a voxel of the cell with indices x, y, z; `None` beyond the lattice.
    pub(crate) fn lattice_address(
        &self,
        lattice: &Lattice,
        [x, y, z]: [usize; 3],
        voxel: [usize; 3],
    ) -> Option<VoxelAddress> {
        let across = lattice.layer_size();
        let sub =
            |i: usize, a: usize| (i * self.k + voxel[a]).checked_sub(self.ghost_layers[a] * self.k);
        let (x, z) = (sub(x, 0)?, sub(z, 2)?);
        if x >= across[0] || z >= across[1] {
            return None;
        }
        let at = x + across[0] * z;
        let row = y + self.range.start;
        let (b, rows) = (voxel[1], self.layout);
        let part = rows.kind(row);
        let layer = match part {
            RowKind::Below => (rows.below - 1 - row) * self.k + (self.k - 1 - b),
            RowKind::Gap => 0,
            RowKind::Above => (row - rows.below - rows.gap) * self.k + b,
        };
        let exists = layer < lattice.layers[part as usize].len();
        exists.then_some(VoxelAddress { part, layer, at })
    }

    /// Positions in their cell of the voxels of a pore.
    pub(crate) fn voxels(&self, pore: usize) -> impl Iterator<Item = [usize; 3]> {
        let Pore { voxels, .. } = self.pores[pore];
        (0..8)
            .filter(move |bit| voxels >> bit & 1 == 1)
            .map(|bit| self.voxel(bit))
    }

    /// Whether the voxel at a position in the pore's cell belongs to the pore.
    pub(crate) fn has_voxel(&self, pore: usize, voxel: [usize; 3]) -> bool {
        self.pores[pore].voxels >> self.bit(voxel) & 1 == 1
    }

    /// Whether a face is open at the voxel column along its axis through the position `at`.
    pub(crate) fn is_open(&self, face: usize, at: [usize; 3]) -> bool {
        let Face { open, axis, .. } = self.faces[face];
        let [s, t] = others(usize::from(axis));
        open >> (at[s] + self.k * at[t]) & 1 == 1
    }

    /// Mask bit of the voxel at a position in its cell.
    pub(super) fn bit(&self, [x, y, z]: [usize; 3]) -> usize {
        x + self.k * (y + self.k * z)
    }

    /// Mask of the open voxels of a cell; none where the cell is not active.
    pub(super) fn open_voxels(&self, cell: usize) -> u8 {
        (0..self.k.pow(3))
            .filter(|_| self.region.contains(cell))
            .filter(|&bit| self.code(cell, self.voxel(bit)) == OPEN)
            .fold(0, |open, bit| open | 1 << bit)
    }

    /// Code of a voxel of a cell.
    pub(crate) fn code(&self, cell: usize, voxel: [usize; 3]) -> u8 {
        self.codes[self.k * self.k * self.k * cell + self.bit(voxel)]
    }

    /// Code of the body whose wall bounds a pore on its high (`up`) or low side along y.
    pub(crate) fn wall_code(&self, pore: usize, up: bool) -> u8 {
        self.voxels(pore)
            .filter_map(|voxel| self.next_voxel(self.cell(pore), voxel, 1, up))
            .map(|(cell, voxel)| self.code(cell, voxel))
            .find(|&code| code != OPEN)
            .unwrap_or(OPEN)
    }

    /// Code of a voxel of a cell, looked up in the lattice.
    pub(super) fn lattice_code(&self, lattice: &Lattice, cell: usize, voxel: [usize; 3]) -> u8 {
        match self.lattice_address(lattice, self.cell_indices(cell), voxel) {
            Some(VoxelAddress { part, layer, at }) => lattice.layers[part as usize][layer][at],
            None if self.boundary[1] == Boundary::Open || self.is_ghost(cell) => OPEN,
            None => MIRROR,
        }
    }

    /// The next voxel along an axis, as cell and position; `None` beyond the mesh.
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

    /// Logarithm of the re-entrant correction ([`REENTRANT_FACTORS`]) of friction or shear between an open voxel and its next one
    /// along `t`: the sum over the re-entrant edges at both sides along `across`. For cubic cells.
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
            // No edge lies beyond a mirror.
            let Some(beside) = step(at, across, side) else {
                continue;
            };
            let ends = step(at, t, up).zip(step(beside, t, up));
            let Some((next, opposite)) = ends else {
                continue;
            };
            // The solid voxel among the four at the edge, and on which of its sides the edge lies along `t` and `across`.
            let (solid, towards) = match [next, beside, opposite].map(wall) {
                [Some(true), Some(false), Some(false)] => (next, [!up, side]),
                [Some(false), Some(true), Some(false)] => (beside, [up, !side]),
                [Some(false), Some(false), Some(true)] => (opposite, [!up, !side]),
                _ => continue,
            };
            let [along, aside] = towards;
            // Whether both walls that meet at the edge are a cell (two voxels) long.
            let is_long = |axis: usize, up: bool, normal: usize, out: bool| {
                let open = |at: VoxelAt| step(at, normal, out).and_then(wall) == Some(false);
                step(solid, axis, !up).is_some_and(|on| wall(on) == Some(true) && open(on))
            };
            let whole = is_long(t, along, across, aside) && is_long(across, aside, t, along);
            let within = |axis: usize, up: bool| {
                let last = self.k - 1;
                usize::from(at.1[axis] != if up { last } else { 0 })
            };
            let full = REENTRANT_FACTORS[self.k - 1][within(t, up) + within(across, side)].ln();
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

    /// s of docs/methods.md section 3.5: 1 if the wall that bounds an open voxel along `t` ends in a step within a cell along
    /// `across`, 0 from 1.5 cells on, linear between.
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

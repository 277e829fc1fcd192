//! The mesh: pores and faces of a range of rows, and which of them are neighbours.

use std::ops::{Deref, Range};
use std::sync::Arc;

use physics::Boundary;
use rayon::prelude::*;

use super::lattice::Lattice;
use super::measures::Measures;
use super::pore::{Face, Neighbour, Pore};
use super::region::Region;
use super::rows::Rows;
use super::split::connected;

/// The pores and faces of a range of rows, at a height of the gap.
#[derive(Clone)]
pub(crate) struct Mesh {
    pub(super) topology: Arc<Topology>,
    pub(super) measures: Measures,
}

impl Deref for Mesh {
    type Target = Topology;

    fn deref(&self) -> &Topology {
        &self.topology
    }
}

/// The part of a mesh that does not depend on the height of the gap. Cells are numbered x first, then y (rows), then z. Beyond
/// each open side lies a layer of ghost cells that takes the outflow.
pub(crate) struct Topology {
    pub(crate) k: usize,
    /// Cells along x, rows, cells along z, ghost cells included.
    pub(crate) size: [usize; 3],
    /// Layers of ghost cells at the low side of each axis.
    pub(crate) ghost_layers: [usize; 3],
    /// Row counts; the height is that of the gap when the mesh was built.
    pub(super) layout: Rows,
    /// Rows of the grid that this mesh covers.
    pub(crate) range: Range<usize>,
    /// Active cells: only these have pores.
    pub(crate) region: Region,
    pub(crate) boundary: [Boundary; 3],
    pub(crate) pores: Vec<Pore>,
    pub(crate) faces: Vec<Face>,
    /// Code of each voxel of each cell: open, mirror or body.
    pub(super) codes: Vec<u8>,
    /// Bit mask of the sides of the box at which each cell lies: low and high along x, y, z.
    at_sides: Vec<u8>,
    /// Start of each cell's pores in `pores` (compressed rows, with an end).
    pore_start: Vec<u32>,
    /// Start of each cell's faces towards its next cell along x, y, z in `faces` (compressed rows, with an end).
    face_start: Vec<u32>,
    /// Faces of each pore, grouped by side (low and high along x, y, z), and the start of each group.
    pore_faces: Vec<u32>,
    pore_face_start: Vec<u32>,
    /// Active cells whose neighbours are all active, or beyond a side of the domain.
    pub(crate) inner: Region,
}

impl Mesh {
    /// Size of the box of cells of the rows in `range`.
    pub(crate) fn size_of(lattice: &Lattice, range: &Range<usize>) -> [usize; 3] {
        let ghost_layers = Self::ghost_layers_of(lattice);
        let [nx, nz] = lattice.cells;
        [
            nx + 2 * ghost_layers[0],
            range.len(),
            nz + 2 * ghost_layers[2],
        ]
    }

    /// Layers of ghost cells at the low side of each axis.
    fn ghost_layers_of(lattice: &Lattice) -> [usize; 3] {
        let open_side = |a: usize| usize::from(lattice.boundary[a] == Boundary::Open);
        [open_side(0), 0, open_side(2)]
    }

    /// The mesh of all cells of the rows in `range`.
    pub(crate) fn whole(lattice: &Lattice, rows: Rows, range: Range<usize>) -> Self {
        let region = Region::new(Self::size_of(lattice, &range), true);
        Self::new(lattice, rows, range, region)
    }

    /// The mesh of the active cells `region` of the rows in `range`.
    pub(crate) fn new(lattice: &Lattice, rows: Rows, range: Range<usize>, region: Region) -> Self {
        let ghost_layers = Self::ghost_layers_of(lattice);
        let size = Self::size_of(lattice, &range);
        let cells: usize = size.iter().product();
        let mut mesh = Topology {
            k: lattice.k,
            size,
            ghost_layers,
            layout: rows,
            range,
            region,
            boundary: lattice.boundary,
            pores: Vec::new(),
            faces: Vec::new(),
            codes: Vec::new(),
            at_sides: Vec::with_capacity(cells),
            pore_start: Vec::with_capacity(cells + 1),
            face_start: Vec::with_capacity(3 * cells + 1),
            pore_faces: Vec::new(),
            pore_face_start: Vec::new(),
            inner: Region::new([0; 3], false),
        };
        let k3 = mesh.k.pow(3);
        let code = |i: usize| mesh.lattice_code(lattice, i / k3, mesh.voxel(i % k3));
        mesh.codes = (0..k3 * cells).into_par_iter().map(code).collect();
        for cell in 0..cells {
            let indices = mesh.cell_indices(cell);
            let sides =
                |a: usize| u8::from(indices[a] == 0) | u8::from(indices[a] + 1 == size[a]) << 1;
            mesh.at_sides
                .push((0..3).map(|a| sides(a) << (2 * a)).sum());
            mesh.pore_start.push(mesh.pores.len() as u32);
            let (open, row) = (mesh.open_voxels(cell), mesh.row(cell) as u32);
            mesh.pores
                .extend(connected(open, mesh.k).map(|voxels| Pore {
                    cell: cell as u32,
                    row,
                    voxels,
                }));
        }
        mesh.pore_start.push(mesh.pores.len() as u32);
        for cell in 0..cells {
            for axis in 0..3 {
                mesh.face_start.push(mesh.faces.len() as u32);
                if lattice.flat && axis == 2 {
                    continue;
                }
                if let Some(next) = mesh.next_cell(cell, axis, true) {
                    mesh.join(cell, next, axis);
                }
            }
        }
        mesh.face_start.push(mesh.faces.len() as u32);
        mesh.list_pore_faces();
        mesh.inner = mesh.inner_cells();
        mesh.pores.shrink_to_fit();
        mesh.faces.shrink_to_fit();
        Self {
            topology: Arc::new(mesh),
            measures: Measures::new(rows),
        }
    }
}

impl Topology {
    /// Fills `pore_faces` and `pore_face_start`.
    fn list_pore_faces(&mut self) {
        self.pore_faces.reserve_exact(2 * self.faces.len());
        self.pore_face_start.reserve_exact(6 * self.pores.len() + 1);
        for pore in 0..self.pores.len() {
            let cell = self.pores[pore].cell as usize;
            for axis in 0..3 {
                for up in [false, true] {
                    self.pore_face_start.push(self.pore_faces.len() as u32);
                    let range = match up {
                        true => self.faces_of(cell, axis),
                        false => (self.next_cell(cell, axis, false))
                            .map_or(0..0, |low| self.faces_of(low, axis)),
                    };
                    for face in range {
                        let f = self.faces[face];
                        if (if up { f.low } else { f.high }) as usize == pore {
                            self.pore_faces.push(face as u32);
                        }
                    }
                }
            }
        }
        self.pore_face_start.push(self.pore_faces.len() as u32);
    }

    /// Adds the faces between the pores of two neighbouring cells.
    fn join(&mut self, low: usize, high: usize, axis: usize) {
        for l in self.pores_of(low) {
            for h in self.pores_of(high) {
                let from = self.side(self.pores[l].voxels, axis, true);
                let to = self.side(self.pores[h].voxels, axis, false);
                if from & to != 0 {
                    self.faces.push(Face {
                        low: l as u32,
                        high: h as u32,
                        open: from & to,
                        axis: axis as u8,
                    });
                }
            }
        }
    }

    /// Position in its cell of the voxel of a mask bit.
    pub(crate) fn voxel(&self, bit: usize) -> [usize; 3] {
        match self.k {
            1 => [0; 3],
            _ => [bit & 1, bit >> 1 & 1, bit >> 2],
        }
    }

    /// Mask of the voxels at the high or low side of a cell along an axis, over the two tangential axes, the lower fastest.
    fn side(&self, voxels: u8, axis: usize, high: bool) -> u8 {
        let k = self.k;
        let mut side = 0;
        for bit in 0..k * k * k {
            let at = self.voxel(bit);
            if voxels >> bit & 1 == 1 && at[axis] == if high { k - 1 } else { 0 } {
                let [s, t] = others(axis);
                side |= 1 << (at[s] + k * at[t]);
            }
        }
        side
    }

    /// Indices of a cell in the box: x, row of the mesh, z.
    pub(crate) fn cell_indices(&self, cell: usize) -> [usize; 3] {
        let [nx, ny, _] = self.size;
        [cell % nx, cell / nx % ny, cell / (nx * ny)]
    }

    pub(crate) fn cell_at(&self, [x, y, z]: [usize; 3]) -> usize {
        x + self.size[0] * (y + self.size[1] * z)
    }

    /// Row of the grid of a cell.
    pub(crate) fn row(&self, cell: usize) -> usize {
        self.cell_indices(cell)[1] + self.range.start
    }

    /// Row of the grid of a pore.
    pub(crate) fn row_of(&self, pore: usize) -> usize {
        self.pores[pore].row as usize
    }

    /// The next cell along an axis, across periodic sides too; `None` at other sides of the box.
    pub(crate) fn next_cell(&self, cell: usize, axis: usize, up: bool) -> Option<usize> {
        let [nx, ny, _] = self.size;
        let (n, stride) = (self.size[axis], [1, nx, nx * ny][axis]);
        let at_side = self.at_sides[cell] >> (2 * axis + usize::from(up)) & 1 == 1;
        match (at_side, up) {
            (false, true) => Some(cell + stride),
            (false, false) => Some(cell - stride),
            _ if !self.periodic()[axis] => None,
            (true, true) => Some(cell - (n - 1) * stride),
            (true, false) => Some(cell + (n - 1) * stride),
        }
    }

    /// Which axes are periodic in this mesh; y only if the mesh has all rows.
    pub(crate) fn periodic(&self) -> [bool; 3] {
        let whole = self.range.len() == self.layout.len();
        let complete = [true, whole, true];
        std::array::from_fn(|axis| complete[axis] && self.boundary[axis] == Boundary::Periodic)
    }

    /// Pores of a cell.
    pub(crate) fn pores_of(&self, cell: usize) -> Range<usize> {
        self.pore_start[cell] as usize..self.pore_start[cell + 1] as usize
    }

    /// Faces from a cell towards its next cell along an axis.
    pub(crate) fn faces_of(&self, cell: usize, axis: usize) -> Range<usize> {
        let at = 3 * cell + axis;
        self.face_start[at] as usize..self.face_start[at + 1] as usize
    }

    /// Faces of a pore on its high (`up`) or low side along an axis.
    pub(crate) fn faces_at(
        &self,
        pore: usize,
        axis: usize,
        up: bool,
    ) -> impl ExactSizeIterator<Item = usize> + Clone {
        let at = 6 * pore + 2 * axis + usize::from(up);
        let range = self.pore_face_start[at] as usize..self.pore_face_start[at + 1] as usize;
        self.pore_faces[range].iter().map(|&face| face as usize)
    }

    /// The neighbours of a pore: along x, y, z, low side first.
    pub(crate) fn neighbours(&self, pore: usize) -> impl Iterator<Item = Neighbour> {
        (0..6).flat_map(move |side| {
            let (axis, up) = (side / 2, side % 2 == 1);
            self.faces_at(pore, axis, up).map(move |face| Neighbour {
                face,
                axis,
                up,
                pore: self.faces[face].pores()[usize::from(up)],
            })
        })
    }

    /// Sum of the fluxes through the faces of a pore, those into it negative.
    pub(crate) fn net_outflow(&self, pore: usize, flux: impl Fn(usize) -> f64) -> f64 {
        let neighbours = self.neighbours(pore);
        neighbours.map(|at| at.sign() * flux(at.face)).sum()
    }

    /// The sets of connected pores for which `within` holds.
    pub(crate) fn components(&self, within: impl Fn(usize) -> bool) -> Vec<Vec<u32>> {
        let (mut found, mut sets) = (vec![false; self.pores.len()], Vec::new());
        for first in (0..found.len()).filter(|&pore| within(pore)) {
            if std::mem::replace(&mut found[first], true) {
                continue;
            }
            let (mut pores, mut next) = (vec![first as u32], 0);
            while let Some(&pore) = pores.get(next) {
                next += 1;
                for Neighbour { pore: beside, .. } in self.neighbours(pore as usize) {
                    if within(beside) && !std::mem::replace(&mut found[beside], true) {
                        pores.push(beside as u32);
                    }
                }
            }
            sets.push(pores);
        }
        sets
    }

    /// Cell of a pore.
    pub(crate) fn cell(&self, pore: usize) -> usize {
        self.pores[pore].cell as usize
    }

    /// Whether a face has a pore in the gap or in a row next to it.
    pub(crate) fn touches_gap(&self, face: usize) -> bool {
        let [low, high] = self.faces[face].pores().map(|pore| self.row_of(pore));
        let rows = self.layout;
        let gap = rows.below..rows.below + rows.gap + 1;
        gap.contains(&high) || gap.contains(&(low + 1))
    }

    /// The pore of a cell to which a voxel belongs.
    pub(crate) fn pore_at(&self, cell: usize, voxel: [usize; 3]) -> Option<usize> {
        self.pores_of(cell)
            .find(|&pore| self.has_voxel(pore, voxel))
    }

    /// The face between two pores that are neighbours along an axis.
    pub(crate) fn face_between(&self, low: usize, high: usize, axis: usize) -> Option<usize> {
        (self.faces_of(self.cell(low), axis)).find(|&face| self.faces[face].pores() == [low, high])
    }

    /// Whether a cell is a ghost cell, beyond an open side.
    pub(crate) fn is_ghost(&self, cell: usize) -> bool {
        if !self.boundary.contains(&Boundary::Open) {
            return false;
        }
        let indices = self.cell_indices(cell);
        let across = |a: usize| {
            self.ghost_layers[a] == 1 && (indices[a] == 0 || indices[a] + 1 == self.size[a])
        };
        let row = indices[1] + self.range.start;
        let along =
            self.boundary[1] == Boundary::Open && (row == 0 || row + 1 == self.layout.len());
        along || across(0) || across(2)
    }
}

/// The two other axes, the lower first.
pub(crate) fn others(axis: usize) -> [usize; 2] {
    [usize::from(axis == 0), 2 - usize::from(axis == 2)]
}

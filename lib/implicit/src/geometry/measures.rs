//! Measures of a mesh: heights of its rows, volumes of pores, areas of faces, with the gap as high as it is.

use super::lattice::Lattice;
use super::mesh::{Mesh, Pore};
use super::rows::Rows;

/// Heights of rows, cells.
pub(super) struct Measures {
    rows: Rows,
    /// Of each row of the grid: its own, and that of the lowest row there or beside it, a cell at most.
    heights: Vec<[f64; 2]>,
}

impl Measures {
    pub(super) fn new(rows: Rows) -> Self {
        let height = |row: usize| rows.height_of(row);
        let lowest = |row: usize| {
            let near = row.saturating_sub(1)..(row + 2).min(rows.len());
            near.map(height).fold(1.0, f64::min)
        };
        let heights = (0..rows.len()).map(|row| [height(row), lowest(row)]);
        Self {
            heights: heights.collect(),
            rows,
        }
    }
}

impl Mesh {
    /// Numbers of rows, and the height of the gap.
    pub(crate) fn rows(&self) -> &Rows {
        &self.measures.rows
    }

    /// Makes the gap as high as this, cells.
    pub(crate) fn set_height(&mut self, height: f64) {
        self.measures = Measures::new(Rows {
            height,
            ..*self.rows()
        });
    }

    /// Height of the cell of a pore, cells.
    pub(crate) fn height(&self, pore: usize) -> f64 {
        self.measures.heights[self.row_of(pore)][0]
    }

    /// Height of the lowest row at a pore or beside it, a cell at most: the film in a gap that closes knows of edges no farther
    /// than it is high.
    pub(crate) fn lowest_row(&self, pore: usize) -> f64 {
        self.measures.heights[self.row_of(pore)][1]
    }

    /// Edge of the cell of a pore along an axis, cells.
    pub(crate) fn edge(&self, pore: usize, axis: usize) -> f64 {
        if axis == 1 { self.height(pore) } else { 1.0 }
    }

    /// Edge of a cell along an axis, cells.
    pub(crate) fn cell_edge(&self, cell: usize, axis: usize) -> f64 {
        match axis {
            1 => self.measures.heights[self.row(cell)][0],
            _ => 1.0,
        }
    }

    /// Volume of a pore, cells.
    pub(crate) fn volume(&self, pore: usize) -> f64 {
        self.cell_fraction(pore) * self.height(pore)
    }

    /// The same with a gap of another height.
    pub(crate) fn volume_at(&self, pore: usize, height: f64) -> f64 {
        let rows = Rows {
            height,
            ..*self.rows()
        };
        self.cell_fraction(pore) * rows.height_of(self.row_of(pore))
    }

    /// Part of its cell that a pore fills.
    fn cell_fraction(&self, pore: usize) -> f64 {
        let Pore { voxels, .. } = self.pores[pore];
        f64::from(voxels.count_ones()) / (self.k * self.k * self.k) as f64
    }

    /// Area of a face, cells.
    pub(crate) fn area(&self, face: usize) -> f64 {
        let face = &self.faces[face];
        let part = f64::from(face.open.count_ones()) / (self.k * self.k) as f64;
        match face.axis {
            1 => part,
            _ => part * self.height(face.low as usize),
        }
    }

    /// Part of the area of all faces of a pore on one side that one of them has.
    pub(crate) fn area_share(&self, face: usize, pore: usize, axis: usize, up: bool) -> f64 {
        let side = self.faces_at(pore, axis, up);
        match side.len() {
            1 => 1.0,
            _ => self.area(face) / side.map(|face| self.area(face)).sum::<f64>(),
        }
    }

    /// Velocity of the grid along y at a face over the closing speed; of faces across y alone.
    pub(crate) fn grid_velocity(&self, lattice: &Lattice, face: usize) -> f64 {
        let row = self.row_of(self.faces[face].ends()[1]);
        lattice.grid_speed(self.rows().closing_share(row))
    }
}

//! Measures of a mesh at its current gap height: row heights, pore volumes, face areas.

use super::lattice::Lattice;
use super::mesh::Mesh;
use super::pore::Pore;
use super::rows::Rows;

/// Row heights, cells.
#[derive(Clone)]
pub(super) struct Measures {
    rows: Rows,
    /// Of each row of the grid: its height, and the least of one cell and the heights of it and its two neighbours.
    heights: Vec<[f64; 2]>,
}

impl Measures {
    pub(super) fn new(rows: Rows) -> Self {
        let height = |row: usize| rows.height_of(row);
        let lowest = |row: usize| {
            let around = row.saturating_sub(1)..(row + 2).min(rows.len());
            around.map(height).fold(1.0, f64::min)
        };
        let heights = (0..rows.len()).map(|row| [height(row), lowest(row)]);
        Self {
            heights: heights.collect(),
            rows,
        }
    }
}

impl Mesh {
    /// Row counts and the height of the gap.
    pub(crate) fn rows(&self) -> &Rows {
        &self.measures.rows
    }

    /// This mesh with a gap of another height, cells.
    pub(crate) fn at_height(&self, height: f64) -> Self {
        Self {
            measures: Measures::new(Rows {
                height,
                ..*self.rows()
            }),
            topology: self.topology.clone(),
        }
    }

    /// Height of the cell of a pore, cells.
    pub(crate) fn height(&self, pore: usize) -> f64 {
        self.measures.heights[self.row_of(pore)][0]
    }

    /// Least height of the pore's row and its two neighbours, at most one cell. It scales the re-entrant correction: in a
    /// thin film an edge acts no farther than the film is high.
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

    /// Volume of a pore, cells, if the gap had another `height`.
    pub(crate) fn volume_at(&self, pore: usize, height: f64) -> f64 {
        let rows = Rows {
            height,
            ..*self.rows()
        };
        self.cell_fraction(pore) * rows.height_of(self.row_of(pore))
    }

    /// Volume of a pore over that of its cell.
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

    /// Area of `face` over that of all faces on the same side of `pore`.
    pub(crate) fn area_share(&self, face: usize, pore: usize, axis: usize, up: bool) -> f64 {
        let side = self.faces_at(pore, axis, up);
        match side.len() {
            1 => 1.0,
            _ => self.area(face) / side.map(|face| self.area(face)).sum::<f64>(),
        }
    }

    /// Velocity of the grid along y at a face normal to y, per unit of closing speed.
    pub(crate) fn grid_velocity(&self, lattice: &Lattice, face: usize) -> f64 {
        let row = self.row_of(self.faces[face].pores()[1]);
        lattice.grid_speed(self.rows().closing_share(row))
    }
}

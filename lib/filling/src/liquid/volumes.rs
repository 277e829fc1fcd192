//! Liquid volumes of cells and of the control volumes of faces.

use rayon::prelude::*;

use super::rolling;
use crate::geometry::Lattice;

/// How much liquid the cells and control volumes of a window hold.
#[derive(Clone, Debug)]
pub(crate) struct Volumes<'a> {
    /// Liquid fraction of the open part of each sub-cell, 0 to 1.
    pub(crate) phi: &'a [f32],
    /// Liquid volume of each cell, in cells.
    pub(crate) cell: Vec<f32>,
    /// Liquid fraction of the open part of each cell.
    pub(crate) fraction: Vec<f32>,
    /// Density that each full cell behind a front lacks; empty where none does.
    lack: &'a [f32],
}

impl<'a> Volumes<'a> {
    /// Cell volumes and fractions from the sub-cells'.
    pub(crate) fn new(lattice: &Lattice, phi: &'a [f32]) -> Self {
        let window = &lattice.window;
        let (mut volume, mut fraction) = (vec![0.0; window.len()], vec![0.0; window.len()]);
        let row = window.cells[0];
        (volume.par_chunks_mut(row).zip(fraction.par_chunks_mut(row)))
            .enumerate()
            .for_each(|(r, (volume, fraction))| {
                let (j, k) = (r % window.cells[1], r / window.cells[1]);
                for i in 0..row {
                    let first = window.first_sub([i, j, k]);
                    let parts = [2, 2, window.parts(2)];
                    let (wet, open) = fill(lattice, phi, first, parts);
                    volume[i] = (wet / window.sub_per_cell() as f64) as f32;
                    fraction[i] = if open > 1e-6 {
                        (wet / open) as f32
                    } else {
                        0.0
                    };
                }
            });
        Self {
            phi,
            cell: volume,
            fraction,
            lack: &[],
        }
    }

    /// The same, of cells that lack these densities.
    pub(crate) fn lacking(self, lack: &'a [f32]) -> Self {
        Self { lack, ..self }
    }

    /// Volume (cells) that a full cell lacks behind a front.
    pub(crate) fn lack(&self, cell: usize) -> f32 {
        self.lack
            .get(cell)
            .map_or(0.0, |lack| lack * self.cell[cell])
    }

    /// Part of the wet walls of a cell that its liquid touches.
    pub(crate) fn touching(&self, cell: usize) -> f32 {
        self.lack
            .get(cell)
            .map_or(1.0, |&lack| rolling::touching(lack))
    }

    /// Liquid and open volume (sub-cells) of the block of `parts` sub-cells from `first` on.
    pub(crate) fn of_block(
        &self,
        lattice: &Lattice,
        first: usize,
        parts: [usize; 3],
    ) -> (f64, f64) {
        fill(lattice, self.phi, first, parts)
    }

    /// Liquid volume and open volume, in cells, of the control volume of a face: half of each of
    /// the two cells at it.
    pub(crate) fn of_face(&self, lattice: &Lattice, axis: usize, cell: [usize; 3]) -> (f64, f64) {
        let window = &lattice.window;
        let first = window.first_sub(cell) - window.sub_stride(axis);
        let (wet, open) = self.of_block(lattice, first, [2, 2, window.parts(2)]);
        let whole = window.sub_per_cell() as f64;
        (wet / whole, open / whole)
    }
}

/// Sums of phi o and of o over a block of sub-cells.
fn fill(lattice: &Lattice, phi: &[f32], first: usize, parts: [usize; 3]) -> (f64, f64) {
    let (mut wet, mut open) = (0.0, 0.0);
    for z in 0..parts[2] {
        for y in 0..parts[1] {
            let row = first + y * lattice.window.sub_stride(1) + z * lattice.window.sub_stride(2);
            let range = row..row + parts[0];
            for (&o, &phi) in lattice.open[range.clone()].iter().zip(&phi[range]) {
                open += f64::from(o);
                wet += f64::from(o) * f64::from(phi);
            }
        }
    }
    (wet, open)
}

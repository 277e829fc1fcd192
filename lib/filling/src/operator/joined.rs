//! Cells that have no pressure of their own.
//!
//! Where a wall through the centres of faces meets a surface that moves towards it, the cell in
//! the corner is small, and closed but for at most one face near whose centre a wall lies. What
//! the surface presses out of it has no way, or one in the layer at a wall where velocities are
//! small: its pressure would not act on the surface, or be several times that of its neighbours.
//! Such a cell shares the pressure of a neighbour; what it gives flows on from there.

use super::dofs::{Dofs, NONE};
use crate::lattice::Lattice;
use crate::solids::OPEN;

/// Open volume, in cells, from which a cell has a pressure of its own.
const SMALL: f64 = 0.5;
/// Open area, in cells^2, by which cells hang together.
const CONTACT: f64 = 1e-4;

/// Whether the cell of index `index`, which is inner, is small and has no open face, or one that
/// walls cover in part.
pub(super) fn is_small(lattice: &Lattice, index: usize) -> bool {
    let window = &lattice.window;
    if lattice.cell_open(window.coordinates(index)) > SMALL - CONTACT {
        return false;
    }
    let faces = (0..window.domain.axes).flat_map(|a| [(a, index), (a, index + window.stride(a))]);
    let mut open = faces.filter(|&(a, i)| lattice.face(a, i) == OPEN);
    match (open.next(), open.next()) {
        (None, _) => true,
        (Some((axis, face)), None) => open_area(lattice, axis, face) < 1.0 - CONTACT,
        _ => false,
    }
}

/// Area of a face that no wall covers.
fn open_area(lattice: &Lattice, axis: usize, face: usize) -> f64 {
    let cell = lattice.window.coordinates(face);
    (0..lattice.column_count())
        .map(|quadrant| lattice.quadrant_open(axis, cell, quadrant))
        .sum()
}

impl Dofs {
    /// The pressure of the neighbour with which a cell has most open area in common.
    pub(super) fn neighbour(&self, lattice: &Lattice, index: usize) -> Option<u32> {
        let window = &lattice.window;
        let sides = (0..window.domain.axes).flat_map(|axis| {
            let step = window.stride(axis);
            [
                (axis, index, index - step),
                (axis, index + step, index + step),
            ]
        });
        let mut best = (CONTACT, None);
        for (axis, face, beyond) in sides {
            let cell = self.cell[window.index(window.home(window.coordinates(beyond)))];
            if cell == NONE {
                continue;
            }
            let area = open_area(lattice, axis, face);
            if area > best.0 {
                best = (area, Some(cell));
            }
        }
        best.1
    }
}

//! The areas of faces, and the flux out of a cell: which velocities carry it, and how much.

use rayon::prelude::*;

use super::dofs::NONE;
use super::sparse::Sparse;
use super::terms::Velocity;
use super::{CHUNK, Operator};
use crate::geometry::Aperture;

/// The areas of the faces along each axis that are unknowns or at a pressure unknown.
pub(super) struct Areas([Sparse<Aperture>; 3]);

impl Areas {
    pub(super) fn new(operator: &Operator) -> Self {
        let (lattice, dofs) = (operator.lattice, &operator.dofs);
        let window = &lattice.window;
        Self([0, 1, 2].map(|axis| {
            let has_pressure = |cell: Option<usize>| cell.is_some_and(|c| dofs.cell[c] != NONE);
            let find = |index: usize| {
                let cell = window.coordinates(index);
                let counts = dofs.face[axis][index] != NONE
                    || has_pressure(Some(index))
                    || has_pressure(index.checked_sub(window.stride(axis)));
                (counts && window.inner(cell)).then(|| lattice.aperture(axis, cell))
            };
            let len = if axis < window.domain.axes {
                window.len()
            } else {
                0
            };
            Sparse::new(len, Aperture::WHOLE, find)
        }))
    }

    /// Those of a face, where it is one of them.
    pub(super) fn at(&self, axis: usize, face: usize) -> Option<&Aperture> {
        self.0[axis].at(face)
    }
}

impl Operator<'_> {
    /// Liquid volume (cells) that moves with each face unknown: of its control volume, and of the
    /// slivers merged into its area.
    pub(super) fn face_volumes(&self, areas: &Areas) -> Vec<f64> {
        (self.dofs.faces.par_iter().with_min_len(CHUNK))
            .map(|&(axis, index)| {
                let (axis, index) = (usize::from(axis), index as usize);
                let cell = self.lattice.window.coordinates(index);
                let (wet, open) = self.volumes.of_face(self.lattice, axis, cell);
                let merged = areas.0[axis].at(index).map_or(0.0, |area| area.merged);
                wet + if open > 0.0 { merged * wet / open } else { 0.0 }
            })
            .collect()
    }

    /// Calls `each(velocity, area)` for every velocity in the liquid flux out of pressure
    /// unknown `cell`, Phi = sum area x velocity, weighted by its liquid fraction.
    pub(super) fn flux(&self, areas: &Areas, cell: usize, mut each: impl FnMut(Velocity, f64)) {
        let index = self.dofs.cells[cell] as usize;
        let window = &self.lattice.window;
        let fraction = f64::from(self.volumes.fraction[index]);
        for axis in 0..window.domain.axes {
            for (sign, face) in [(-1.0, index), (1.0, index + window.stride(axis))] {
                let Some(velocity) = self.velocity(axis, face) else {
                    continue;
                };
                let Some(aperture) = areas.0[axis].at(face) else {
                    continue;
                };
                let weight = sign * fraction;
                if let Velocity::Face(_) = velocity {
                    each(velocity, weight * aperture.open);
                }
                for &(body, area) in aperture.bodies.iter().filter(|b| b.1 != 0.0) {
                    each(Velocity::of_body(body, axis), weight * area);
                }
            }
        }
    }
}

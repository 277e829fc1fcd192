//! Stretching of the pores on the two sides of a face.

use crate::geometry::{Mesh, RowKind};

/// A velocity that pulls at a face with a weight; the wall ahead has none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct StretchTerm {
    /// The other face; `None` for the wall ahead.
    pub(crate) other: Option<usize>,
    pub(crate) weight: f64,
    /// Difference of velocities across the pore that the closing of its row makes, per closing speed, seen from this face.
    pub(crate) closing: f64,
}

/// Pulls at `face` of the stretching of the pore on its high (`up`) or low side, per viscosity and liquid fraction.
pub(crate) fn stretching(mesh: &Mesh, face: usize, up: bool, mut add: impl FnMut(StretchTerm)) {
    let f = mesh.faces[face];
    let axis = usize::from(f.axis);
    let pore = f.ends()[usize::from(up)];
    let edge = mesh.edge(pore, axis);
    let weight = 2.0 * mesh.volume(pore) / (edge * edge);
    let own = mesh.area_share(face, pore, axis, !up);
    let closing = match (axis, mesh.rows().kind(mesh.row_of(pore))) {
        (1, RowKind::Gap) => 1.0 / mesh.rows().gap as f64,
        _ => 0.0,
    };
    // The high side moves against the low one by the closing.
    let closing = if up { -closing } else { closing };
    let ahead = mesh.faces_at(pore, axis, up);
    if ahead.len() == 0 {
        // Half an edge at least: behind each open voxel face is a voxel.
        let distance = (mesh.volume(pore) / mesh.area(face) / edge).min(1.0);
        add(StretchTerm {
            other: None,
            weight: weight * own / (distance * distance),
            closing,
        });
        return;
    }
    for other in ahead {
        add(StretchTerm {
            other: Some(other),
            weight: weight * own * mesh.area_share(other, pore, axis, up),
            closing,
        });
    }
}

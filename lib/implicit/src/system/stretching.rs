//! Viscous normal stress: stretching of the pores on the two sides of a face (docs/methods.md section 3.4).

use crate::geometry::{Mesh, RowKind};

/// A term of the stretching of a pore: the weight of the difference between the velocities of a face and of the opposite
/// face or wall.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct StretchTerm {
    /// The opposite face; `None` for a wall.
    pub(crate) other: Option<usize>,
    pub(crate) weight: f64,
    /// Velocity difference across the pore by the closing of its row, per closing speed, with the sign as seen from this face.
    pub(crate) closing: f64,
}

/// Visits the terms of the stretching of the pore on the high (`up`) or low side of `face`, per viscosity and liquid fraction.
pub(crate) fn stretching(mesh: &Mesh, face: usize, up: bool, mut add: impl FnMut(StretchTerm)) {
    let f = mesh.faces[face];
    let axis = usize::from(f.axis);
    let pore = f.pores()[usize::from(up)];
    let edge = mesh.edge(pore, axis);
    let weight = 2.0 * mesh.volume(pore) / (edge * edge);
    let own = mesh.area_share(face, pore, axis, !up);
    let closing = match (axis, mesh.rows().kind(mesh.row_of(pore))) {
        (1, RowKind::Gap) => 1.0 / mesh.rows().gap as f64,
        _ => 0.0,
    };
    // The high side of the pore approaches the low one.
    let closing = if up { -closing } else { closing };
    let ahead = mesh.faces_at(pore, axis, up);
    if ahead.len() == 0 {
        // At least half an edge: a voxel lies behind each open voxel face.
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

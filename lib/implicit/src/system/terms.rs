//! Terms of the momentum of a face: stretching of the pores on its two sides, shear between it and the faces beside it.

use crate::geometry::{Kind, Mesh, others};

/// Nearest that a wall ahead counts, in edges of the cell.
const NEAREST: f64 = 0.3;

/// A velocity that pulls at a face with a weight; the wall ahead has none.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pull {
    /// The other face; `None` for the wall ahead.
    pub(crate) other: Option<usize>,
    pub(crate) weight: f64,
    /// Difference of velocities across the pore that the closing of its row makes, per closing speed, seen from this face.
    pub(crate) closing: f64,
}

/// Pulls at `face` of the stretching of the pore on its high (`up`) or low side, per viscosity and liquid fraction.
pub(crate) fn stretching(mesh: &Mesh, face: usize, up: bool, mut add: impl FnMut(Pull)) {
    let f = mesh.faces[face];
    let axis = usize::from(f.axis);
    let pore = if up { f.high } else { f.low } as usize;
    let cell = mesh.pores[pore].cell as usize;
    let edge = mesh.edges(cell)[axis];
    let weight = 2.0 * mesh.volume(pore) / (edge * edge);
    let area = |up: bool| {
        mesh.faces_at(pore, axis, up)
            .map(|face| mesh.area(face))
            .sum::<f64>()
    };
    let own = mesh.area(face) / area(!up);
    let closing = match (axis, mesh.rows.kind(mesh.row(cell))) {
        (1, Kind::Gap) => 1.0 / mesh.rows.gap as f64,
        _ => 0.0,
    };
    // The high side moves against the low one by the closing.
    let closing = if up { -closing } else { closing };
    let ahead = area(up);
    if ahead == 0.0 {
        let distance = (mesh.volume(pore) / mesh.area(face) / edge).clamp(NEAREST, 1.0);
        add(Pull {
            other: None,
            weight: weight * own / (distance * distance),
            closing,
        });
        return;
    }
    for other in mesh.faces_at(pore, axis, up) {
        add(Pull {
            other: Some(other),
            weight: weight * own * mesh.area(other) / ahead,
            closing,
        });
    }
}

/// An edge that a face shares with the next face across.
pub(crate) struct Edge {
    /// The next face.
    pub(crate) next: usize,
    /// The faces across, between the low pores of both and between the high pores of both.
    pub(crate) across: [usize; 2],
    /// Whether the next face lies on the high side.
    pub(crate) up: bool,
    /// Area over distance between the two faces, and length of the edge.
    pub(crate) shear: f64,
    pub(crate) length: f64,
}

/// The edges of `face` with faces of the same axis.
pub(crate) fn edges(mesh: &Mesh, face: usize, flat: bool, mut add: impl FnMut(Edge)) {
    let axis = usize::from(mesh.faces[face].axis);
    for t in others(axis) {
        if flat && t == 2 {
            continue;
        }
        for up in [false, true] {
            for r in 0..mesh.k {
                if let Some(edge) = edge(mesh, face, t, up, r) {
                    add(edge);
                }
            }
        }
    }
}

fn edge(mesh: &Mesh, face: usize, t: usize, up: bool, r: usize) -> Option<Edge> {
    let k = mesh.k;
    let f = mesh.faces[face];
    let axis = usize::from(f.axis);
    let across = 3 - axis - t;
    let [s, q] = others(axis);
    let bit = |i: usize| {
        let mut at = [0; 3];
        (at[t], at[across]) = (i, r);
        at[s] + k * at[q]
    };
    let height = |face: usize, end: usize| {
        let open = mesh.faces[face].open;
        if open >> bit(end) & 1 == 0 {
            return 0.0;
        }
        (0..k).filter(|&i| open >> bit(i) & 1 == 1).count() as f64 / k as f64
    };
    let (near, far) = if up { (k - 1, 0) } else { (0, k - 1) };
    let own = height(face, near);
    if own == 0.0 {
        return None;
    }
    let ends = [f.low, f.high].map(|pore| pore as usize);
    let cells = ends.map(|pore| mesh.pores[pore].cell as usize);
    let beside = [
        mesh.neighbour(cells[0], t, up)?,
        mesh.neighbour(cells[1], t, up)?,
    ];
    let voxel = |half: usize| {
        let mut at = [0; 3];
        (at[axis], at[t], at[across]) = (if half == 0 { k - 1 } else { 0 }, far, r);
        at
    };
    let low = mesh.pore_with(beside[0], voxel(0))?;
    let high = mesh.pore_with(beside[1], voxel(1))?;
    let next = mesh.face_between(low, high, axis)?;
    let joined = |near: usize, far: usize| match up {
        true => mesh.face_between(near, far, t),
        false => mesh.face_between(far, near, t),
    };
    let sizes = [cells[0], cells[1], beside[0]].map(|cell| mesh.edges(cell));
    let distance = 0.5 * (own * sizes[0][t] + height(next, far) * sizes[2][t]);
    let length = sizes[0][across] / k as f64;
    Some(Edge {
        next,
        across: [joined(ends[0], low)?, joined(ends[1], high)?],
        up,
        shear: length * 0.5 * (sizes[0][axis] + sizes[1][axis]) / distance,
        length,
    })
}

//! Absorbing walls: the wall area of each pore.
//!
//! An inclined wall of voxels is a staircase, up to sqrt 2 times as long as the smooth wall. So each voxel face counts with
//! the cosine between its normal and the direction to the centre of the open space around it.

use physics::Boundary;
use rayon::prelude::*;

use crate::geometry::{Lattice, MIRROR, Mesh, OPEN};

/// Radius around a voxel face that decides its inclination, cells: a tube of six cells is then 2 % too large. A larger radius
/// rounds corners, a smaller one sees single steps.
const RADIUS: f64 = 1.3;

/// Absorbing wall area of each pore, cells: that normal to y, and that parallel to y per row height.
pub(crate) struct AbsorbingWalls(Vec<[f64; 2]>);

impl AbsorbingWalls {
    /// The walls of bodies that `take` water.
    pub(crate) fn new(lattice: &Lattice, mesh: &Mesh, take: &[bool]) -> Self {
        let takes = |code: u8| code != OPEN && code != MIRROR && take[usize::from(code - 1)];
        let areas = |pore: usize| {
            let (cell, mut areas) = (mesh.cell(pore), [0.0; 2]);
            for voxel in mesh.voxels(pore) {
                for (axis, up) in (0..3).flat_map(|axis| [(axis, false), (axis, true)]) {
                    let beyond = mesh.next_voxel(cell, voxel, axis, up);
                    let code = beyond.map_or(MIRROR, |(cell, at)| mesh.code(cell, at));
                    if !(lattice.flat && axis == 2) && takes(code) {
                        let part = 1.0 / (mesh.k * mesh.k) as f64;
                        areas[usize::from(axis != 1)] +=
                            part * inclination(lattice, mesh, cell, voxel, axis, up);
                    }
                }
            }
            areas
        };
        Self((0..mesh.pores.len()).into_par_iter().map(areas).collect())
    }

    /// Absorbing wall area of a pore, cells.
    pub(crate) fn area(&self, mesh: &Mesh, pore: usize) -> f64 {
        let [across, along] = self.0[pore];
        across + mesh.height(pore) * along
    }
}

/// Cosine between the normal of a voxel face and the direction to the centre of the open space around it.
fn inclination(
    lattice: &Lattice,
    mesh: &Mesh,
    cell: usize,
    voxel: [usize; 3],
    axis: usize,
    up: bool,
) -> f64 {
    let k = mesh.k as i64;
    let [x, _, z] = mesh.cell_indices(cell);
    let row = mesh.row(cell) as i64 - mesh.rows().below as i64;
    let cells = [
        x as i64 - mesh.ghost_layers[0] as i64,
        row,
        z as i64 - mesh.ghost_layers[2] as i64,
    ];
    let at: [i64; 3] = std::array::from_fn(|a| cells[a] * k + voxel[a] as i64);
    let radius = RADIUS * mesh.k as f64;
    let reach = (radius + 0.5) as i64;
    let deep = if lattice.flat { 0 } else { reach };
    let mut centroid = [0.0; 3];
    for dz in -deep..=deep {
        for dy in -reach..=reach {
            for dx in -reach..=reach {
                let offset = [dx, dy, dz];
                let mut from_face = offset.map(|d| d as f64);
                from_face[axis] += if up { -0.5 } else { 0.5 };
                let square = from_face.iter().map(|d| d * d).sum::<f64>();
                let weight = 1.0 - square / (radius * radius);
                let voxel_at = std::array::from_fn(|a| at[a] + offset[a]);
                if weight > 0.0 && is_open(lattice, mesh.rows().gap as i64 * k, voxel_at) {
                    (0..3).for_each(|a| centroid[a] += weight * from_face[a]);
                }
            }
        }
    }
    let length = centroid.iter().map(|d| d * d).sum::<f64>().sqrt();
    let inwards = if up { -centroid[axis] } else { centroid[axis] };
    (inwards / length).max(0.0)
}

/// Whether the voxel with the indices x, y (from the low side of a gap of `gap` layers), z is open; sides mirror or repeat.
fn is_open(lattice: &Lattice, gap: i64, [x, y, z]: [i64; 3]) -> bool {
    let [nx, nz] = lattice.layer_size().map(|n| n as i64);
    let (Some(x), Some(z)) = (
        within(x, nx, lattice.boundary[0]),
        within(z, nz, lattice.boundary[2]),
    ) else {
        return true;
    };
    let [below, between, above] = &lattice.layers;
    let low = below.len() as i64;
    let Some(y) = within(y + low, low + gap + above.len() as i64, lattice.boundary[1]) else {
        return true;
    };
    let layer = match y - low {
        y if y < 0 => &below[(-1 - y) as usize],
        y if y < gap => &between[0],
        y => &above[(y - gap) as usize],
    };
    layer[(x + nx * z) as usize] == OPEN
}

/// Index within 0..n of a voxel, mirrored or repeated beyond a side; `None` beyond an open one.
fn within(at: i64, n: i64, boundary: Boundary) -> Option<i64> {
    match boundary {
        _ if (0..n).contains(&at) => Some(at),
        Boundary::Open => None,
        Boundary::Periodic => Some(at.rem_euclid(n)),
        Boundary::Symmetry => {
            let at = at.rem_euclid(2 * n);
            Some(at.min(2 * n - 1 - at))
        }
    }
}

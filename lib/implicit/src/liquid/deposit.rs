//! Initial liquid: spreads the scene's points over the pores.

use physics::{Points, Seed};

use crate::geometry::Mesh;

/// Origin and cell size of the grid.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GridOrigin {
    /// Edge of a cell, m.
    pub(crate) cell_m: f64,
    /// Low side of the domain along x and z, and of the gap along y, m.
    pub(crate) origin_m: [f64; 3],
    /// Whether the domain is one cell deep.
    pub(crate) flat: bool,
}

impl GridOrigin {
    /// Half edges of a point of this volume, cells: a cube, in plane strain a square as deep as the domain.
    pub(crate) fn half(&self, volume_m3: f64) -> [f64; 3] {
        let volume = volume_m3 / self.cell_m.powi(3);
        match self.flat {
            true => [0.5 * volume.sqrt(), 0.5 * volume.sqrt(), 0.5],
            false => [0.5 * volume.cbrt(); 3],
        }
    }
}

/// Sum of `value` over the points in each pore. A point is a box of its volume, whose value is spread over the open voxels that
/// it overlaps.
///
/// # Errors
/// Where the centre of a point lies in a body or outside the domain.
pub(crate) fn deposit(
    mesh: &Mesh,
    points: &Points,
    origin: GridOrigin,
    value: impl Fn(&Seed) -> f64,
) -> Result<Vec<f64>, String> {
    let mut sums = vec![0.0; mesh.pores.len()];
    let sides = [0, 1, 2].map(|axis| sides(mesh, axis));
    for (index, point) in points.seeds().enumerate() {
        let at: [f64; 3] =
            std::array::from_fn(|a| (point.position[a] - origin.origin_m[a]) / origin.cell_m);
        let half = origin.half(point.volume);
        spread(mesh, &sides, at, half, value(&point), &mut sums).ok_or_else(|| {
            format!("liquid point {index} lies in a rigid body or outside the domain")
        })?;
    }
    Ok(sums)
}

/// Coordinates of the voxel faces of a mesh along an axis, cells from the origin.
fn sides(mesh: &Mesh, axis: usize) -> Vec<f64> {
    let k = mesh.k;
    let side = |i: usize| {
        let (cell, part) = (i / k, (i % k) as f64 / k as f64);
        match axis {
            1 => {
                let row = cell + mesh.range.start;
                mesh.rows().low(row) + part * mesh.rows().height_of(row)
            }
            _ => cell as f64 - mesh.ghost_layers[axis] as f64 + part,
        }
    };
    (0..=k * mesh.size[axis]).map(side).collect()
}

/// Spreads a value over the open voxels of a box around `at` (cells from the origin); `None` where `at` itself is in no open
/// voxel.
fn spread(
    mesh: &Mesh,
    sides: &[Vec<f64>; 3],
    at: [f64; 3],
    half: [f64; 3],
    value: f64,
    sums: &mut [f64],
) -> Option<()> {
    // Along an axis: voxel indices, the overlap of the box with each, and whether `at` is in it.
    let overlaps = |a: usize| -> Vec<(usize, f64, bool)> {
        let [low, high] = [at[a] - half[a], at[a] + half[a]];
        let first = sides[a]
            .partition_point(|side| *side <= low)
            .saturating_sub(1);
        let voxels = sides[a][first..].windows(2).enumerate();
        voxels
            .take_while(|(_, side)| side[0] < high)
            .filter(|(_, side)| side[1] > low)
            .map(|(i, side)| {
                let part = high.min(side[1]) - low.max(side[0]);
                (first + i, part, (side[0]..side[1]).contains(&at[a]))
            })
            .collect()
    };
    let overlaps = [overlaps(0), overlaps(1), overlaps(2)];
    let mut parts = Vec::new();
    let mut inside = false;
    for &(z, dz, at_z) in &overlaps[2] {
        for &(y, dy, at_y) in &overlaps[1] {
            for &(x, dx, at_x) in &overlaps[0] {
                let cell = mesh.cell_at([x, y, z].map(|i| i / mesh.k));
                if let Some(pore) = mesh.pore_at(cell, [x, y, z].map(|i| i % mesh.k)) {
                    parts.push((pore, dx * dy * dz));
                    inside |= at_x && at_y && at_z;
                }
            }
        }
    }
    let all: f64 = parts.iter().map(|part| part.1).sum();
    for (pore, part) in parts {
        sums[pore] += value * part / all;
    }
    inside.then_some(())
}

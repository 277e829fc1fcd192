//! Liquid at the start: what of it lies in each pore.

use physics::{Points, Seed};

use crate::geometry::Mesh;

/// Cells of a metre and the place of the grid's origin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    /// Edge of a cell, m.
    pub(crate) cell_m: f64,
    /// Low side of the domain along x and z, and of the gap along y, m.
    pub(crate) origin_m: [f64; 3],
    /// Depth of the domain where it is flat, cells.
    pub(crate) depth: Option<f64>,
}

/// Sums over `points` in each pore of a mesh of what `value` says of a point, each a cube of its volume.
///
/// # Errors
/// Where a point lies in a body or outside the domain.
pub(crate) fn deposit(
    mesh: &Mesh,
    points: &Points,
    place: Place,
    value: impl Fn(&Seed) -> f64,
) -> Result<Vec<f64>, String> {
    let mut sums = vec![0.0; mesh.pores.len()];
    for (index, point) in points.seeds().enumerate() {
        let volume = point.volume / place.cell_m.powi(3);
        let at: [f64; 3] =
            std::array::from_fn(|a| (point.position[a] - place.origin_m[a]) / place.cell_m);
        let half = match place.depth {
            Some(depth) => {
                let half = 0.5 * (volume / depth).sqrt();
                [half, half, 0.5 * depth]
            }
            None => [0.5 * volume.cbrt(); 3],
        };
        spread(mesh, at, half, value(&point), &mut sums).ok_or_else(|| {
            format!("liquid point {index} lies in a rigid body or outside the domain")
        })?;
    }
    Ok(sums)
}

/// Spreads a value over the open voxels in a box around a place, cells from the origin; `None` where the place is in none.
fn spread(mesh: &Mesh, at: [f64; 3], half: [f64; 3], value: f64, sums: &mut [f64]) -> Option<()> {
    let overlap = |a: usize, low: f64, high: f64| {
        (high.min(at[a] + half[a]) - low.max(at[a] - half[a])).max(0.0)
    };
    let near = |a: usize| -> Vec<(usize, f64, bool)> {
        let voxels = |cell: usize| match a {
            1 => {
                let row = cell + mesh.range.start;
                (mesh.rows().low(row), mesh.rows().height_of(row))
            }
            _ => (cell as f64 - mesh.beyond[a] as f64, 1.0),
        };
        (0..mesh.size[a] * mesh.k)
            .filter_map(|i| {
                let (low, height) = voxels(i / mesh.k);
                let edge = height / mesh.k as f64;
                let low = low + (i % mesh.k) as f64 * edge;
                let part = overlap(a, low, low + edge);
                (part > 0.0).then_some((i, part, (low..low + edge).contains(&at[a])))
            })
            .collect()
    };
    let sides = [near(0), near(1), near(2)];
    let mut parts = Vec::new();
    let mut inside = false;
    for &(z, dz, at_z) in &sides[2] {
        for &(y, dy, at_y) in &sides[1] {
            for &(x, dx, at_x) in &sides[0] {
                let cell = mesh.cell_at([x, y, z].map(|i| i / mesh.k));
                if let Some(pore) = mesh.pore_with(cell, [x, y, z].map(|i| i % mesh.k)) {
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

//! Velocities extrapolated a few cells into the air, for particles that reach it within a step.

use rayon::prelude::*;

use crate::geometry::{Lattice, OPEN};
use crate::system::NONE;

/// Layers of faces that get a velocity; no particle moves two cells in a step.
const LAYERS: usize = 3;

/// Face velocities on the window: those of the solve, `u[active[axis][index]]`, and around them
/// layers of open faces with the mean of their neighbours; NaN elsewhere.
///
/// Neighbours along the axis count first: ahead of the front in a lumen the flow goes on as it
/// is. Neighbours across it count where no wall lies between.
pub(crate) fn extend(lattice: &Lattice, active: &[Vec<u32>; 3], u: &[f64]) -> [Vec<f32>; 3] {
    std::array::from_fn(|axis| {
        let mut value: Vec<f32> = (active[axis].par_iter())
            .map(|&dof| {
                if dof == NONE {
                    f32::NAN
                } else {
                    u[dof as usize] as f32
                }
            })
            .collect();
        if axis < lattice.window.domain.axes {
            for _ in 0..LAYERS {
                extend_once(lattice, axis, &mut value);
            }
        }
        value
    })
}

fn extend_once(lattice: &Lattice, axis: usize, value: &mut [f32]) {
    let window = &lattice.window;
    let [nx, ny, nz] = window.cells;
    let strides = &[0, 1, 2].map(|a| window.stride(a))[..window.domain.axes];
    let before = &*value;
    let found: Vec<(u32, f32)> = (0..ny * nz)
        .into_par_iter()
        .filter(|&row| window.inner([1, row % ny, row / ny]))
        .flat_map_iter(|row| {
            let wanted = move |&index: &usize| {
                before[index].is_nan()
                    && lattice.face(axis, index) == OPEN
                    && (strides.iter())
                        .any(|s| !(before[index - s].is_nan() && before[index + s].is_nan()))
            };
            let places = (row * nx + 1..(row + 1) * nx - 1).filter(wanted);
            places.filter_map(move |index| {
                Some((index as u32, around(lattice, axis, index, before)?))
            })
        })
        .collect();
    for (index, mean) in found {
        value[index as usize] = mean;
    }
}

/// Mean of the known velocities beside a face along its axis, else of those across it that no wall
/// parts from it.
fn around(lattice: &Lattice, axis: usize, index: usize, value: &[f32]) -> Option<f32> {
    let window = &lattice.window;
    let along = window.stride(axis);
    mean(value, [Some(index - along), Some(index + along)]).or_else(|| {
        let cell = window.coordinates(index);
        let across = (lattice.tangents(axis).iter()).flat_map(|&t| {
            let stride = window.stride(t);
            [(0, index - stride), (1, index + stride)].map(|(side, next)| {
                // Rays only towards neighbours that have something to give.
                let known = !value[next].is_nan();
                (known && passable(lattice, axis, cell, t, side)).then_some(next)
            })
        });
        mean(value, across)
    })
}

fn mean(value: &[f32], places: impl IntoIterator<Item = Option<usize>>) -> Option<f32> {
    let (mut sum, mut n) = (0.0, 0.0);
    for v in places.into_iter().flatten().filter_map(|p| value.get(p)) {
        if !v.is_nan() {
            sum += v;
            n += 1.0;
        }
    }
    (n > 0.0).then(|| sum / n)
}

/// Whether no wall lies between a face and its neighbour across, below (0) or above (1).
fn passable(lattice: &Lattice, axis: usize, cell: [usize; 3], t: usize, side: usize) -> bool {
    if lattice.clear(axis, cell, t) {
        return true;
    }
    (0..lattice.column_count()).any(|c| {
        let column = lattice.column(axis, cell, t, c);
        !column.blocked() && column.distance[side] > 1.0
    })
}

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
    let found: Vec<(u32, f32)> = (0..window.len())
        .into_par_iter()
        .filter(|&index| value[index].is_nan() && lattice.face(axis, index) == OPEN)
        .filter_map(|index| {
            let cell = window.coordinates(index);
            if !window.inner(cell) {
                return None;
            }
            let along = window.stride(axis);
            let mean = mean(value, [Some(index - along), Some(index + along)]).or_else(|| {
                let across = (lattice.tangents(axis).iter()).flat_map(|&t| {
                    let stride = window.stride(t);
                    [
                        passable(lattice, axis, cell, t, 0).then(|| index - stride),
                        passable(lattice, axis, cell, t, 1).then(|| index + stride),
                    ]
                });
                self::mean(value, across)
            })?;
            Some((index as u32, mean))
        })
        .collect();
    for (index, mean) in found {
        value[index as usize] = mean;
    }
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

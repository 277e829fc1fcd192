//! Density projection: moves particles so that the liquid keeps its density.
//!
//! Sampling and interpolation errors of the transport show as cells that hold too much or too
//! little. The least displacement that removes a fraction kappa of the error,
//!
//! min sum_f V_f d_f^2/2 with G d = kappa clip(r_c - 1) phi_c o_c,
//!
//! is d = V^-1 G^T psi with G V^-1 G^T psi = the right-hand side: zero on walls, free at the
//! surface. It is kept out of the solve for velocities, where the sampling noise would go
//! straight into the pressure. Without it the density in lumens falls to 0.9.

use rayon::prelude::*;

use crate::geometry::Window;
use saddle_point::{Csr, Poisson, SolveError};

/// Fraction of the density error that one step removes.
const KAPPA: f64 = 0.5;
/// Way of the fastest liquid in a step, cells, from which it does; a shorter one removes as much less, for liquid that rests makes
/// no errors, and what is left of old ones would move it by the number of steps.
const WAY: f64 = 0.001;
/// Largest relative error that counts.
const CLIP: f64 = 0.3;
/// Liquid fraction from which a cell below unit density is contracted; below, it is partly filled
/// because it is at the surface.
const FULL: f32 = 0.85;
/// Largest displacement of a face, cells: a cell in which particles crowd must not hold back the
/// others.
const LONGEST: f64 = 0.25;
/// Liquid volume, in cells, that a face's control volume counts with at least.
const LEAST_VOLUME: f64 = 0.02;
/// Relative residual, and iterations to reach it, of the projection.
const TOLERANCE: f64 = 0.1;
const MAX_ITERATIONS: usize = 100;

/// Liquid in the cells whose pressure is an unknown, in their order.
pub(crate) struct Cells {
    /// Density r, 1 when full.
    pub(crate) density: Vec<f32>,
    /// Liquid fraction phi of the open volume.
    pub(crate) fraction: Vec<f32>,
    /// Liquid volume phi o, cells.
    pub(crate) volume: Vec<f32>,
}

/// Displacement (cells) of each face unknown that reduces the density error, and the number of
/// iterations it took. `g` are the fluxes, cells x faces, `face_volume` the liquid volumes of the
/// faces in cells, `way` that of the fastest liquid in the step, cells.
///
/// # Errors
/// Those of [`Poisson`], except that a solution short of its tolerance is used as it is: what is
/// left of the error is taken away in later steps.
// Not inlined: make leave-out counts what it takes by its name.
#[inline(never)]
pub(crate) fn displacement(
    g: &Csr<f64>,
    g_transposed: &Csr<f64>,
    face_volume: &[f64],
    cells: &Cells,
    way: f64,
) -> Result<(Vec<f64>, usize), SolveError> {
    let kappa = KAPPA * (way / WAY).min(1.0);
    let weight: Vec<f64> = (face_volume.iter())
        .map(|v| 1.0 / v.max(LEAST_VOLUME))
        .collect();
    let rhs: Vec<f64> = (cells.density.iter())
        .zip(&cells.fraction)
        .zip(&cells.volume)
        .map(|((&r, &phi), &volume)| {
            let error = (f64::from(r) - 1.0).clamp(-CLIP, CLIP);
            if error < 0.0 && phi < FULL {
                0.0
            } else {
                kappa * error * f64::from(volume)
            }
        })
        .collect();
    let none = vec![0.0; rhs.len()];
    let poisson = Poisson::new(g, g_transposed, &weight, &none)?;
    let mut psi = Vec::new();
    let iterations = match poisson.solve(&rhs, &mut psi, TOLERANCE, MAX_ITERATIONS) {
        Ok(iterations) | Err(SolveError::NotConverged { iterations, .. }) => iterations,
        Err(error) => return Err(error),
    };
    let moves: Vec<f64> = (0..face_volume.len())
        .into_par_iter()
        .with_min_len(1 << 12)
        .map(|face| {
            let (rows, values) = g_transposed.row(face);
            let flux: f64 = (rows.iter().zip(values))
                .map(|(&cell, value)| value * psi[cell as usize])
                .sum();
            (flux * weight[face]).clamp(-LONGEST, LONGEST)
        })
        .collect();
    Ok((moves, iterations))
}

/// Displacements between the faces: linear along their own axis and across it, zero on walls and
/// in the air.
pub(crate) struct Field<'a> {
    window: Window,
    face: &'a [Vec<u32>; 3],
    /// Of the face unknowns, and 0 for what is none.
    moves: Vec<f64>,
}

impl<'a> Field<'a> {
    /// The field of `moves[face[axis][index]]`.
    pub(crate) fn new(window: &Window, face: &'a [Vec<u32>; 3], mut moves: Vec<f64>) -> Self {
        moves.push(0.0);
        Self {
            window: *window,
            face,
            moves,
        }
    }

    /// Displacement (cells) at a point of the domain; `near` is kept from point to point of this field.
    #[inline]
    pub(crate) fn at(&self, point: [f64; 3], near: &mut Near) -> [f64; 3] {
        match self.window.domain.axes {
            2 => self.along::<2>(point, near),
            _ => self.along::<3>(point, near),
        }
    }

    #[inline]
    fn along<const AXES: usize>(&self, point: [f64; 3], near: &mut Near) -> [f64; 3] {
        let local = self.window.local(point);
        let cell: [usize; AXES] =
            std::array::from_fn(|a| (local[a].max(1.0) as usize).min(self.window.cells[a] - 2));
        let index = (0..AXES).map(|a| cell[a] * self.window.stride(a)).sum();
        if near.cell != index {
            near.cell = index;
            self.gather::<AXES>(index, &mut near.moves);
        }
        // Lower neighbour in the stencil, and part of the way to the upper one: among faces, which begin in the
        // cell, and among centres, which begin in the one below.
        let faces: [_; AXES] = std::array::from_fn(|a| (0, local[a] - cell[a] as f64));
        let centres = faces.map(|(_, part)| match part < 0.5 {
            true => (0, part + 0.5),
            false => (1, part - 0.5),
        });
        let mut found = [0.0; 3];
        for (axis, found) in found.iter_mut().enumerate().take(AXES) {
            let mut at = centres;
            at[axis] = faces[axis];
            let base: usize = (0..AXES).map(|a| at[a].0 * STRIDE[a]).sum();
            let mut moves: [f64; 8] = std::array::from_fn(|corner| {
                let step = |a: usize| (corner >> a & 1) * STRIDE[a];
                near.moves[axis][base + (0..AXES).map(step).sum::<usize>()]
            });
            for (a, (_, part)) in at.into_iter().enumerate() {
                for pair in 0..1 << (AXES - 1 - a) {
                    let [low, high] = [moves[2 * pair], moves[2 * pair + 1]];
                    moves[pair] = low + part * (high - low);
                }
            }
            *found = moves[0];
        }
        found
    }

    /// Displacements of the faces along each axis that reach into a cell.
    fn gather<const AXES: usize>(&self, cell: usize, moves: &mut [[f64; 27]; 3]) {
        let layers = |a: usize, axis: usize| match a {
            _ if a >= AXES => 1,
            _ if a == axis => 2,
            _ => 3,
        };
        for (axis, moves) in moves.iter_mut().enumerate().take(AXES) {
            let below: usize = (0..AXES)
                .filter(|&a| a != axis)
                .map(|a| self.window.stride(a))
                .sum();
            for k in 0..layers(2, axis) {
                for j in 0..layers(1, axis) {
                    for i in 0..layers(0, axis) {
                        let way = [i, j, k];
                        let step = |strides: [usize; 3]| {
                            (0..3).map(|a| way[a] * strides[a]).sum::<usize>()
                        };
                        let index = cell - below + step([0, 1, 2].map(|a| self.window.stride(a)));
                        // No face, a number beyond all, stands at the end and does not move.
                        let face = self.face[axis][index] as usize;
                        moves[step(STRIDE)] = self.moves[face.min(self.moves.len() - 1)];
                    }
                }
            }
        }
    }
}

/// Between neighbours in a stencil, along each axis.
const STRIDE: [usize; 3] = [1, 3, 9];

/// The displacements around the cell that was asked for last, in which are most points that come next.
pub(crate) struct Near {
    /// Its index in the window.
    cell: usize,
    moves: [[f64; 27]; 3],
}

impl Default for Near {
    fn default() -> Self {
        Self {
            cell: usize::MAX,
            moves: [[0.0; 27]; 3],
        }
    }
}

#[cfg(test)]
mod tests;

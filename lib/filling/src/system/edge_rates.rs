//! Shear rates at the edges of the lattice, for viscosities that change from cell to cell by decades: of the
//! differences there, not a mean of those in the cells around.

use rayon::prelude::*;

use super::Operator;
use super::edges::Edges;
use super::terms::Velocity;

impl Operator<'_> {
    /// |dev D| (m/s per cell) at the edges in each plane, counted by the axis along the edges and the cell at
    /// whose low corner they are, for the velocities `u` (m/s) of the face unknowns; NaN where is none.
    ///
    /// |dev D|^2 = S^2/2 + mean over the cells around of the squares of their stretching and of half the
    /// mean squares of S at their edges in the other planes, S = du_i/dx_j + du_j/dx_i.
    pub(super) fn edge_rates(&self, u: &[f64], bodies: &[[f64; 3]]) -> [Vec<f32>; 3] {
        let window = &self.lattice.window;
        let axes = window.domain.axes;
        let (edges, n) = (Edges::new(self), window.len());
        let planes = [(1, 2), (0, 2), (0, 1)];
        let shear = planes.map(|(i, j)| -> Vec<f32> {
            let at = |at: usize| self.shear(&edges, [i, j], at, u, bodies) as f32;
            if j < axes {
                (0..n).into_par_iter().map(at).collect()
            } else {
                Vec::new()
            }
        });
        let stretching: Vec<f32> = (0..n)
            .into_par_iter()
            .map(|cell| self.stretching(cell, u, bodies) as f32)
            .collect();
        // Mean square of the shear at the four edges of a cell in a plane.
        let square = |plane: usize, cell: usize| {
            let (i, j) = planes[plane];
            let (si, sj) = (window.stride(i), window.stride(j));
            mean(
                [cell, cell + si, cell + sj, cell + si + sj]
                    .map(|at| shear[plane].get(at).map_or(f32::NAN, |s| s * s)),
            )
        };
        [0, 1, 2].map(|plane| {
            let (i, j) = planes[plane];
            let (si, sj) = (window.stride(i), window.stride(j));
            (0..shear[plane].len())
                .into_par_iter()
                .map(|at| {
                    let own = shear[plane][at];
                    if own.is_nan() {
                        return own;
                    }
                    let around = [at, at - si, at - sj, at - si - sj].map(|cell| {
                        let others = (0..3).filter(|other| *other != plane);
                        let others: f32 = others.map(|other| square(other, cell)).sum();
                        match self.volumes.cell[cell] > 0.0 {
                            true => stretching[cell] + 0.5 * others,
                            false => f32::NAN,
                        }
                    });
                    (0.5 * own * own + mean(around)).sqrt()
                })
                .collect()
        })
    }

    fn speed(&self, velocity: Option<Velocity>, u: &[f64], bodies: &[[f64; 3]]) -> Option<f64> {
        velocity.map(|velocity| match velocity {
            Velocity::Face(face) => u[face as usize],
            Velocity::Body(number) => bodies[number as usize / 3][number as usize % 3],
            Velocity::Still => 0.0,
        })
    }

    /// du_i/dx_j + du_j/dx_i at an edge; NaN where is none.
    fn shear(
        &self,
        edges: &Edges,
        [i, j]: [usize; 2],
        at: usize,
        u: &[f64],
        bodies: &[[f64; 3]],
    ) -> f64 {
        let Some(edge) = edges.at(i, j, at) else {
            return f64::NAN;
        };
        let window = &self.lattice.window;
        let difference = |axis: usize, low: usize, which: usize| {
            let between = [low, at].map(|face| self.speed(self.velocity(axis, face), u, bodies));
            match between {
                [Some(a), Some(b)] if edge.sight[which] > 0.0 => (b - a) / edge.distance[which],
                _ => 0.0,
            }
        };
        difference(i, at - window.stride(j), 0) + difference(j, at - window.stride(i), 1)
    }

    /// Sum of the squares of du_i/dx_i in a cell.
    fn stretching(&self, cell: usize, u: &[f64], bodies: &[[f64; 3]]) -> f64 {
        let window = &self.lattice.window;
        if self.volumes.cell[cell] <= 0.0 {
            return 0.0;
        }
        let along = |axis: usize| {
            let faces = [cell, (cell + window.stride(axis)).min(window.len() - 1)];
            let ends = faces.map(|face| self.speed(self.velocity(axis, face), u, bodies));
            match ends {
                [Some(a), Some(b)] => (b - a) * (b - a),
                _ => 0.0,
            }
        };
        (0..window.domain.axes).map(along).sum()
    }
}

/// Mean of the numbers that are some; 0 of none.
fn mean<const N: usize>(numbers: [f32; N]) -> f32 {
    let some = numbers.iter().filter(|x| !x.is_nan());
    let (sum, count) = some.fold((0.0, 0.0), |(sum, count), x| (sum + x, count + 1.0));
    if count > 0.0 { sum / count } else { 0.0 }
}

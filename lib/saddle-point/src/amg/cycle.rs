//! One multigrid cycle.

use super::{Amg, Bottom, Level};
use crate::vector::{Work, add_scaled, dot, for_chunks, norm, reset};

/// Jacobi weights of the two sweeps: inverse Chebyshev points of the interval [0.25, 2], the part
/// of the spectrum of `D^-1 A` that aggregates of eight cannot represent. The bound 2 holds for
/// non-positive off-diagonal entries.
const WEIGHTS: [Work; 2] = [0.5735, 1.975];
/// Aggregates of piecewise constants make the coarse operator too stiff; the correction is
/// lengthened (Braess 1995, Computing 55, 379-393).
const OVERCORRECTION: Work = 1.3;
/// The second Krylov step is left out when the first reduces the residual by this.
const ENOUGH: f64 = 0.25;

/// Vectors of one level.
#[derive(Default)]
struct Vectors {
    rhs: Vec<Work>,
    solution: Vec<Work>,
    scratch: Vec<Work>,
    /// Of the two Krylov steps: direction and its product, and the second product.
    direction: Vec<Work>,
    product: Vec<Work>,
    second: Vec<Work>,
}

/// Vectors of all levels, kept between cycles.
#[derive(Default)]
pub(crate) struct Workspace {
    levels: Vec<Vectors>,
}

impl Workspace {
    fn fit(&mut self, amg: &Amg) {
        let rows = amg.rows_per_level();
        self.levels.resize_with(rows.len(), Vectors::default);
        for (vectors, n) in self.levels.iter_mut().zip(rows) {
            if vectors.rhs.len() != n {
                for vector in [
                    &mut vectors.rhs,
                    &mut vectors.solution,
                    &mut vectors.scratch,
                    &mut vectors.direction,
                    &mut vectors.product,
                    &mut vectors.second,
                ] {
                    reset(vector, n);
                }
            }
        }
    }
}

impl Amg {
    /// `x ~ matrix^-1 b` by one cycle from zero.
    pub(crate) fn cycle(&self, b: &[Work], x: &mut Vec<Work>, workspace: &mut Workspace) {
        workspace.fit(self);
        let Some((top, below)) = workspace.levels.split_first_mut() else {
            return;
        };
        reset(x, b.len());
        self.descend(0, b, x, &mut top.scratch, below);
    }

    /// Smoothing, coarse correction, smoothing on level `index`.
    fn descend(
        &self,
        index: usize,
        b: &[Work],
        x: &mut [Work],
        scratch: &mut [Work],
        below: &mut [Vectors],
    ) {
        let Some(level) = self.levels.get(index) else {
            return self.bottom.solve(b, x);
        };
        smooth_from_zero(level, b, x, scratch);
        for_chunks(scratch, |start, part| {
            for (i, out) in part.iter_mut().enumerate() {
                *out = b[start + i] - level.matrix.row_times(start + i, x);
            }
        });
        let Some((next, rest)) = below.split_first_mut() else {
            return;
        };
        level.aggregation.restrict(scratch, &mut next.rhs);
        if index + 1 < self.levels.len() {
            self.accelerate(index + 1, next, rest);
        } else {
            let Vectors {
                rhs,
                solution,
                scratch,
                ..
            } = next;
            self.descend(index + 1, rhs, solution, scratch, rest);
        }
        (level.aggregation).add_prolonged(OVERCORRECTION, &next.solution, x);
        jacobi(level, WEIGHTS[1], b, x, scratch);
        jacobi(level, WEIGHTS[0], b, scratch, x);
    }

    /// Solves level `index` for `vectors.rhs` by at most two steps of flexible conjugate
    /// gradients, each preconditioned by a cycle (Notay 2010, algorithm 3.2).
    fn accelerate(&self, index: usize, vectors: &mut Vectors, below: &mut [Vectors]) {
        let Vectors {
            rhs,
            solution,
            scratch,
            direction,
            product,
            second,
        } = vectors;
        let matrix = &self.levels[index].matrix;
        let multiply = |x: &[Work], y: &mut [Work]| {
            for_chunks(y, |start, part| {
                for (i, y) in part.iter_mut().enumerate() {
                    *y = matrix.row_times(start + i, x);
                }
            });
        };
        self.descend(index, rhs, solution, scratch, below);
        multiply(solution, product);
        let curvature = dot(solution, product);
        if curvature <= 0.0 || curvature.is_nan() {
            return;
        }
        let before = norm(rhs);
        let first_step = dot(solution, rhs) / curvature;
        add_scaled(rhs, -first_step, product);
        if norm(rhs) <= ENOUGH * before {
            scale(solution, first_step);
            return;
        }
        self.descend(index, rhs, direction, scratch, below);
        multiply(direction, second);
        let coupling = dot(direction, product);
        let second_curvature = dot(direction, second) - coupling * coupling / curvature;
        if second_curvature <= 0.0 || second_curvature.is_nan() {
            scale(solution, first_step);
            return;
        }
        let second_step = dot(direction, rhs) / second_curvature;
        scale(solution, first_step - coupling * second_step / curvature);
        add_scaled(solution, second_step, direction);
    }
}

impl Bottom {
    fn solve(&self, b: &[Work], x: &mut [Work]) {
        match self {
            Self::Dense(factor) => factor.solve(b, x),
            Self::Jacobi(inverse_diagonal) => {
                for ((x, b), d) in x.iter_mut().zip(b).zip(inverse_diagonal) {
                    *x = b * d;
                }
            }
        }
    }
}

fn scale(x: &mut [Work], factor: f64) {
    let factor = factor as Work;
    for_chunks(x, |_, part| part.iter_mut().for_each(|x| *x *= factor));
}

/// Both sweeps from `x = 0`, where the first needs no product.
fn smooth_from_zero(level: &Level, b: &[Work], x: &mut [Work], scratch: &mut [Work]) {
    let inverse = &level.inverse_diagonal;
    for_chunks(scratch, |start, part| {
        for (i, out) in part.iter_mut().enumerate() {
            *out = WEIGHTS[0] * inverse[start + i] * b[start + i];
        }
    });
    jacobi(level, WEIGHTS[1], b, scratch, x);
}

/// `out = x + weight D^-1 (b - A x)`.
fn jacobi(level: &Level, weight: Work, b: &[Work], x: &[Work], out: &mut [Work]) {
    for_chunks(out, |start, part| {
        for (i, out) in part.iter_mut().enumerate() {
            let row = start + i;
            let residual = b[row] - level.matrix.row_times(row, x);
            *out = x[row] + weight * level.inverse_diagonal[row] * residual;
        }
    });
}

//! One multigrid cycle.

use super::{Amg, Bottom, Level};
use crate::vector::{Work, add_scaled, dot, for_chunks, norm, reset};

/// Jacobi weights of the two sweeps: inverse Chebyshev points of the interval [0.25, 2], the part
/// of the spectrum of `D^-1 A` that aggregates of eight cannot represent. The bound 2 holds for
/// non-positive off-diagonal entries.
const WEIGHTS: [Work; 2] = [0.5735, 1.975];
/// Aggregates of piecewise constants make the coarse operator too stiff; the correction is
/// lengthened (Braess 1995, Computing 55, 379-393); by how much is by trial.
const OVERCORRECTION: Work = 1.3;
/// The second Krylov step is left out when the first reduces the residual by this (Notay 2010, ETNA 37, 123-146).
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::csr::Csr;

    /// The Laplacian of a cube of `n` cells an edge whose sides are held at zero.
    fn cube(n: usize) -> Csr<f64> {
        let rows = n * n * n;
        let assembled = Csr::assemble(rows, rows, |row, entries| {
            entries.add(row, 6.0);
            for stride in [1, n, n * n] {
                let place = row / stride % n;
                if place > 0 {
                    entries.add(row - stride, -1.0);
                }
                if place + 1 < n {
                    entries.add(row + stride, -1.0);
                }
            }
        });
        assembled.unwrap()
    }

    /// Steps of conjugate gradients are best in the energy: what is left of the right-hand side is
    /// orthogonal to the solution, and the energy x.Ax = x.b of two steps is more than that of the best
    /// multiple of one cycle.
    #[test]
    fn steps_on_a_level_are_the_best_in_the_energy() {
        let n = 20;
        let amg = Amg::new(&cube(n)).unwrap();
        let rows = amg.rows_per_level();
        assert_eq!(rows.len(), 3, "{rows:?}");
        let matrix = &amg.levels[1].matrix;
        let product = |x: &[Work]| -> Vec<Work> {
            (0..rows[1]).map(|row| matrix.row_times(row, x)).collect()
        };
        let mut most = 0.0_f64;
        // From the smoothest to nearly the roughest right-hand side, which takes fewer steps.
        for waves in [1, 2, 5, 100, 450] {
            let wave = std::f64::consts::PI * f64::from(waves) / rows[1] as f64;
            let b: Vec<Work> = (0..rows[1])
                .map(|row| (wave * (row as f64 + 0.5)).sin() as Work)
                .collect();
            let mut workspace = Workspace::default();
            workspace.fit(&amg);
            let (next, rest) = workspace.levels[1..].split_first_mut().unwrap();
            next.rhs.copy_from_slice(&b);
            amg.descend(1, &b, &mut next.solution, &mut next.scratch, rest);
            let (x, ax) = (&next.solution, product(&next.solution));
            let single = dot(x, &b).powi(2) / dot(x, &ax);
            amg.accelerate(1, next, rest);
            let x = &next.solution;
            let (ax, energy) = (product(x), dot(x, &b));
            let left: Vec<Work> = b.iter().zip(&ax).map(|(b, ax)| b - ax).collect();
            assert!(dot(x, &left).abs() < 1e-4 * energy, "{waves} waves");
            assert!(norm(&left) < 0.3 * norm(&b), "{waves} waves");
            assert!(energy > single * (1.0 - 1e-5), "{waves} waves");
            most = most.max(energy / single);
        }
        println!(
            "a second step adds {:.2e} of the energy at most",
            most - 1.0
        );
        assert!(most > 1.0 + 1e-4, "no second step was taken");
    }
}

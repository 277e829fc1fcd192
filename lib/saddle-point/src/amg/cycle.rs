//! One multigrid cycle.

use super::{Amg, Bottom, Level};
use crate::vector::{Work, add_scaled, dot, for_each, norm};

/// Jacobi weights of the two sweeps: inverse Chebyshev points of the interval [0.25, 2], the part
/// of the spectrum of `D^-1 A` that aggregates of eight cannot represent. The bound 2 holds for
/// non-positive off-diagonal entries.
const WEIGHTS: [Work; 2] = [0.5735, 1.975];
/// Piecewise constant aggregates make the coarse operator too stiff, so the correction is enlarged (Braess 1995, Computing
/// 55, 379-393). The factor was found by trial.
const OVERCORRECTION: Work = 1.3;
/// The second Krylov step is skipped if the first reduces the residual to this fraction (Notay 2010, ETNA 37, 123-146).
const ENOUGH: f64 = 0.25;

/// Vectors of one level, kept between cycles.
pub(super) struct Vectors {
    rhs: Vec<Work>,
    solution: Vec<Work>,
    scratch: Vec<Work>,
    /// Krylov steps: second direction, and the products of the first and the second.
    direction: Vec<Work>,
    product: Vec<Work>,
    second: Vec<Work>,
}

impl Vectors {
    pub(super) fn new(rows: usize) -> Self {
        let [rhs, solution, scratch] = std::array::from_fn(|_| vec![0.0; rows]);
        let [direction, product, second] = std::array::from_fn(|_| vec![0.0; rows]);
        Self {
            rhs,
            solution,
            scratch,
            direction,
            product,
            second,
        }
    }
}

impl Amg {
    /// `x ~ matrix^-1 b` by one cycle from zero.
    pub(crate) fn cycle(&mut self, b: &[Work], x: &mut [Work]) {
        let Self {
            levels,
            bottom,
            vectors,
        } = self;
        if let Some((top, below)) = vectors.split_first_mut() {
            descend((levels, bottom), b, x, &mut top.scratch, below);
        }
    }
}

/// The levels from a given one on, and the last one.
type Levels<'a> = (&'a [Level], &'a Bottom);

/// Smoothing, coarse correction and smoothing on the first of `levels`.
fn descend(
    (levels, bottom): Levels,
    b: &[Work],
    x: &mut [Work],
    scratch: &mut [Work],
    below: &mut [Vectors],
) {
    let (Some((level, lower)), Some((next, rest))) =
        (levels.split_first(), below.split_first_mut())
    else {
        return bottom.solve(b, x);
    };
    // The first sweep starts from zero and needs no product.
    let inverse = &level.inverse_diagonal;
    for_each(scratch, |row, out| {
        *out = WEIGHTS[0] * inverse[row] * b[row]
    });
    jacobi(level, WEIGHTS[1], b, scratch, x);
    for_each(scratch, |row, out| {
        *out = b[row] - level.matrix.row_times(row, x)
    });
    level.aggregation.restrict(scratch, &mut next.rhs);
    if lower.is_empty() {
        bottom.solve(&next.rhs, &mut next.solution);
    } else {
        accelerate((lower, bottom), next, rest);
    }
    (level.aggregation).add_prolonged(OVERCORRECTION, &next.solution, x);
    jacobi(level, WEIGHTS[1], b, x, scratch);
    jacobi(level, WEIGHTS[0], b, scratch, x);
}

/// Solves the first of `levels` for `vectors.rhs` by at most two steps of flexible conjugate
/// gradients, each preconditioned by a cycle (Notay 2010, algorithm 3.2).
fn accelerate(levels: Levels, vectors: &mut Vectors, below: &mut [Vectors]) {
    let Vectors {
        rhs,
        solution,
        scratch,
        direction,
        product,
        second,
    } = vectors;
    let matrix = &levels.0[0].matrix;
    let multiply = |x: &[Work], y: &mut [Work]| for_each(y, |row, y| *y = matrix.row_times(row, x));
    descend(levels, rhs, solution, scratch, below);
    multiply(solution, product);
    let curvature = dot(solution, product);
    if curvature <= 0.0 || curvature.is_nan() {
        return;
    }
    let before = norm(rhs);
    let first_step = dot(solution, rhs) / curvature;
    add_scaled(rhs, -first_step, product);
    if norm(rhs) <= ENOUGH * before {
        return scale(solution, first_step);
    }
    descend(levels, rhs, direction, scratch, below);
    multiply(direction, second);
    let coupling = dot(direction, product);
    let second_curvature = dot(direction, second) - coupling * coupling / curvature;
    if second_curvature <= 0.0 || second_curvature.is_nan() {
        return scale(solution, first_step);
    }
    let second_step = dot(direction, rhs) / second_curvature;
    scale(solution, first_step - coupling * second_step / curvature);
    add_scaled(solution, second_step, direction);
}

impl Bottom {
    fn solve(&self, b: &[Work], x: &mut [Work]) {
        match self {
            Self::Dense(factor) => factor.solve(b, x),
            Self::Jacobi(inverse) => for_each(x, |row, x| *x = b[row] * inverse[row]),
        }
    }
}

fn scale(x: &mut [Work], factor: f64) {
    let factor = factor as Work;
    for_each(x, |_, x| *x *= factor);
}

/// `out = x + weight D^-1 (b - A x)`.
fn jacobi(level: &Level, weight: Work, b: &[Work], x: &[Work], out: &mut [Work]) {
    for_each(out, |row, out| {
        let residual = b[row] - level.matrix.row_times(row, x);
        *out = x[row] + weight * level.inverse_diagonal[row] * residual;
    });
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::csr::Csr;

    /// The Laplacian on a cube of `n` cells per edge with zero at the sides.
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

    /// Steps of conjugate gradients are optimal in the energy norm: the residual is orthogonal to the solution, and the energy
    /// x.Ax = x.b of two steps exceeds that of the best multiple of one cycle.
    #[test]
    fn steps_on_a_level_are_the_best_in_the_energy() {
        let mut amg = Amg::new(&cube(20)).unwrap();
        assert_eq!(amg.levels.len(), 2);
        let levels = (&amg.levels[1..], &amg.bottom);
        let matrix = &levels.0[0].matrix;
        let rows = matrix.n_rows();
        let product =
            |x: &[Work]| -> Vec<Work> { (0..rows).map(|row| matrix.row_times(row, x)).collect() };
        let (next, rest) = amg.vectors[1..].split_first_mut().unwrap();
        let mut most = 0.0_f64;
        // From the smoothest right-hand side to nearly the roughest, which takes fewer steps.
        for waves in [1, 2, 5, 100, 450] {
            let wave = std::f64::consts::PI * f64::from(waves) / rows as f64;
            let b: Vec<Work> = (0..rows)
                .map(|row| (wave * (row as f64 + 0.5)).sin() as Work)
                .collect();
            next.rhs.copy_from_slice(&b);
            descend(levels, &b, &mut next.solution, &mut next.scratch, rest);
            let (x, ax) = (&next.solution, product(&next.solution));
            let single = dot(x, &b).powi(2) / dot(x, &ax);
            accelerate(levels, next, rest);
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

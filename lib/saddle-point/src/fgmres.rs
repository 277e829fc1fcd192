//! Flexible GMRES (Saad 1993, SIAM J. Sci. Comput. 14, 461-469) with restarts.

use crate::SolveError;
use crate::least_squares::LeastSquares;
use crate::orthogonal::orthogonalise;
use crate::vector::{Real, Work, add_scaled, dot_chunk, fit, for_chunks, for_chunks_sum};

/// Safety factor on the tolerance for the estimated residual, so that its rounding does not cost another cycle.
const MARGIN: f64 = 0.98;

/// The linear operator of the system, in double precision.
pub(crate) trait Operator {
    /// `y = K x`.
    fn apply<X: Real>(&mut self, x: &[X], y: &mut [f64]);
}

/// Iterations in which the residual must fall below the fraction [`STALLED`]; else the preconditioner is strengthened, if it
/// can be, and a new cycle starts. Most solves take fewer than 20 iterations; at this rate 1e-3 takes 57.
const TRIAL_ITERATIONS: usize = 10;
const STALLED: f64 = 0.3;

/// A cycle also ends after [`TRIAL_ITERATIONS`] iterations if the residual has fallen below this fraction. Its vectors take most of the
/// memory of a step, and the restart costs little: 1 % more iterations for half the vectors.
const PROMPT: f64 = 0.1;

/// An approximate inverse of the operator.
pub(crate) trait Precondition {
    /// Applies the approximate inverse to `r`, into `z`.
    fn apply(&mut self, r: &[Work], z: &mut Vec<Work>);

    /// Before a cycle, adds to `x`, in double precision, the part of the correction for the residual `r` that single precision
    /// cannot resolve. Returns whether there is any.
    fn correct_in_double(&self, r: &[f64], x: &mut [f64]) -> bool;

    /// Makes the approximation better at more cost; returns whether it could.
    fn strengthen(&mut self) -> bool;
}

/// Krylov vectors before a restart; memory is 8 bytes x unknowns x this.
const RESTART: usize = 30;

/// When to stop.
#[derive(Clone, Copy)]
pub(crate) struct Limits {
    pub(crate) tolerance: f64,
    /// Scale of the tolerance; 0 for the norm of `b`.
    pub(crate) scale: f64,
    /// Fraction of the initial residual that is enough; 0 if the tolerance must be reached.
    pub(crate) enough: f64,
    pub(crate) max_iterations: usize,
}

/// Krylov basis and its preconditioned images, reused between cycles.
#[derive(Default)]
pub(crate) struct KrylovSpace {
    basis: Vec<Vec<Work>>,
    preconditioned: Vec<Vec<Work>>,
    vector: Vec<f64>,
}

/// Solves `K x = b` from `x`; returns the relative residual before every iteration and after the
/// last. The last entry is the true residual, the others are those of the recurrence.
pub(crate) fn fgmres<K: Operator>(
    operator: &mut K,
    preconditioner: &mut impl Precondition,
    b: &[f64],
    x: &mut [f64],
    limits: Limits,
    space: &mut KrylovSpace,
) -> Result<Vec<f64>, SolveError> {
    let scale = limits.scale;
    if scale == 0.0 {
        x.fill(0.0);
        return Ok(vec![0.0]);
    }
    if !scale.is_finite() {
        return Err(overflow(0, scale));
    }
    fit(&mut space.vector, b.len());
    let mut history = Vec::new();
    let mut wanted = limits.tolerance * scale;
    loop {
        let mut residual = true_residual(operator, b, x, &mut space.vector);
        if preconditioner.correct_in_double(&space.vector, x) {
            residual = true_residual(operator, b, x, &mut space.vector);
        }
        if history.is_empty() {
            wanted = wanted.max(limits.enough * residual);
        }
        history.pop();
        history.push(residual / scale);
        let iterations = history.len() - 1;
        if residual <= wanted {
            return Ok(history);
        }
        if !residual.is_finite() {
            return Err(overflow(iterations, residual / scale));
        }
        if iterations >= limits.max_iterations {
            return Err(SolveError::NotConverged {
                iterations,
                residual: residual / scale,
                tolerance: limits.tolerance,
            });
        }
        let cycle = Cycle {
            residual,
            target: MARGIN * wanted,
            scale,
            steps: RESTART.min(limits.max_iterations - iterations),
        };
        cycle.run(operator, preconditioner, x, space, &mut history)?;
    }
}

fn overflow(after: usize, residual: f64) -> SolveError {
    SolveError::Overflow {
        iteration: after + 1,
        residual,
    }
}

/// The iterations between two restarts.
struct Cycle {
    /// Norm of the residual at the start, whose direction is the first vector of the space.
    residual: f64,
    /// Norm of the residual at which the cycle ends.
    target: f64,
    /// Scale of the residuals in the history.
    scale: f64,
    /// Most iterations.
    steps: usize,
}

impl Cycle {
    /// Improves `x` and adds the residuals to `history`.
    fn run<K: Operator>(
        &self,
        operator: &mut K,
        preconditioner: &mut impl Precondition,
        x: &mut [f64],
        space: &mut KrylovSpace,
        history: &mut Vec<f64>,
    ) -> Result<(), SolveError> {
        let mut least_squares = LeastSquares::new(self.residual);
        normalise(&space.vector, self.residual, vector_at(&mut space.basis, 0));
        for k in 0..self.steps {
            let z = vector_at(&mut space.preconditioned, k);
            fit(z, x.len());
            preconditioner.apply(&space.basis[k], z);
            operator.apply(z, &mut space.vector);
            let (column, remaining) = orthogonalise(&space.basis[..=k], &mut space.vector);
            if !remaining.is_finite() {
                let residual = least_squares.residual() / self.scale;
                return Err(overflow(history.len() - 1, residual));
            }
            least_squares.push(column, remaining);
            history.push(least_squares.residual() / self.scale);
            if least_squares.residual() <= self.target || remaining == 0.0 {
                break;
            }
            let before = history.iter().rev().nth(TRIAL_ITERATIONS);
            let left = before.map(|before| least_squares.residual() / (before * self.scale));
            let ends = match left {
                Some(left) if left > STALLED => preconditioner.strengthen(),
                Some(left) => left < PROMPT && k + 1 >= TRIAL_ITERATIONS,
                None => false,
            };
            if ends {
                break;
            }
            normalise(&space.vector, remaining, vector_at(&mut space.basis, k + 1));
        }
        for (z, y) in space.preconditioned.iter().zip(least_squares.solve()) {
            add_scaled(x, y, z);
        }
        Ok(())
    }
}

/// `out = b - K x`; returns its norm.
fn true_residual<K: Operator>(operator: &mut K, b: &[f64], x: &[f64], out: &mut [f64]) -> f64 {
    operator.apply(x, out);
    let square = for_chunks_sum(out, |start, part| {
        for (out, &b) in part.iter_mut().zip(&b[start..]) {
            *out = b - *out;
        }
        dot_chunk(part, part)
    });
    square.sqrt()
}

/// Vector `index` of `vectors`, created if it does not exist.
fn vector_at(vectors: &mut Vec<Vec<Work>>, index: usize) -> &mut Vec<Work> {
    if vectors.len() <= index {
        vectors.resize_with(index + 1, Vec::new);
    }
    &mut vectors[index]
}

fn normalise(vector: &[f64], length: f64, out: &mut Vec<Work>) {
    fit(out, vector.len());
    let factor = 1.0 / length;
    for_chunks(out, |start, part| {
        for (out, &v) in part.iter_mut().zip(&vector[start..]) {
            *out = Work::nearest(factor * v);
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    /// diag(1, 1/2^power, 1/3^power, ..) with a count of its applications; its strengthened preconditioner is the exact inverse.
    #[derive(Clone, Copy)]
    struct Steep {
        power: f64,
        strong: bool,
        applied: usize,
    }

    impl Operator for Steep {
        fn apply<X: Real>(&mut self, x: &[X], y: &mut [f64]) {
            self.applied += 1;
            for (row, (y, &x)) in y.iter_mut().zip(x).enumerate() {
                *y = x.into() / ((row + 1) as f64).powf(self.power);
            }
        }
    }

    impl Precondition for Steep {
        fn apply(&mut self, r: &[Work], z: &mut Vec<Work>) {
            let power = if self.strong { self.power } else { 0.0 };
            let inverse = |(row, r): (usize, &Work)| r * ((row + 1) as Work).powf(power as Work);
            *z = r.iter().enumerate().map(inverse).collect();
        }

        fn correct_in_double(&self, _: &[f64], _: &mut [f64]) -> bool {
            false
        }

        fn strengthen(&mut self) -> bool {
            !std::mem::replace(&mut self.strong, true)
        }
    }

    /// Residuals by iteration for `n` rows, number of applications of the operator, and number of basis vectors.
    fn solve(n: usize, power: f64, tolerance: f64) -> (Vec<f64>, usize, usize) {
        let limits = Limits {
            tolerance,
            scale: (n as f64).sqrt(),
            enough: 0.0,
            max_iterations: 200,
        };
        let [mut operator, mut preconditioner] = [Steep {
            power,
            strong: false,
            applied: 0,
        }; 2];
        let (b, mut x, mut space) = (vec![1.0; n], vec![0.0; n], KrylovSpace::default());
        let (k, m) = (&mut operator, &mut preconditioner);
        let history = fgmres(k, m, &b, &mut x, limits, &mut space).unwrap();
        (history, operator.applied, space.preconditioned.len())
    }

    /// An estimate just below the tolerance ends the cycle and one just above does not: no extra iteration, and no extra cycle
    /// due to rounding, which would apply the operator once more.
    #[test]
    fn one_cycle_reaches_the_tolerance_and_no_more() {
        let solve = |tolerance| solve(30, -1.0, tolerance);
        let r = solve(1e-4).0[8];
        let below = solve(r / 0.9);
        assert_eq!((below.0.len() - 1, below.1), (8, 10));
        let above = solve(r / 1.5);
        assert_eq!(above.1, above.0.len() - 1 + 2, "{:?}", above.0);
    }

    /// If ten iterations leave slightly more than 0.3 of the residual, the inverse takes over and needs one or two; if they leave
    /// slightly less, the cycle continues.
    #[test]
    fn a_cycle_that_is_slow_gives_way_to_a_stronger_preconditioner() {
        let [fast, slow] = [1.5, 1.6].map(|power| solve(100, power, 1e-5).0);
        assert!(
            (0.2..0.3).contains(&fast[10]) && fast.len() > 30,
            "{fast:?}"
        );
        assert!(
            (0.3..0.4).contains(&slow[10]) && (12..=13).contains(&slow.len()),
            "{slow:?}"
        );
    }

    /// If ten iterations leave slightly less than 0.1 of the residual, the cycle ends; if slightly more, it continues.
    #[test]
    fn a_prompt_cycle_takes_ten_vectors() {
        let [(prompt, _, few), (other, _, more)] = [1.05, 1.2].map(|power| solve(100, power, 1e-5));
        assert!(
            (0.05..0.1).contains(&prompt[10]) && prompt.len() > 12 && few == 10,
            "{few}: {prompt:?}"
        );
        assert!(
            (0.1..0.2).contains(&other[10]) && more > 12,
            "{more}: {other:?}"
        );
    }
}

//! Conjugate gradients preconditioned by multigrid.

use crate::amg::{Amg, Workspace};
use crate::csr::Csr;
use crate::vector::{
    Real, Work, add_scaled, dot, dot_chunk, for_chunks, for_chunks_sum, norm, reset,
};

/// How an inner iteration ended.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outcome {
    /// Multigrid cycles.
    pub(crate) iterations: usize,
    /// Residual norm over that of the right-hand side.
    pub(crate) residual: f64,
}

/// Vectors of the iteration, kept between solves.
#[derive(Default)]
pub(crate) struct PcgSpace<T> {
    residual: Vec<T>,
    direction: Vec<T>,
    product: Vec<T>,
    rounded: Vec<Work>,
    correction: Vec<Work>,
    cycle: Workspace,
}

/// Flexible preconditioned conjugate gradients (Notay 2000, SIAM J. Sci.
/// Comput. 22, 1444-1460)
/// for `matrix x = b` from `x = 0`, until the residual falls below `tolerance |b|`. Every
/// direction is made conjugate to the last, so the cycle may vary from step to step.
pub(crate) fn pcg<T: Real>(
    matrix: &Csr<f64>,
    amg: &Amg,
    b: &[T],
    x: &mut Vec<T>,
    tolerance: f64,
    max_iterations: usize,
    space: &mut PcgSpace<T>,
) -> Outcome {
    let n = b.len();
    reset(x, n);
    reset(&mut space.direction, n);
    reset(&mut space.product, n);
    space.rounded.resize(n, Work::default());
    space.residual.clear();
    space.residual.extend_from_slice(b);
    let size = norm(b);
    let mut outcome = Outcome {
        iterations: 0,
        residual: if size > 0.0 { 1.0 } else { 0.0 },
    };
    let mut curvature = 1.0;
    while outcome.residual > tolerance && outcome.iterations < max_iterations {
        for_chunks(&mut space.rounded, |start, part| {
            for (out, &r) in part.iter_mut().zip(&space.residual[start..]) {
                *out = Work::nearest(r.into());
            }
        });
        amg.cycle(&space.rounded, &mut space.correction, &mut space.cycle);
        outcome.iterations += 1;
        // The new direction is conjugate to the last one.
        let beta = T::nearest(-dot(&space.correction, &space.product) / curvature);
        for_chunks(&mut space.direction, |start, part| {
            for (d, &z) in part.iter_mut().zip(&space.correction[start..]) {
                *d = T::nearest(z.into()) + beta * *d;
            }
        });
        curvature = for_chunks_sum(&mut space.product, |start, part| {
            for (i, out) in part.iter_mut().enumerate() {
                *out = T::nearest(matrix.row_times_wide(start + i, &space.direction));
            }
            dot_chunk(part, &space.direction[start..start + part.len()])
        });
        if !(curvature > 0.0 && curvature.is_finite()) {
            break;
        }
        let step = dot(&space.direction, &space.residual) / curvature;
        add_scaled(x, step, &space.direction);
        let step = T::nearest(step);
        let square = for_chunks_sum(&mut space.residual, |start, part| {
            for (r, &q) in part.iter_mut().zip(&space.product[start..]) {
                *r = *r - step * q;
            }
            dot_chunk(part, part)
        });
        outcome.residual = square.sqrt() / size;
    }
    outcome
}

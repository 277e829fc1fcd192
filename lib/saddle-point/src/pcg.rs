//! Conjugate gradients preconditioned by multigrid.

use crate::amg::{Amg, Workspace};
use crate::csr::Csr;
use crate::vector::{
    Real, Work, add_scaled, dot, dot_chunk, for_chunks, for_chunks_sum, norm, reset,
};

/// How an iteration ended.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Outcome {
    /// Multigrid cycles.
    pub(crate) iterations: usize,
    /// Residual norm over that of the right-hand side.
    pub(crate) residual: f64,
}

/// Flexible preconditioned conjugate gradients (Notay 2000, SIAM J. Sci.
/// Comput. 22, 1444-1460)
/// for `matrix x = b` from `x = 0`, until the residual falls below `tolerance |b|`. Every
/// direction is made conjugate to the last, so the cycle may vary from step to step.
pub(crate) fn pcg(
    matrix: &Csr<f64>,
    amg: &Amg,
    b: &[f64],
    x: &mut Vec<f64>,
    tolerance: f64,
    max_iterations: usize,
) -> Outcome {
    let n = b.len();
    reset(x, n);
    let (mut direction, mut product) = (vec![0.0; n], vec![0.0; n]);
    let mut rounded = vec![Work::default(); n];
    let mut residual = b.to_vec();
    let (mut correction, mut workspace) = (Vec::new(), Workspace::default());
    let size = norm(b);
    let mut outcome = Outcome {
        iterations: 0,
        residual: if size > 0.0 { 1.0 } else { 0.0 },
    };
    let mut curvature = 1.0;
    while outcome.residual > tolerance && outcome.iterations < max_iterations {
        for_chunks(&mut rounded, |start, part| {
            for (out, &r) in part.iter_mut().zip(&residual[start..]) {
                *out = Work::nearest(r);
            }
        });
        amg.cycle(&rounded, &mut correction, &mut workspace);
        outcome.iterations += 1;
        // The new direction is conjugate to the last one.
        let beta = -dot(&correction, &product) / curvature;
        for_chunks(&mut direction, |start, part| {
            for (d, &z) in part.iter_mut().zip(&correction[start..]) {
                *d = f64::from(z) + beta * *d;
            }
        });
        curvature = for_chunks_sum(&mut product, |start, part| {
            for (i, out) in part.iter_mut().enumerate() {
                *out = matrix.row_times_wide(start + i, &direction);
            }
            dot_chunk(part, &direction[start..start + part.len()])
        });
        if !(curvature > 0.0 && curvature.is_finite()) {
            break;
        }
        let step = dot(&direction, &residual) / curvature;
        add_scaled(x, step, &direction);
        let square = for_chunks_sum(&mut residual, |start, part| {
            for (r, &q) in part.iter_mut().zip(&product[start..]) {
                *r -= step * q;
            }
            dot_chunk(part, part)
        });
        outcome.residual = square.sqrt() / size;
    }
    outcome
}

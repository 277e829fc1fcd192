//! Dense vectors in fixed chunks: every reduction adds the same partial sums in the same order
//! whatever the number of threads, so results are bit-identical.

use std::ops::{AddAssign, Mul, Sub};

use rayon::prelude::*;

use crate::simd::{Kernel, dispatch};

/// Rows per task. Part of the result: partial sums are formed per chunk.
pub(crate) const CHUNK: usize = 1 << 14;

/// Precision of the preconditioner and of the Krylov basis. Single precision halves their
/// memory traffic; the residual of the outer iteration is always formed in double precision.
pub(crate) type Work = f32;

/// A storage precision, `f32` or `f64`.
pub trait Real:
    Copy + Default + Send + Sync + Into<f64> + Sub<Output = Self> + Mul<Output = Self> + AddAssign
{
    /// The nearest value of this precision.
    fn nearest(value: f64) -> Self;
}

impl Real for f32 {
    fn nearest(value: f64) -> Self {
        value as Self
    }
}

impl Real for f64 {
    fn nearest(value: f64) -> Self {
        value
    }
}

/// Calls `work(first index, chunk)` on every chunk of `out`.
pub(crate) fn for_chunks<T: Send>(out: &mut [T], work: impl Fn(usize, &mut [T]) + Sync) {
    if out.len() <= CHUNK {
        return work(0, out);
    }
    out.par_chunks_mut(CHUNK)
        .enumerate()
        .for_each(|(chunk, part)| work(chunk * CHUNK, part));
}

/// Calls `work(index, value)` on every value of `out`, by chunks.
pub(crate) fn for_each<T: Send>(out: &mut [T], work: impl Fn(usize, &mut T) + Sync) {
    for_chunks(out, |start, part| {
        for (i, out) in part.iter_mut().enumerate() {
            work(start + i, out);
        }
    });
}

/// Like [`for_chunks`], with a partial sum of each chunk; returns their sum in order.
pub(crate) fn for_chunks_sum<T: Send>(
    out: &mut [T],
    work: impl Fn(usize, &mut [T]) -> f64 + Sync,
) -> f64 {
    if out.len() <= CHUNK {
        return work(0, out);
    }
    let chunks = out.par_chunks_mut(CHUNK).enumerate();
    let parts: Vec<f64> = chunks
        .map(|(chunk, part)| work(chunk * CHUNK, part))
        .collect();
    parts.iter().sum()
}

/// Scalar product within one chunk, in double precision over eight lanes.
pub(crate) fn dot_chunk<X: Real, Y: Real>(x: &[X], y: &[Y]) -> f64 {
    let [dot] = dispatch(Dot([x], y));
    dot
}

struct Dot<'a, X, Y>([&'a [X]; 1], &'a [Y]);

impl<X: Real, Y: Real> Kernel for Dot<'_, X, Y> {
    type Output = [f64; 1];

    #[inline(always)]
    fn run(self) -> [f64; 1] {
        dot_each(self.0, self.1)
    }
}

/// Scalar products of several vectors with `y` within one chunk, each in double precision over eight lanes. Several at
/// once hide the latency of the sums.
#[inline(always)]
pub(crate) fn dot_each<const N: usize, X: Real, Y: Real>(x: [&[X]; N], y: &[Y]) -> [f64; N] {
    let mut lanes = [[0.0f64; 8]; N];
    let (y8, y_rest) = y.as_chunks::<8>();
    let x8 = x.map(|x| &x.as_chunks::<8>().0[..y8.len()]);
    for (block, ys) in y8.iter().enumerate() {
        for (lanes, x8) in lanes.iter_mut().zip(x8) {
            for (lane, (x, y)) in lanes.iter_mut().zip(x8[block].iter().zip(ys)) {
                *lane += (*x).into() * (*y).into();
            }
        }
    }
    std::array::from_fn(|j| {
        let rest: f64 = (x[j][8 * y8.len()..].iter().zip(y_rest))
            .map(|(&a, &b)| a.into() * b.into())
            .sum();
        lanes[j].iter().sum::<f64>() + rest
    })
}

/// Scalar product of vectors of equal length.
pub(crate) fn dot<X: Real, Y: Real>(x: &[X], y: &[Y]) -> f64 {
    if x.len() <= CHUNK {
        return dot_chunk(x, y);
    }
    let chunks = x.par_chunks(CHUNK).zip(y.par_chunks(CHUNK));
    let parts: Vec<f64> = chunks.map(|(x, y)| dot_chunk(x, y)).collect();
    parts.iter().sum()
}

/// Euclidean norm.
pub(crate) fn norm<T: Real>(x: &[T]) -> f64 {
    dot(x, x).sqrt()
}

/// `y += alpha x`.
pub(crate) fn add_scaled<Y: Real, X: Real>(y: &mut [Y], alpha: f64, x: &[X]) {
    let alpha = Y::nearest(alpha);
    for_chunks(y, |start, part| {
        for (y, &x) in part.iter_mut().zip(&x[start..]) {
            *y += alpha * Y::nearest(x.into());
        }
    });
}

/// Resizes `v` to `len` without spare memory: systems grow little from step to step.
pub(crate) fn fit<T: Real>(v: &mut Vec<T>, len: usize) {
    v.truncate(len);
    v.reserve_exact(len - v.len());
    v.resize(len, T::default());
}

//! Dense vectors in fixed chunks: every reduction adds the same partial sums in the same order
//! whatever the number of threads, so results are bit-identical.

use std::fmt::Debug;
use std::ops::{Add, AddAssign, Mul, Range, Sub};

use rayon::prelude::*;

use crate::simd::{Kernel, dispatch};

/// Rows per task. Part of the result: partial sums are formed per chunk.
pub(crate) const CHUNK: usize = 1 << 14;

/// Precision of the preconditioner and of the Krylov basis. Single precision halves their
/// memory traffic; the residual of the outer iteration is always formed in double precision.
pub(crate) type Work = f32;

/// A storage precision, `f32` or `f64`.
pub trait Real:
    Copy
    + Debug
    + Default
    + PartialEq
    + Send
    + Sync
    + Into<f64>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + AddAssign
    + 'static
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

/// Sum of `part` over the chunks of `0..len`, added in order.
pub(crate) fn sum_over_chunks(len: usize, part: impl Fn(Range<usize>) -> f64 + Sync) -> f64 {
    if len <= CHUNK {
        return part(0..len);
    }
    let parts: Vec<f64> = (0..len.div_ceil(CHUNK))
        .into_par_iter()
        .map(|chunk| part(chunk * CHUNK..len.min((chunk + 1) * CHUNK)))
        .collect();
    parts.iter().sum()
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

/// Like [`for_chunks`], with a partial sum of each chunk; returns their sum in order.
pub(crate) fn for_chunks_sum<T: Send>(
    out: &mut [T],
    work: impl Fn(usize, &mut [T]) -> f64 + Sync,
) -> f64 {
    if out.len() <= CHUNK {
        return work(0, out);
    }
    let parts: Vec<f64> = out
        .par_chunks_mut(CHUNK)
        .enumerate()
        .map(|(chunk, part)| work(chunk * CHUNK, part))
        .collect();
    parts.iter().sum()
}

/// Like [`for_chunks`] for two arrays of equal length.
pub(crate) fn for_chunks_pair<T: Send, U: Send>(
    left: &mut [T],
    right: &mut [U],
    work: impl Fn(usize, &mut [T], &mut [U]) + Sync,
) {
    if left.len() <= CHUNK {
        return work(0, left, right);
    }
    left.par_chunks_mut(CHUNK)
        .zip(right.par_chunks_mut(CHUNK))
        .enumerate()
        .for_each(|(chunk, (left, right))| work(chunk * CHUNK, left, right));
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

/// Scalar products of several vectors with `y` within one chunk, each in double precision over eight
/// lanes: as many sums as do not wait for one another.
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

/// Scalar product.
pub(crate) fn dot<X: Real, Y: Real>(x: &[X], y: &[Y]) -> f64 {
    sum_over_chunks(x.len().min(y.len()), |range| {
        dot_chunk(&x[range.clone()], &y[range])
    })
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

/// Gives `v` the length `len` without memory to spare: systems grow by little from step to step.
pub(crate) fn fit<T: Real>(v: &mut Vec<T>, len: usize) {
    v.truncate(len);
    v.reserve_exact(len - v.len());
    v.resize(len, T::default());
}

/// Sets `v` to `len` zeros, keeping its memory.
pub(crate) fn reset<T: Real>(v: &mut Vec<T>, len: usize) {
    v.clear();
    v.resize(len, T::default());
}

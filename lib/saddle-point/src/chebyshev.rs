//! Approximate inverse of the velocity block: a Chebyshev polynomial in the Jacobi-scaled matrix.

use rayon::prelude::*;

use crate::packed::{Absolute, Finish, LANES, Lanes, PackedMatrix};
use crate::vector::{CHUNK, Real, Work, for_each};
use crate::velocity_block::VelocityBlock;

/// Sweeps for the bound of the largest eigenvalue, which is then tight to 25 %.
const BOUND_SWEEPS: usize = 6;
/// Degree of the polynomial over the root of the interval's ratio: 24 and, widened, 96. Lower degrees cost more in iterations
/// than they save.
const DEGREE: f64 = 1.2;
/// Largest ratio, that of the widened interval. With 400, 1600, 6400 and 25,600 the hardest step of a wide bond
/// of PVA-PF takes 10.8, 7.8, 5.9 and 9.4 s.
const WIDEST: f64 = 6400.0;

/// `p(A) ~ A^-1` for a symmetric positive definite `A` with diagonal `D`: `S q(S A S) S` with
/// `S = D^-1/2` and `q` the Chebyshev iteration of given degree on `[bound/ratio, bound]`
/// (Golub & Van Loan, Matrix Computations, 4th ed., section 11.2.8).
pub(crate) struct Chebyshev<'a> {
    block: &'a VelocityBlock,
    /// Guaranteed upper bound of the eigenvalues of `D^-1 A`.
    pub(crate) bound: f64,
    degree: usize,
    ratio: f64,
    /// Scaled right-hand side, and the last two iterates.
    rhs: Vec<Work>,
    now: Vec<Work>,
    before: Vec<Work>,
}

impl<'a> Chebyshev<'a> {
    /// The inverse for eigenvalues down to the largest over `ratio`.
    pub(crate) fn new(block: &'a VelocityBlock, ratio: f64) -> Self {
        let len = block.matrix.padded_len();
        let (mut now, mut before) = (vec![0.0; len], vec![0.0; len]);
        let n = block.scale.len();
        Self {
            bound: largest_eigenvalue_bound(&block.matrix, n, &mut now, &mut before),
            block,
            degree: degree(ratio),
            ratio,
            rhs: vec![0.0; len],
            now,
            before,
        }
    }

    /// Widens the interval down to the bound over [`WIDEST`]; returns whether it was narrower before.
    pub(crate) fn widen(&mut self) -> bool {
        let narrower = self.ratio < WIDEST;
        (self.degree, self.ratio) = (degree(WIDEST), WIDEST);
        narrower
    }

    /// `x ~ A^-1 b`.
    pub(crate) fn apply(&mut self, b: &[Work], x: &mut [Work]) {
        let n = b.len();
        let (low, high) = (self.bound / self.ratio, self.bound);
        let (centre, half_width) = (0.5 * (high + low), 0.5 * (high - low));
        let sigma = centre / half_width;
        let first = Work::nearest(1.0 / centre);
        let scale = &self.block.scale[..];
        for_each(&mut self.before[..n], |_, before| *before = 0.0);
        for_each(&mut self.rhs[..n], |i, rhs| *rhs = b[i] * scale[i]);
        for_each(&mut self.now[..n], |i, now| {
            *now = first * (b[i] * scale[i])
        });
        let mut rho = 1.0 / sigma;
        let steps = (1..self.degree).map(|_| {
            let next = 1.0 / (2.0 * sigma - rho);
            let momentum = Work::nearest(next * rho);
            rho = next;
            Step {
                rhs: &self.rhs,
                momentum,
                step: Work::nearest(2.0 * next / half_width),
            }
        });
        let steps: Vec<_> = steps.collect();
        (self.block.matrix).sweep(&mut self.now, &mut self.before, &steps);
        let now = &self.now[..];
        for_each(x, |i, x| *x = now[i] * scale[i]);
    }
}

fn degree(ratio: f64) -> usize {
    (DEGREE * ratio.sqrt()).ceil() as usize
}

/// Replaces the iterate before the last by the next one.
struct Step<'a> {
    rhs: &'a [Work],
    momentum: Work,
    step: Work,
}

impl Finish for Step<'_> {
    #[inline(always)]
    fn finish(&self, block: usize, now: &Lanes, product: Lanes, old: &mut Lanes) {
        let rhs = &self.rhs.as_chunks::<LANES>().0[block];
        *old = std::array::from_fn(|i| {
            let residual = rhs[i] - now[i] - product[i];
            now[i] + self.momentum * (now[i] - old[i]) + self.step * residual
        });
    }
}

/// Upper bound of the spectral radius of `I + M` for symmetric `M` with zero diagonal: for any
/// positive `w`, `rho(I + M) <= rho(I + |M|) <= max_i ((I + |M|) w)_i / w_i` (Collatz 1942).
/// Each sweep `w <- (I + |M|) w` tightens the bound, and the last one is used. Unlike an estimate by power iteration it is
/// never too low, which would make the polynomial amplify the missed modes.
///
/// `w` and `next` are zeros of the padded length and are left so.
fn largest_eigenvalue_bound(
    matrix: &PackedMatrix,
    n: usize,
    w: &mut Vec<Work>,
    next: &mut Vec<Work>,
) -> f64 {
    w[..n].fill(1.0);
    matrix.sweep(w, next, &[const { Absolute }; BOUND_SWEEPS]);
    let bound = (w[..n].par_chunks(CHUNK).zip(next[..n].par_chunks(CHUNK)))
        .map(|(after, before)| {
            let ratios = after.iter().zip(before).map(|(a, b)| a / b);
            ratios.fold(1.0, Work::max)
        })
        .reduce(|| 1.0, Work::max);
    w.fill(0.0);
    next.fill(0.0);
    // Room for the rounding of single-precision sums.
    f64::from(bound) * (1.0 + 1e-5)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An iteration of degree k on [l, h] multiplies the residual of an eigenvector with eigenvalue e by
    /// T_k(s - 2 e/(h - l)) / T_k(s), with the Chebyshev polynomial T_k and s = (h + l)/(h - l).
    #[test]
    fn the_residual_is_the_chebyshev_polynomial() {
        // D^-1 A has the eigenvalues 1.6 and 0.4, with S x = (1, 1) and (1, -1).
        let entries = [[4.0, 1.2], [1.2, 1.0]];
        let scaled = VelocityBlock::assemble(2, |row, list| {
            (0..2).for_each(|column| list.add(column, entries[row][column]));
        })
        .unwrap();
        let next = |x: f64| move |(last, now), _| (now, 2.0 * x * now - last);
        let polynomial = |k: usize, x: f64| (1..k).fold((1.0, x), next(x)).1;
        for (degree, ratio) in [(1, 30.0), (2, 4.0), (3, 30.0), (6, 10.0)] {
            let mut inverse = Chebyshev::new(&scaled, ratio);
            inverse.degree = degree;
            let high = inverse.bound;
            assert!((high - 1.6).abs() < 1e-4, "{high}");
            let half = 0.5 * (high - high / ratio);
            let centre = high - half;
            for (sign, eigenvalue) in [(1.0, 1.6), (-1.0, 0.4)] {
                let b = [2.0, sign as Work];
                let mut x = [0.0; 2];
                inverse.apply(&b, &mut x);
                let left = polynomial(degree, (centre - eigenvalue) / half)
                    / polynomial(degree, centre / half);
                for (row, b) in b.into_iter().enumerate() {
                    let ax: f64 = (0..2).map(|c| entries[row][c] * f64::from(x[c])).sum();
                    let found = 1.0 - ax / f64::from(b);
                    assert!(
                        (found - left).abs() < 1e-4,
                        "{degree} {eigenvalue}: {found} {left}"
                    );
                }
            }
        }
    }

    /// The degree grows with the root of the ratio, once.
    #[test]
    fn an_interval_is_widened_once() {
        let one = VelocityBlock::assemble(1, |_, list| list.add(0, 2.0)).unwrap();
        let mut inverse = Chebyshev::new(&one, 400.0);
        for (degree, narrower) in [(24, true), (96, false)] {
            assert_eq!(inverse.degree, degree);
            assert_eq!(inverse.widen(), narrower);
        }
    }
}

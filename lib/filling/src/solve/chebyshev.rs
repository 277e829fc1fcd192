//! Approximate inverse of the velocity block: a Chebyshev polynomial in the Jacobi-scaled matrix.

use super::SolveError;
use super::csr::Csr;
use super::vector::{Real, Work, for_chunks, for_chunks_pair};

/// Sweeps that tighten the bound of the largest eigenvalue.
const BOUND_SWEEPS: usize = 6;

/// `p(A) ~ A^-1` for a symmetric positive definite `A` with diagonal `D`: `S q(S A S) S` with
/// `S = D^-1/2` and `q` the Chebyshev iteration of given degree on `[bound/ratio, bound]`
/// (Golub & Van Loan, Matrix Computations, 4th ed., section 11.2.8).
pub(crate) struct Chebyshev {
    /// `S A S` without its unit diagonal.
    scaled: Csr<Work>,
    /// `D^-1/2`.
    scale: Vec<Work>,
    bound: f64,
    degree: usize,
    ratio: f64,
    /// Scaled right-hand side and previous iterate.
    rhs: Vec<Work>,
    previous: Vec<Work>,
}

impl Chebyshev {
    pub(crate) fn new(a: &Csr<f64>, degree: usize, ratio: f64) -> Result<Self, SolveError> {
        let diagonal = a.diagonal();
        if let Some(row) = diagonal.iter().position(|&d| !(d > 0.0)) {
            return Err(SolveError::Matrix(format!(
                "diagonal {} of velocity row {row}; the velocity block must be positive definite",
                diagonal[row]
            )));
        }
        let root: Vec<f64> = diagonal.iter().map(|d| 1.0 / d.sqrt()).collect();
        let scaled = a.filter_map(|row, column, value| {
            (row != column).then(|| Work::nearest(value * root[row] * root[column]))
        });
        let bound = largest_eigenvalue_bound(&scaled);
        Ok(Self {
            scaled,
            scale: root.into_iter().map(Work::nearest).collect(),
            bound,
            degree,
            ratio,
            rhs: Vec::new(),
            previous: Vec::new(),
        })
    }

    /// Guaranteed upper bound of the eigenvalues of `D^-1 A`.
    pub(crate) fn bound(&self) -> f64 {
        self.bound
    }

    /// `x ~ A^-1 b`.
    pub(crate) fn apply(&mut self, b: &[Work], x: &mut Vec<Work>) {
        let n = b.len();
        let (low, high) = (self.bound / self.ratio, self.bound);
        let (centre, half_width) = (0.5 * (high + low), 0.5 * (high - low));
        let sigma = centre / half_width;
        let first = Work::nearest(1.0 / centre);
        self.previous.clear();
        self.previous.resize(n, 0.0);
        self.rhs.resize(n, 0.0);
        x.resize(n, 0.0);
        let scale = &self.scale;
        for_chunks_pair(&mut self.rhs, x, |start, rhs, x| {
            for (i, (rhs, x)) in rhs.iter_mut().zip(x).enumerate() {
                *rhs = b[start + i] * scale[start + i];
                *x = first * *rhs;
            }
        });
        let mut rho = 1.0 / sigma;
        for _ in 1..self.degree {
            let next = 1.0 / (2.0 * sigma - rho);
            let momentum = Work::nearest(next * rho);
            let step = Work::nearest(2.0 * next / half_width);
            rho = next;
            let (matrix, rhs, x_now) = (&self.scaled, &self.rhs, &*x);
            for_chunks(&mut self.previous, |start, previous| {
                for (i, old) in previous.iter_mut().enumerate() {
                    let row = start + i;
                    let x_row = x_now[row];
                    let residual = rhs[row] - x_row - matrix.row_times(row, x_now);
                    *old = x_row + momentum * (x_row - *old) + step * residual;
                }
            });
            std::mem::swap(&mut self.previous, x);
        }
        for_chunks(x, |start, part| {
            for (x, &scale) in part.iter_mut().zip(&scale[start..]) {
                *x = *x * scale;
            }
        });
    }
}

/// Upper bound of the spectral radius of `I + M` for symmetric `M` with zero diagonal: for any
/// positive `w`, `rho(I + M) <= rho(I + |M|) <= max_i ((I + |M|) w)_i / w_i` (Collatz 1942).
/// Each sweep `w <- (I + |M|) w` tightens the bound; unlike a power iteration it is never too low,
/// which would make the polynomial amplify the missed modes.
fn largest_eigenvalue_bound(off_diagonal: &Csr<Work>) -> f64 {
    let n = off_diagonal.n_rows();
    let mut w = vec![1.0f64; n];
    let mut next = vec![0.0f64; n];
    let mut bound = f64::INFINITY;
    for _ in 0..BOUND_SWEEPS {
        for_chunks(&mut next, |start, part| {
            for (i, out) in part.iter_mut().enumerate() {
                let (columns, values) = off_diagonal.row(start + i);
                let mut sum = w[start + i];
                for (&column, &value) in columns.iter().zip(values) {
                    sum += f64::from(value.abs()) * w[column as usize];
                }
                *out = sum;
            }
        });
        let ratio = next.iter().zip(&w).map(|(a, b)| a / b).fold(1.0, f64::max);
        bound = bound.min(ratio);
        std::mem::swap(&mut w, &mut next);
    }
    // Rounding of the single-precision entries.
    bound * (1.0 + 1e-5)
}

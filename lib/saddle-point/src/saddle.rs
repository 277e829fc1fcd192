//! Solution of the coupled velocity-pressure system.

use std::mem::take;

use crate::SolveError;
use crate::cause::with_cause;
use crate::csr::Csr;
use crate::fgmres::{KrylovSpace, Operator, fgmres};
use crate::load::{Bordered, Load, LoadedOperator};
use crate::options::{SaddleOptions, SaddleReport};
use crate::preconditioner::Preconditioner;
use crate::residual_scale::ResidualScale;
use crate::system::SaddleSystem;
use crate::vector::{Real, add_scaled, for_each};

/// Solver of [`SaddleSystem`]s. It stores no vectors between solves: they would add to the peak of memory, the assembly of
/// the next matrix.
#[derive(Clone, Copy, Default)]
pub struct SaddleSolver(SaddleOptions);

impl SaddleSolver {
    /// A solver with given settings.
    pub fn new(options: SaddleOptions) -> Self {
        Self(options)
    }

    /// Solves `system` by flexible GMRES from the guess in `u` (one per face) and `p` (one per cell), which receive the
    /// solution. The preconditioner is block lower triangular: a Chebyshev polynomial in `A` for the velocities, then a
    /// multigrid cycle of the friction Poisson operator plus a diagonal for the pressures. Results do not depend on the number
    /// of threads.
    ///
    /// # Errors
    /// [`SolveError::Matrix`] when the system is not as described,
    /// [`SolveError::NotFinite`] for a right-hand side or guess that is not finite,
    /// [`SolveError::NotConverged`] up to [`NEARLY`](super::NEARLY) times the tolerance, with the
    /// best `u` and `p` found, and [`SolveError::Unsolved`] beyond it.
    pub fn solve(
        &self,
        system: &SaddleSystem,
        u: &mut Vec<f64>,
        p: &mut Vec<f64>,
    ) -> Result<SaddleReport, SolveError> {
        system.check(u, p)?;
        let rhs = system.right_hand_side();
        let known = system.motion_scale(system.b, system.volume_source);
        let (options, mut space) = (&self.0, KrylovSpace::default());
        let residual_scale = ResidualScale::new(system, options, 0.0);
        solve_with(system, u, p, |operator, preconditioner, x| {
            residual_scale.solve_rescaled(options, |limits| {
                limits.scale = residual_scale.of(known, x);
                fgmres(operator, preconditioner, &rhs, x, *limits, &mut space)
            })
        })
    }

    /// As [`SaddleSolver::solve`], with the speed of a body as one more unknown and a known force on it. `system` is for the
    /// body at rest. `speed` is the guess and receives the solution.
    ///
    /// # Errors
    /// As [`SaddleSolver::solve`].
    pub fn solve_loaded(
        &self,
        system: &SaddleSystem,
        load: &Load,
        u: &mut Vec<f64>,
        p: &mut Vec<f64>,
        speed: &mut f64,
    ) -> Result<SaddleReport, SolveError> {
        system.check(u, p)?;
        load.check(system)?;
        let (relative, shares) = load.relative_to_body(system);
        let mut rhs = system.right_hand_side();
        let last = rhs.len();
        rhs.push(0.0);
        // The force row gets the weight of the others with the body in motion.
        let resting = system.motion_scale(system.b, system.volume_source);
        let (options, mut space) = (&self.0, KrylovSpace::default());
        let residual_scale = ResidualScale::new(system, options, 1.0);
        solve_with(system, u, p, |inner, preconditioner, x| {
            x.push(0.0);
            residual_scale.solve_rescaled(options, |limits| {
                let moving = residual_scale.of(relative.motion_scale(system, *speed), &x[..last]);
                let weight = moving / relative.scale;
                (x[last], rhs[last]) = (*speed / weight, weight * relative.force);
                limits.scale = resting.hypot(moving);
                let mut operator = LoadedOperator {
                    inner,
                    load: &relative,
                    weight,
                };
                let mut bordered = Bordered::new(preconditioner, &relative, weight);
                add_scaled(&mut x[..shares.len()], -*speed, &shares);
                let result = fgmres(&mut operator, &mut bordered, &rhs, x, *limits, &mut space);
                *speed = weight * x[last];
                add_scaled(&mut x[..shares.len()], *speed, &shares);
                result
            })
        })
    }
}

/// Solves `system` by `iterate`, which improves velocities and pressures in one vector and returns the residuals.
fn solve_with(
    system: &SaddleSystem,
    u: &mut Vec<f64>,
    p: &mut Vec<f64>,
    iterate: impl FnOnce(
        &mut SaddleOperator,
        &mut Preconditioner,
        &mut Vec<f64>,
    ) -> Result<Vec<f64>, SolveError>
    + Send,
) -> Result<SaddleReport, SolveError> {
    let faces = u.len();
    let mut x = take(u);
    // Room for the speed of a body.
    x.reserve_exact(p.len() + 1);
    x.extend(take(p));
    // The whole solve runs on the thread pool, so that its threads are not woken for every product.
    let report = rayon::scope(|_| {
        let g_transposed = system.g.transpose();
        let mut operator = SaddleOperator {
            system: *system,
            g_transposed: &g_transposed,
            scratch: Vec::new(),
        };
        let mut preconditioner = Preconditioner::new(system, &g_transposed)?;
        Ok(SaddleReport {
            history: iterate(&mut operator, &mut preconditioner, &mut x)?,
            eigenvalue_bound: preconditioner.bound(),
        })
    });
    x.truncate(faces + system.g.n_rows());
    *p = x.split_off(faces);
    *u = x;
    report.map_err(|error| with_cause(error, system))
}

struct SaddleOperator<'a> {
    system: SaddleSystem<'a>,
    g_transposed: &'a Csr<f64>,
    /// Scaled velocities.
    scratch: Vec<f64>,
}

impl Operator for SaddleOperator<'_> {
    fn apply<X: Real>(&mut self, x: &[X], y: &mut [f64]) {
        let (SaddleSystem { a, g, c, .. }, g_transposed) = (self.system, self.g_transposed);
        let (u, p) = x.split_at(a.n_rows());
        let (y_u, y_p) = y.split_at_mut(u.len());
        a.multiply_by(u, &mut self.scratch, y_u);
        for_each(y_u, |face, y| *y -= g_transposed.row_times_wide(face, p));
        for_each(y_p, |cell, y| {
            *y = -g.row_times_wide(cell, u) - c[cell] * p[cell].into()
        });
    }
}

//! Solution of the coupled velocity-pressure system.

use crate::SolveError;
use crate::cause::explained;
use crate::csr::Csr;
use crate::fgmres::{KrylovSpace, Operator, fgmres};
use crate::load::{Bordered, Load, LoadedOperator};
use crate::measure::Measure;
use crate::options::{SaddleOptions, SaddleReport};
use crate::preconditioner::Preconditioner;
use crate::system::SaddleSystem;
use crate::vector::{Real, add_scaled, for_each};

/// Solver of [`SaddleSystem`]s. It keeps nothing: the vectors of an iteration would stand beside the next matrix as that is
/// assembled, which takes the most memory.
#[derive(Clone, Copy, Default)]
pub struct SaddleSolver(SaddleOptions);

impl SaddleSolver {
    /// A solver with given settings.
    pub fn new(options: SaddleOptions) -> Self {
        Self(options)
    }

    /// Solves `system` by flexible GMRES from the guess in `u` (one per face) and `p` (one per
    /// cell), which take the solution. The preconditioner is block lower triangular: a Chebyshev
    /// polynomial in `A` for the velocities, then a friction Poisson cycle plus local viscosity for
    /// the pressures; then a sweep that couples both cell by cell. Results do not depend on the
    /// number of threads.
    ///
    /// # Errors
    /// [`SolveError::Length`] or [`SolveError::Matrix`] when the system is not as described,
    /// [`SolveError::NotFinite`] for a right-hand side or guess that is not finite,
    /// [`SolveError::NotConverged`] up to [`NEARLY`](super::NEARLY) times the tolerance, with the
    /// best `u` and `p` found, and [`SolveError::Unsolved`] beyond it.
    pub fn solve(
        &self,
        system: &SaddleSystem,
        u: &mut [f64],
        p: &mut [f64],
    ) -> Result<SaddleReport, SolveError> {
        system.check(u, p)?;
        let rhs = system.right_hand_side();
        let known = system.measure(system.b, system.volume_source);
        let (options, mut space) = (&self.0, KrylovSpace::default());
        let measure = Measure::new(system, options, 0.0);
        solved(system, u, p, |operator, preconditioner, x| {
            measure.stages(options, |limits| {
                limits.size = measure.of(known, x);
                fgmres(operator, preconditioner, &rhs, x, *limits, &mut space)
            })
        })
    }

    /// As [`SaddleSolver::solve`] with the speed of a body unknown and the force on it known;
    /// `system` has it at rest. `speed` holds a guess and takes the solution.
    ///
    /// # Errors
    /// As [`SaddleSolver::solve`].
    pub fn solve_loaded(
        &self,
        system: &SaddleSystem,
        load: &Load,
        u: &mut [f64],
        p: &mut [f64],
        speed: &mut f64,
    ) -> Result<SaddleReport, SolveError> {
        system.check(u, p)?;
        load.check(system)?;
        let (followed, shares) = load.followed(system);
        let mut rhs = system.right_hand_side();
        let last = rhs.len();
        rhs.push(0.0);
        // The force row weighs as much as the others do with the body moving.
        let resting = system.measure(system.b, system.volume_source);
        let (options, mut space) = (&self.0, KrylovSpace::default());
        let measure = Measure::new(system, options, 1.0);
        solved(system, u, p, |inner, preconditioner, x| {
            x.push(0.0);
            measure.stages(options, |limits| {
                let moving = measure.of(followed.measure(system, *speed), &x[..last]);
                let weight = moving / followed.scale;
                (x[last], rhs[last]) = (*speed / weight, weight * followed.force);
                limits.size = resting.hypot(moving);
                let mut operator = LoadedOperator {
                    inner,
                    load: &followed,
                    weight,
                };
                let mut bordered = Bordered::new(preconditioner, &followed, weight);
                add_scaled(&mut x[..shares.len()], -*speed, &shares);
                let result = fgmres(&mut operator, &mut bordered, &rhs, x, *limits, &mut space);
                *speed = weight * x[last];
                add_scaled(&mut x[..shares.len()], *speed, &shares);
                result
            })
        })
    }
}

/// Solves `system` by `iterate`, which takes velocities and pressures in one vector from a guess to the solution and yields
/// the residuals.
fn solved(
    system: &SaddleSystem,
    u: &mut [f64],
    p: &mut [f64],
    iterate: impl FnOnce(
        &mut SaddleOperator,
        &mut Preconditioner,
        &mut Vec<f64>,
    ) -> Result<Vec<f64>, SolveError>
    + Send,
) -> Result<SaddleReport, SolveError> {
    let mut x: Vec<f64> = u.iter().chain(&*p).copied().collect();
    // On the thread pool throughout: its threads need not be woken for every product.
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
    let (faces, cells) = (u.len(), p.len());
    u.copy_from_slice(&x[..faces]);
    p.copy_from_slice(&x[faces..faces + cells]);
    report.map_err(|error| explained(error, system))
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

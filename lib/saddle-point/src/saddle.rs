//! Solution of the coupled velocity-pressure system.

use std::time::Instant;

use crate::SolveError;
use crate::cause::explained;
use crate::csr::Csr;
use crate::fgmres::{KrylovSpace, Operator, fgmres};
use crate::load::{Bordered, Load, LoadedOperator};
use crate::measure::Measure;
use crate::options::{SaddleOptions, SaddleReport};
use crate::preconditioner::Preconditioner;
use crate::system::SaddleSystem;
use crate::vector::{Real, add_scaled, for_chunks};

/// Solver of [`SaddleSystem`]s; keeps its memory from one step to the next, nothing else.
#[derive(Default)]
pub struct SaddleSolver {
    options: SaddleOptions,
    space: KrylovSpace,
}

impl SaddleSolver {
    /// A solver with given settings.
    pub fn new(options: SaddleOptions) -> Self {
        Self {
            options,
            space: KrylovSpace::default(),
        }
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
        &mut self,
        system: &SaddleSystem,
        u: &mut [f64],
        p: &mut [f64],
    ) -> Result<SaddleReport, SolveError> {
        system.check(u, p)?;
        let mut x: Vec<f64> = u.iter().chain(&*p).copied().collect();
        let rhs = system.right_hand_side();
        let known = system.measure(system.b, system.volume_source);
        let (options, space) = (&self.options, &mut self.space);
        let measure = Measure::new(system, options, 0.0);
        let report = prepared(system, options, |mut operator, mut preconditioner| {
            let result = measure.stages(options, |limits| {
                limits.size = measure.of(known, &x);
                let (operator, preconditioner) = (&mut operator, &mut preconditioner);
                fgmres(operator, preconditioner, &rhs, &mut x, *limits, space)
            });
            (result, preconditioner.bound())
        });
        spread(&x, u, p);
        report.map_err(|error| explained(error, system))
    }

    /// As [`SaddleSolver::solve`] with the speed of a body unknown and the force on it known;
    /// `system` has it at rest. `speed` holds a guess and takes the solution.
    ///
    /// # Errors
    /// As [`SaddleSolver::solve`].
    pub fn solve_loaded(
        &mut self,
        system: &SaddleSystem,
        load: &Load,
        u: &mut [f64],
        p: &mut [f64],
        speed: &mut f64,
    ) -> Result<SaddleReport, SolveError> {
        system.check(u, p)?;
        load.check(system)?;
        let mut x: Vec<f64> = u.iter().chain(&*p).copied().collect();
        let (followed, shares) = load.followed(system);
        let mut rhs = system.right_hand_side();
        rhs.push(0.0);
        x.push(0.0);
        let last = x.len() - 1;
        // The force row weighs as much as the others do with the body moving.
        let resting = system.measure(system.b, system.volume_source);
        let (options, space) = (&self.options, &mut self.space);
        let measure = Measure::new(system, options, 1.0);
        let report = prepared(system, options, |mut inner, mut preconditioner| {
            let result = measure.stages(options, |limits| {
                let moving = measure.of(followed.measure(system, *speed), &x[..last]);
                let weight = moving / followed.scale;
                (x[last], rhs[last]) = (*speed / weight, weight * followed.force);
                limits.size = resting.hypot(moving);
                let mut operator = LoadedOperator {
                    inner: &mut inner,
                    load: &followed,
                    weight,
                };
                let mut bordered = Bordered::new(&mut preconditioner, &followed, weight);
                add_scaled(&mut x[..shares.len()], -*speed, &shares);
                let result = fgmres(&mut operator, &mut bordered, &rhs, &mut x, *limits, space);
                *speed = weight * x[last];
                add_scaled(&mut x[..shares.len()], *speed, &shares);
                result
            });
            (result, preconditioner.bound())
        });
        spread(&x[..last], u, p);
        report.map_err(|error| explained(error, system))
    }
}

/// History of residuals, and the eigenvalue bound of the preconditioner.
type Iterated = (Result<Vec<f64>, SolveError>, f64);

/// Runs `iterate` on the operator and the preconditioner of `system`, and reports on it.
fn prepared(
    system: &SaddleSystem,
    options: &SaddleOptions,
    iterate: impl FnOnce(SaddleOperator, Preconditioner) -> Iterated + Send,
) -> Result<SaddleReport, SolveError> {
    // On the thread pool throughout: its threads need not be woken for every product.
    rayon::scope(|_| {
        let started = Instant::now();
        let g_transposed = system.g.transpose();
        let operator = SaddleOperator {
            system: *system,
            g_transposed: &g_transposed,
            scratch: Vec::new(),
        };
        let preconditioner = Preconditioner::new(system, &g_transposed, options)?;
        let setup = started.elapsed();
        let (result, eigenvalue_bound) = iterate(operator, preconditioner);
        Ok(SaddleReport {
            history: result?,
            eigenvalue_bound,
            setup,
            iteration: started.elapsed() - setup,
        })
    })
}

fn spread(x: &[f64], u: &mut [f64], p: &mut [f64]) {
    let (x_u, x_p) = x.split_at(u.len());
    u.copy_from_slice(x_u);
    p.copy_from_slice(x_p);
}

struct SaddleOperator<'a> {
    system: SaddleSystem<'a>,
    g_transposed: &'a Csr<f64>,
    /// Scaled velocities.
    scratch: Vec<f64>,
}

impl SaddleOperator<'_> {
    /// The rest of the product, with `A u` in `y_u`.
    fn add_fluxes<X: Real>(&self, u: &[X], p: &[X], y_u: &mut [f64], y_p: &mut [f64]) {
        for_chunks(y_u, |start, part| {
            for (i, y) in part.iter_mut().enumerate() {
                *y -= self.g_transposed.row_times_wide(start + i, p);
            }
        });
        for_chunks(y_p, |start, part| {
            for (i, y) in part.iter_mut().enumerate() {
                let cell = start + i;
                *y = -self.system.g.row_times_wide(cell, u) - self.system.c[cell] * p[cell].into();
            }
        });
    }
}

impl Operator for SaddleOperator<'_> {
    fn apply<X: Real>(&mut self, x: &[X], y: &mut [f64]) {
        let (u, p) = x.split_at(self.system.a.n_rows());
        let (y_u, y_p) = y.split_at_mut(u.len());
        self.system.a.multiply_by(u, &mut self.scratch, y_u);
        self.add_fluxes(u, p, y_u, y_p);
    }
}

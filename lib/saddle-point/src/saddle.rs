//! Solution of the coupled velocity-pressure system.

use std::time::{Duration, Instant};

use crate::SolveError;
use crate::cause::explained;
use crate::chebyshev::Chebyshev;
use crate::csr::Csr;
use crate::fgmres::{KrylovSpace, Limits, Operator, Precondition, fgmres};
use crate::load::{Bordered, Load, LoadedOperator};
use crate::scaled::Scaled;
use crate::schur::Schur;
use crate::sealed::Sealed;
use crate::system::SaddleSystem;
use crate::vanka::Vanka;
use crate::vector::{Real, Work, add_scaled, for_chunks, norm};

/// Part of a solution's size below which a residual is rounding.
const ROUNDING: f64 = 1e-14;

/// Settings of the solver.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SaddleOptions {
    /// Residual to reach, relative to the norm of the right-hand side.
    pub tolerance: f64,
    /// Iterations after which the solve fails.
    pub max_iterations: usize,
    /// Krylov vectors before a restart; memory is 8 bytes x unknowns x this.
    pub restart: usize,
    /// Degree of the Chebyshev polynomial that stands for `A^-1`.
    pub chebyshev_degree: usize,
    /// Its interval: largest over smallest eigenvalue of `D^-1 A` treated.
    pub chebyshev_ratio: f64,
}

impl Default for SaddleOptions {
    fn default() -> Self {
        Self {
            tolerance: 1e-3,
            max_iterations: 200,
            restart: 30,
            chebyshev_degree: 24,
            chebyshev_ratio: 400.0,
        }
    }
}

/// What a solve did.
#[derive(Clone, Debug)]
pub struct SaddleReport {
    /// Relative residual at the start and after every iteration.
    pub history: Vec<f64>,
    /// Upper bound of the eigenvalues of `D^-1 A` used.
    pub eigenvalue_bound: f64,
    /// Time to build the preconditioner.
    pub setup: Duration,
    /// Time of the iteration.
    pub iteration: Duration,
}

impl SaddleReport {
    /// Number of iterations.
    pub fn iterations(&self) -> usize {
        self.history.len().saturating_sub(1)
    }

    /// Relative residual reached.
    pub fn residual(&self) -> f64 {
        self.history.last().copied().unwrap_or(0.0)
    }
}

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

/// What residuals are measured by.
struct Measure {
    /// Area by which each face is one to air; empty where no forces stand.
    fronts: Vec<f64>,
    /// Velocity that counts there at least.
    slow: f64,
    /// What residuals are measured by where nothing moves.
    still: f64,
    /// Part of a solution below which they are rounding, over the tolerance.
    rounding: f64,
}

impl Measure {
    fn new(system: &SaddleSystem, options: &SaddleOptions, still: f64) -> Self {
        Self {
            fronts: system.fronts(),
            slow: system.slow,
            still: match options.tolerance * norm(system.b) {
                pushed if pushed > 0.0 && !system.standing.is_empty() => pushed,
                _ => still,
            },
            rounding: ROUNDING / options.tolerance,
        }
    }

    /// The measure at `x`, of what moves the liquid, `known`, and of what flows through the fronts; and no residual is
    /// smaller than the rounding of what stands.
    fn of(&self, known: f64, x: &[f64]) -> f64 {
        let flow: f64 = (self.fronts.iter().zip(x))
            .map(|(area, u)| (area * u.abs().max(self.slow)).powi(2))
            .sum();
        let size = match known.hypot(flow.sqrt()) {
            0.0 => self.still,
            size => size,
        };
        size.max(self.rounding * norm(x))
    }

    /// Residuals of `solve`, which where forces stand is asked again with the measure of what it found: one of a
    /// guess at rest would ask for too much, one of a guess that flows for too little.
    fn stages(
        &self,
        options: &SaddleOptions,
        mut solve: impl FnMut(&mut Limits) -> Result<Vec<f64>, SolveError>,
    ) -> Result<Vec<f64>, SolveError> {
        let stands = !self.fronts.is_empty();
        let mut limits = Limits {
            tolerance: options.tolerance,
            size: 0.0,
            enough: if stands { options.tolerance } else { 0.0 },
            max_iterations: options.max_iterations,
            restart: options.restart.max(1),
        };
        let mut history = solve(&mut limits)?;
        let mut done = !stands;
        while !done {
            let before = history.len() - 1;
            limits.max_iterations = options.max_iterations.saturating_sub(before);
            let more = solve(&mut limits).map_err(|error| error.after(before))?;
            done = more.len() == 1;
            history.pop();
            history.extend(more);
        }
        Ok(history)
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
        let (scaled, g_transposed) = (Scaled::new(system.a)?, system.g.transpose());
        let operator = SaddleOperator {
            system: *system,
            g_transposed: &g_transposed,
            scaled: &scaled,
            scratch: Vec::new(),
        };
        let preconditioner = Preconditioner::new(&operator, options)?;
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
    scaled: &'a Scaled,
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
    fn apply_exactly(&self, x: &[f64], y: &mut [f64]) {
        let (u, p) = x.split_at(self.system.a.n_rows());
        let (y_u, y_p) = y.split_at_mut(u.len());
        self.system.a.multiply(u, y_u);
        self.add_fluxes(u, p, y_u, y_p);
    }

    fn apply(&mut self, x: &[Work], y: &mut [f64]) {
        let (u, p) = x.split_at(self.system.a.n_rows());
        let (y_u, y_p) = y.split_at_mut(u.len());
        self.scaled.multiply(u, &mut self.scratch, y_u);
        self.add_fluxes(u, p, y_u, y_p);
    }
}

/// `[Ahat, 0; -G, -Shat]^-1`, then one sweep of [`Vanka`] on what that leaves.
pub(crate) struct Preconditioner<'a> {
    g: &'a Csr<f64>,
    g_transposed: &'a Csr<f64>,
    c: &'a [f64],
    chebyshev: Chebyshev<'a>,
    /// `D^-1/2` of the velocity block.
    scale: &'a [Work],
    schur: Schur,
    vanka: Vanka,
    /// Right-hand side of the pressure solve, and what that leaves of the volume balance.
    volume: Vec<Work>,
    left: Vec<Work>,
}

impl<'a> Preconditioner<'a> {
    fn new(operator: &SaddleOperator<'a>, options: &SaddleOptions) -> Result<Self, SolveError> {
        let (system, scaled) = (operator.system, operator.scaled);
        let (degree, ratio) = (options.chebyshev_degree, options.chebyshev_ratio);
        Ok(Self {
            g: system.g,
            g_transposed: operator.g_transposed,
            c: system.c,
            vanka: Vanka::new(&system, &scaled.scale),
            chebyshev: Chebyshev::new(scaled, degree, ratio),
            scale: &scaled.scale,
            schur: Schur::new(&system, operator.g_transposed)?,
            volume: vec![Work::default(); system.g.n_rows()],
            left: Vec::new(),
        })
    }

    /// The pockets whose means it leaves alone.
    pub(crate) fn sealed(&self) -> &Sealed {
        self.schur.sealed()
    }

    fn bound(&self) -> f64 {
        self.chebyshev.bound()
    }
}

impl Precondition for Preconditioner<'_> {
    /// `u = Ahat^-1 r_u`, `p = -Shat^-1 (r_p + G u)`; then the sweep.
    fn apply(&mut self, r: &[Work], z: &mut Vec<Work>) {
        let (r_u, r_p) = r.split_at(self.g.n_columns());
        z.resize(r.len(), Work::default());
        let (velocity, pressure) = z.split_at_mut(r_u.len());
        self.chebyshev.apply(r_u, velocity);
        let (g, u) = (self.g, &*velocity);
        for_chunks(&mut self.volume, |start, part| {
            for (i, out) in part.iter_mut().enumerate() {
                let flux = g.row_times_wide(start + i, u);
                *out = r_p[start + i] + Work::nearest(flux);
            }
        });
        self.left.clone_from(&self.volume);
        self.schur.apply_negative(&mut self.volume, pressure);
        let (c, p) = (self.c, &*pressure);
        for_chunks(&mut self.left, |start, part| {
            for (i, left) in part.iter_mut().enumerate() {
                *left += Work::nearest(c[start + i]) * p[start + i];
            }
        });
        let g_transposed = self.g_transposed;
        let push = |face| Work::nearest(g_transposed.row_times_wide(face, p));
        let left = (self.chebyshev.residual(push), &self.left[..]);
        self.vanka.sweep(left, self.scale, velocity, pressure);
    }

    fn strengthen(&mut self) -> bool {
        self.chebyshev.widen()
    }

    fn begins(&self) -> bool {
        !self.sealed().is_empty()
    }

    fn begin(&self, r: &[f64], x: &mut [f64]) {
        let faces = self.g.n_columns();
        self.sealed().begin(&r[faces..], &mut x[faces..]);
    }
}

//! The scheme, and one step of it: the eight stages of docs/methods.md section 3.1.

mod air;
mod clock;
mod controlled;
mod drive;
mod failure;
mod last;
pub(crate) mod length;
mod scheme;
mod setup;
mod solution;
mod state;
mod transport;
mod units;
pub(crate) mod water;

use physics::{Failure, Motion, PressRun, Scene, StepLimit, StepReport, Stop};
use saddle_point::{SaddleOptions, SaddleSolver};

use crate::geometry::{Lattice, Solids, Wetted, Window};
use crate::liquid::{Bins, Fractions};
use crate::settings::Settings;
use crate::transport::{Field, Path};
use crate::water::{Account, Exchange};
use clock::{Clock, Part};
use drive::Drive;
use last::LastFlow;
use length::Fit;
use setup::Setup;
use solution::Solution;
use state::{Rates, State};
use units::Units;

/// Attempts at ending the clamp's way exactly. Where its speed under load control follows the step,
/// as in closed spaces and from rest, more do not come nearer; then the step is taken as it is.
const CLOSER: usize = 3;
/// Attempts at a step of acceptable length.
const ATTEMPTS: usize = 12;
/// Solves of a step that may fail where menisci hold, each of a quarter of the length of the one before.
const UNSOLVED: usize = 3;

/// The implicit scheme on a scene: a staggered, coupled pressure-viscosity solve per step with
/// the particles as markers.
pub struct Implicit {
    setup: Setup,
    state: State,
    workspace: Workspace,
}

/// Memory kept from one step to the next, no part of the state; and the time spent.
struct Workspace {
    bins: Bins,
    fractions: Fractions,
    solver: SaddleSolver,
    clock: Clock,
}

/// A step that is being tried.
struct Trial {
    /// Its length, s.
    dt: f64,
    /// Velocities that the bodies were placed by, m/s.
    bodies: Vec<[f64; 3]>,
    /// Geometry with the bodies in the middle of their way.
    lattice: Lattice,
    /// What walls take of the water; `None` where the liquid loses none.
    exchange: Option<Exchange>,
    /// The walls that take it.
    wetted: Vec<Wetted>,
}

impl Implicit {
    /// The scheme for `scene`.
    ///
    /// # Errors
    /// A sentence on what this scheme cannot do with the scene or the settings.
    pub fn new(scene: Scene, settings: Settings) -> Result<Self, String> {
        settings.check()?;
        setup::check(&scene)?;
        let motions: Vec<Motion> = scene.bodies.iter().map(|body| body.motion).collect();
        let (clamp, speed) = (scene.clamp, scene.initial_speed());
        let programme = programme(&scene);
        let (setup, mut particles) = Setup::new(scene, settings)?;
        let water = (setup.liquid.water.as_ref())
            .map(|water| Account::new(crate::water::fill(&mut particles, water)));
        let acoustic = setup.units.h / setup.liquid.sound_speed();
        let options = SaddleOptions {
            tolerance: settings.tolerance,
            ..SaddleOptions::default()
        };
        let mut scheme = Self {
            state: State::new(
                particles,
                Drive::new(motions, clamp, programme, acoustic, setup.present),
                speed,
                water,
            ),
            setup,
            workspace: Workspace {
                bins: Bins::default(),
                fractions: Fractions::default(),
                solver: SaddleSolver::new(options),
                clock: Clock::default(),
            },
        };
        scheme.state.soaked = vec![0.0; scheme.pieces_that_fill()];
        Ok(scheme)
    }

    /// Takes one step; see [`physics::Scheme::advance`]. Stages 1 to 6 are repeated with steps of
    /// decreasing length until what was solved fits the step.
    fn step(&mut self, limit: StepLimit) -> Result<StepReport, Failure> {
        self.state.rates = Rates::Zero;
        let limit = self.state.drive.within(limit, self.state.travel);
        let mut longest = limit.time_s;
        let (mut last, mut misses, mut unsolved) = (Fit::Good, 0, 0);
        self.foresee(limit)?;
        for attempt in 0..ATTEMPTS {
            // 1. Time step.
            let dt = self.time_step(limit)?.min(longest);
            let dt = self.aim(dt);
            self.setup.units.cured = self.cured(dt);
            // 2. Geometry.
            let mut trial = self.place(dt);
            // 3. Liquid on the lattice.
            self.fill(&trial);
            last = self.dry(&mut trial);
            if let Fit::Dried(part) = last {
                self.state.particles.go_back();
                longest = part * dt;
                continue;
            }
            // 4 to 6. Assembly, solve and forces, in passes where the viscosity varies.
            let solution = match self.solve(&trial) {
                Ok(solution) => solution,
                // What holds menisci at rest is the stiffer the longer the step (3.12).
                Err(_) if self.setup.liquid.wetting.is_some() && unsolved < UNSOLVED => {
                    unsolved += 1;
                    longest = 0.25 * dt;
                    continue;
                }
                Err(failure) => return Err(failure),
            };
            last = self.fit(&trial, &solution, limit);
            match last {
                Fit::Fast | Fit::Dried(_) if attempt < ATTEMPTS / 4 => continue,
                // Trapped air moves as far in a step of any length, until viscosity holds it back.
                Fit::Fast | Fit::Dried(_) => longest = 0.5 * dt,
                Fit::Missed if misses < CLOSER => misses += 1,
                Fit::Misplaced => longest = 0.5 * dt,
                Fit::Good | Fit::Missed => return self.follow(&trial, solution, limit),
            }
        }
        Err(self.no_step(last))
    }

    /// The rest of a step whose solution fits it.
    fn follow(
        &mut self,
        trial: &Trial,
        mut solution: Solution,
        limit: StepLimit,
    ) -> Result<StepReport, Failure> {
        let dt = self.length(trial, &solution, limit);
        let lattice = &trial.lattice;
        let after = self.solids_after(&solution.bodies, dt);
        self.give_off(trial, dt);
        let (lost, water) = (self.state.counts.lost, self.state.particles.water());
        // 7. Transport.
        let field = self.transport(lattice, &mut solution, &after, dt);
        if let Some((mut air, growth)) = solution.air.take() {
            air.grow(&growth, dt / trial.dt);
            self.state.air = air;
        }
        // 8. Density projection; then particles take what is there, bodies and time advance.
        self.project(lattice, &solution, &after, dt)?;
        if self.state.counts.lost > lost {
            self.let_go(water);
        }
        self.take_up(lattice, &solution, &field)?;
        Ok(self.advance_bodies(&solution, field, dt))
    }

    /// Bodies displaced by where they are now and a time at given velocities.
    fn solids_after(&self, bodies: &[[f64; 3]], time: f64) -> Solids {
        let moved: Vec<[f64; 3]> = (self.state.displacement.iter().zip(bodies))
            .map(|(d, v)| std::array::from_fn(|a| (d[a] + v[a] * time) / self.setup.units.h))
            .collect();
        self.setup.rest.displaced(&moved)
    }

    /// Stage 2: geometry with the bodies, and the particles, in the middle of their way.
    fn place(&mut self, dt: f64) -> Trial {
        let bodies = self.state.drive.velocities();
        let solids = self.solids_after(&bodies, 0.5 * dt);
        let path = Path {
            before: &self.solids_after(&bodies, 0.0),
            after: &solids,
            scale: 0.5 * dt / self.setup.units.h,
        };
        let Workspace { clock, .. } = &mut self.workspace;
        let particles = &mut self.state.particles;
        let ahead = clock.time(Part::Advection, || path.ahead(particles));
        particles.visit(ahead);
        let window = match self.setup.air {
            // Pockets reach beyond the liquid.
            Some(_) => self.setup.window_of_all(),
            None => {
                let (from, to) = particles.extent();
                Window::around(self.setup.domain, from, to)
            }
        };
        Trial {
            dt,
            bodies,
            lattice: clock.time(Part::Geometry, || Lattice::new(solids, window)),
            exchange: None,
            wetted: Vec::new(),
        }
    }

    /// Stage 3: what of the lattice the particles fill.
    fn fill(&mut self, trial: &Trial) {
        let Workspace {
            bins,
            fractions,
            clock,
            ..
        } = &mut self.workspace;
        let particles = &mut self.state.particles;
        clock.time(Part::Fractions, || {
            particles.sort(&trial.lattice.window, bins);
            fractions.update(particles, bins, &trial.lattice, &trial.bodies);
            fractions.shrink();
        });
    }

    /// Bodies, clamp and time advance by `dt` (s); what the step reports.
    fn advance_bodies(&mut self, solution: &Solution, field: Field, dt: f64) -> StepReport {
        let Self { setup, state, .. } = self;
        for (displacement, v) in state.displacement.iter_mut().zip(&solution.bodies) {
            *displacement = std::array::from_fn(|a| displacement[a] + v[a] * dt);
        }
        if state.drive.clamped().is_some() {
            state.travel += solution.speed * dt;
        }
        let pressure = |body: Option<usize>, way: f64| {
            body.map_or(0.0, |body| way * setup.pressure(&solution.forces, body))
        };
        let (bottom, top) = (pressure(setup.bottom, -1.0), pressure(setup.top, 1.0));
        let clamped = pressure(state.drive.clamped(), 1.0);
        state.drive.observe(clamped, dt, state.travel);
        state.trend.observe(state.pace, dt);
        state.steps += 1;
        state.time += dt;
        state.power = solution.power;
        let Field { value, flow } = field;
        state.last = (setup.present.table).then(|| LastFlow::new(flow.window, value));
        state.rates = Rates::Of(Box::new(flow));
        StepReport {
            dt_s: dt,
            closing_speed: solution.speed,
            travel_m: state.travel,
            pressure_bottom: bottom,
            pressure_top: top,
            lost: state.counts.lost,
            iterations: solution.iterations,
        }
    }
}

/// The press programme of a scene, if it has one: at the end of its way the clamp stands.
fn programme(scene: &Scene) -> Option<PressRun> {
    let room = match scene.stop {
        Stop::Closed { travel_m } => travel_m,
        Stop::Time(_) => f64::INFINITY,
    };
    let stages = &scene.programme;
    (!stages.is_empty()).then(|| PressRun::new(stages.clone(), room))
}

#[cfg(test)]
mod tests;

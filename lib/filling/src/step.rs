//! One implicit time step; the numbers of its stages are those of docs/methods.md section 3.1.

mod checks;
mod drive;
mod solution;
mod stages;
mod state;
mod units;

use physics::{Failure, Liquid, Motion, Scene, StepLimit, StepReport, WallLaw};

use rayon::prelude::*;

use crate::advect::{self, Flow, Moved, Path};
use crate::density;
use crate::fractions::Fractions;
use crate::lattice::Lattice;
use crate::operator::{PathRule, Scales};
use crate::particles::{Bins, Particles};
use crate::settings::Settings;
use crate::solids::Solids;
use crate::solve::{SaddleOptions, SaddleSolver};
use crate::window::{Domain, Window};
use drive::Drive;
use solution::Solution;
use stages::{Stage, Stages};
use units::Units;

/// Part of the CFL number that the liquid is to cross in a step; a step in which it crosses more than the
/// whole is solved again.
const AIM: f64 = 0.97;
/// Cells by which the middle of a body's way may lie off the place that the step was solved for: its
/// speed under load control is known only then. With a tenth of a cell a plate that is about to
/// touch liquid can be held back before it does, step after step.
const MISPLACED: f64 = 0.02;
/// Fraction of the face velocities, the fastest, that the CFL number ignores: jets through holes of
/// one voxel must not set the time step of the whole bond. They cross [`JET_CFL`] cells at most.
const JETS: f64 = 1e-3;
/// Most cells that any liquid crosses per step.
const JET_CFL: f64 = 1.5;
/// Reynolds number of a cell above which what particles carry is limited: inertia feeds on itself
/// from 0.3 on; below, the limit would only damp flows followed in many short steps.
const THIN: f64 = 0.1;
/// Attempts at a step of acceptable length.
const ATTEMPTS: usize = 12;

/// The implicit scheme on a scene: a staggered, coupled pressure-viscosity solve per step with
/// the particles as markers.
pub struct Implicit {
    settings: Settings,
    units: Units,
    domain: Domain,
    liquid: Liquid,
    wall: WallLaw,
    gravity: [f64; 3],
    path: PathRule,
    bottom: Option<usize>,
    top: Option<usize>,
    /// Area that pressures refer to, m2.
    area: f64,
    /// Bodies before any displacement.
    rest: Solids,
    /// Displacement of each body, m.
    displacement: Vec<[f64; 3]>,
    drive: Drive,
    particles: Particles,
    bins: Bins,
    fractions: Fractions,
    solver: SaddleSolver,
    /// Velocity after the last step; none before the first.
    flow: Option<Flow>,
    /// Speed that sets the time step, m/s, see [`Implicit::pace_of`].
    pace: f64,
    /// Clamp travel, m.
    travel: f64,
    steps: u64,
    lost: u64,
    /// Particles that a wall turned back so far.
    deflected: u64,
    /// Particles between closing walls that found no free place nearby so far.
    pinched: u64,
    /// Voxels of voids that no liquid can reach, filled in.
    sealed: u64,
    /// Power of viscosity and friction in the last step, W.
    power: f64,
    /// Shear rates of a restored state, until the next step gives its own.
    restored_rates: Option<Vec<f32>>,
    stages: Stages,
}

/// Geometry and liquid of a step that is being tried.
struct Trial {
    lattice: Lattice,
    /// Velocities that the bodies were placed by, m/s.
    bodies: Vec<[f64; 3]>,
    dt: f64,
}

impl Implicit {
    /// The scheme for `scene`.
    ///
    /// # Errors
    /// A sentence on what this scheme cannot do with the scene or the settings.
    pub fn new(scene: Scene, settings: Settings) -> Result<Self, String> {
        settings.check()?;
        checks::scene(&scene)?;
        let speed = scene.initial_speed();
        let units = Units::new(&scene.grid, &scene.liquid, speed);
        let domain = Domain::new(&scene.grid, scene.boundary, scene.dimensions);
        let motions: Vec<Motion> = scene.bodies.iter().map(|body| body.motion).collect();
        let path = checks::path_rule(&scene);
        let area = scene.grid.area_m2();
        let acoustic = units.h / scene.liquid.sound_speed();
        let (rest, particles, sealed) =
            checks::contents(scene.bodies, scene.points, domain, units)?;
        let options = SaddleOptions {
            tolerance: settings.tolerance,
            ..SaddleOptions::default()
        };
        Ok(Self {
            settings,
            units,
            domain,
            liquid: scene.liquid,
            wall: scene.wall,
            gravity: scene.gravity,
            path,
            bottom: scene.bottom,
            top: scene.top,
            area,
            rest,
            displacement: vec![[0.0; 3]; motions.len()],
            drive: Drive::new(motions, scene.clamp, acoustic),
            particles,
            bins: Bins::default(),
            fractions: Fractions::default(),
            solver: SaddleSolver::new(options),
            flow: None,
            pace: speed,
            travel: 0.0,
            steps: 0,
            lost: 0,
            deflected: 0,
            pinched: 0,
            sealed,
            power: 0.0,
            restored_rates: None,
            stages: Stages::default(),
        })
    }

    /// Step 1, the time step: CFL cells of the fastest motion known, in equal parts of what is left.
    fn time_step(&self, limit: StepLimit) -> Result<f64, Failure> {
        let speed = (self.pace / AIM).max(fastest(&self.drive.velocities()));
        let mut left = limit.time_s;
        if self.drive.clamped().is_some() && self.drive.speed > 0.0 {
            left = left.min(limit.travel_m / self.drive.speed);
        }
        let step = if speed > 0.0 {
            self.settings.cfl * self.units.h / speed
        } else {
            // From rest under a body force: the distance fallen in the step.
            let pull = self.gravity.iter().fold(0.0, |m: f64, g| m.max(g.abs()));
            (2.0 * self.settings.cfl * self.units.h / pull).sqrt()
        };
        let dt = if step < left {
            left / (left / step).ceil()
        } else {
            left
        };
        if dt > 0.0 && dt.is_finite() {
            return Ok(dt);
        }
        Err(Failure(format!(
            "step {}: nothing moves and no time is left: there is no time step to take",
            self.steps + 1
        )))
    }

    /// The speed that is to cross `cfl` cells per step: that of all liquid but [`JETS`], or more
    /// where jets would cross more than [`JET_CFL`].
    fn pace_of(u: &[f64], cfl: f64) -> f64 {
        let mut speeds: Vec<f32> = u.par_iter().map(|u| u.abs() as f32).collect();
        let Some(last) = speeds.len().checked_sub(1) else {
            return 0.0;
        };
        let place = ((1.0 - JETS) * last as f64).ceil() as usize;
        let (_, &mut most, jets) = speeds.select_nth_unstable_by(place, f32::total_cmp);
        let fastest = jets.iter().fold(most, |m, &u| m.max(u));
        f64::from(most).max(f64::from(fastest) * cfl / JET_CFL.max(cfl))
    }

    /// Bodies displaced by where they are now and a time at given velocities.
    fn solids_after(&self, bodies: &[[f64; 3]], time: f64) -> Solids {
        let moved: Vec<[f64; 3]> = (self.displacement.iter().zip(bodies))
            .map(|(d, v)| std::array::from_fn(|a| (d[a] + v[a] * time) / self.units.h))
            .collect();
        self.rest.displaced(&moved)
    }

    /// Steps 2 and 3: geometry in the middle of the step, and the liquid in it.
    fn place(&mut self, dt: f64) -> Trial {
        let bodies = self.drive.velocities();
        let solids = self.solids_after(&bodies, 0.5 * dt);
        let (from, to) = self.particles.extent();
        let window = Window::around(self.domain, from, to);
        let lattice = (self.stages).time(Stage::Geometry, || Lattice::new(solids, window));
        let Self {
            stages,
            particles,
            bins,
            fractions,
            ..
        } = self;
        stages.time(Stage::Fractions, || {
            particles.sort(&window, bins);
            fractions.update(particles, bins, &window, &lattice.open);
        });
        Trial {
            lattice,
            bodies,
            dt,
        }
    }

    fn scales(&self, dt: f64) -> Scales {
        let Units { h, eta, .. } = self.units;
        let weight = self.liquid.density * h * h / eta;
        Scales {
            inertia: weight / dt,
            compressibility: eta / (self.liquid.tait.bulk_modulus * dt),
            gravity: self.gravity.map(|g| weight * g),
            influence_length: self.wall.influence_length() / h,
            path: self.path,
        }
    }

    /// Steps 1 to 6: solves with steps of decreasing length until what was solved fits the step: neither
    /// liquid nor bodies overshoot the CFL number, and the bodies are where they were placed.
    fn solve(&mut self, limit: StepLimit) -> Result<(Trial, Solution), Failure> {
        let h = self.units.h;
        let mut longest = limit.time_s;
        for _ in 0..ATTEMPTS {
            let dt = self.time_step(limit)?.min(longest);
            let trial = self.place(dt);
            let solution = self.solution(&trial)?;
            self.pace = Self::pace_of(&solution.u, self.settings.cfl);
            let cells = self.pace.max(fastest(&solution.bodies)) * dt / h;
            let misplaced = 0.5 * dt / h * apart(&trial.bodies, &solution.bodies);
            if cells <= self.settings.cfl * (1.0 + 1e-9) && misplaced <= MISPLACED {
                return Ok((trial, solution));
            }
            if misplaced > MISPLACED {
                longest = 0.5 * dt;
            }
        }
        Err(Failure(format!(
            "step {}: no acceptable time step was found, for the liquid is the faster the shorter the step, \
             {:.3e} m/s at last; a wall may push liquid that is enclosed on all sides",
            self.steps + 1,
            self.pace
        )))
    }

    /// Takes one step; see [`physics::Scheme::advance`].
    fn step(&mut self, limit: StepLimit) -> Result<StepReport, Failure> {
        self.flow = None;
        self.restored_rates = None;
        let (trial, solution) = self.solve(limit)?;
        let mut dt = trial.dt;
        if self.drive.clamped().is_some() {
            // Load control may have sped the clamp up.
            dt = dt.min(limit.travel_m / solution.speed);
        }
        let before = self.solids_after(&solution.bodies, 0.0);
        let after = self.solids_after(&solution.bodies, dt);
        self.transport(&trial.lattice, &solution, &before, &after, dt)?;
        for (displacement, v) in self.displacement.iter_mut().zip(&solution.bodies) {
            *displacement = std::array::from_fn(|a| displacement[a] + v[a] * dt);
        }
        let pressure = |body: Option<usize>, way: f64| {
            body.map_or(0.0, |b| {
                way * solution.forces[b][1] * self.units.force() / self.area
            })
        };
        let (bottom, top) = (pressure(self.bottom, -1.0), pressure(self.top, 1.0));
        if self.drive.clamped().is_some() {
            self.travel += solution.speed * dt;
        }
        self.drive.observe(top, dt);
        self.steps += 1;
        Ok(StepReport {
            dt_s: dt,
            closing_speed: solution.speed,
            travel_m: self.travel,
            pressure_bottom: bottom,
            pressure_top: top,
            lost: self.lost,
            iterations: solution.iterations,
        })
    }

    /// Steps 7 and 8: particles follow the flow, are projected, and take velocity and pressure.
    fn transport(
        &mut self,
        lattice: &Lattice,
        solution: &Solution,
        before: &Solids,
        after: &Solids,
        dt: f64,
    ) -> Result<(), Failure> {
        let path = Path {
            before,
            after,
            scale: dt / self.units.h,
        };
        let influence = self.wall.influence_length() / self.units.h;
        let dofs = &solution.dofs;
        let particles = &mut self.particles;
        let (flow, value, mut moved) = self.stages.time(Stage::Advection, || {
            let value = advect::extend(lattice, &dofs.face, &solution.u);
            let flow = Flow::new(lattice, &value, &dofs.face, &solution.bodies, influence);
            let moved = path.follow(particles, |x| flow.velocity(x));
            (flow, value, moved)
        });
        let projected: Result<Moved, _> = self.stages.time(Stage::Density, || {
            let cells = density::Cells {
                density: &solution.density,
                fraction: &solution.fraction,
                volume: &solution.volume,
            };
            let (g, volume) = (&solution.g, &solution.face_volume);
            let (moves, _) = density::displacement(g, &g.transpose(), volume, cells)?;
            let field = density::Field::new(&lattice.window, &dofs.face, &moves);
            let path = Path {
                before: after,
                after,
                scale: 1.0,
            };
            Ok(path.follow(particles, |x| field.at(x)))
        });
        let projected =
            projected.map_err(|e: crate::solve::SolveError| self.failure(&e.to_string()))?;
        moved.lost += projected.lost;
        moved.pinched += projected.pinched;
        self.deflected += moved.deflected;
        self.lost += moved.lost;
        self.pinched += moved.pinched;
        self.stages.time(Stage::Advection, || {
            let Units { h, eta, .. } = self.units;
            let thin = self.liquid.density * self.pace * h / eta > THIN;
            advect::set_velocities(&mut self.particles, &flow, thin.then_some(&value));
            let lowest = self
                .liquid
                .cavitation_pressure
                .map_or(f64::NEG_INFINITY, |p| -p);
            let tait = self.liquid.tait;
            let (window, pressure) = (&lattice.window, &solution.pressure);
            advect::set_volume_changes(&mut self.particles, window, pressure, tait, lowest);
        });
        self.flow = Some(flow);
        self.power = solution.power;
        if self.particles.is_empty() {
            return Err(self.failure("all liquid has left the domain"));
        }
        Ok(())
    }

    fn failure(&self, what: &str) -> Failure {
        Failure(format!("step {}: {what}", self.steps + 1))
    }
}

/// Largest component of velocities, m/s.
fn fastest(velocities: &[[f64; 3]]) -> f64 {
    (velocities.iter().flatten()).fold(0.0, |most, v| most.max(v.abs()))
}

/// Largest difference of a component between velocities, m/s.
fn apart(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    (a.iter().flatten())
        .zip(b.iter().flatten())
        .fold(0.0, |most, (a, b)| most.max((a - b).abs()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thousandth_of_the_faces_may_be_jets_of_one_and_a_half_cells() {
        let pace = |jets: usize, speed: f64| {
            let u: Vec<f64> = (0..10_000)
                .map(|face| if face < jets { speed } else { 1.0 })
                .collect();
            Implicit::pace_of(&u, 0.5)
        };
        assert_eq!((pace(9, 2.0), pace(12, 2.0)), (1.0, 2.0));
        assert!((pace(9, 30.0) / 10.0 - 1.0).abs() < 1e-6);
    }
}

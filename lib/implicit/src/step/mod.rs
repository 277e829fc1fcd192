//! The scheme and the order of a step (docs/methods.md section 3.1).

mod air;
mod clamp;
mod completion;
mod compression;
mod drive;
mod exchange;
mod failure;
mod mid_step;
mod output;
mod remesh;
mod scheme;
mod setup;
mod solve;
mod water;

use std::time::Instant;

use physics::{Failure, Scene, StepLimit, StepReport};
use saddle_point::{SaddleOptions, SaddleSolver};

use crate::clock::{Clock, Stage};
use crate::geometry::Mesh;
use crate::settings::Settings;
use crate::system::{Edges, Flow, REST_DISTANCE, WallCouplings};
use crate::water::AbsorbingWalls;
use air::AirState;
use completion::courant_speed;
use drive::ClampDrive;
use setup::Setup;
use water::WaterBalance;

/// Bound on the attempts at a step; the second nearly always has an acceptable length.
const MAX_ATTEMPTS: usize = 8;
/// Factor by which a step may exceed the Courant number, and the part of that number which the next attempt aims at: so few
/// steps are solved twice.
const CFL_EXCESS: f64 = 1.1;
const CFL_TARGET: f64 = 0.95;
/// Largest change of ln(viscosity) in a step by cure, and the target by loss of water: 1/viscosity in the middle of the step
/// then differs from its mean by 0.17 %.
pub(crate) const LN_VISCOSITY_STEP: f64 = 0.2;
/// Largest ratio of successive step lengths with menisci. A pinned meniscus breaks loose from rest, where no speed bounds the
/// step, and steps that grow at once do not settle to rest (docs/decisions/menisci.md).
const MAX_LENGTH_RATIO: f64 = 2.0;

/// The implicit scheme on a scene.
pub struct Implicit {
    setup: Setup,
    state: State,
    mesh: Mesh,
    couplings: WallCouplings,
    edges: Edges,
    /// Absorbing walls of the mesh.
    absorbing_walls: Option<AbsorbingWalls>,
    /// Height of the gap between steps, cells. During a step the mesh has the height of its middle.
    height: f64,
    solver: SaddleSolver,
    clock: Clock,
}

/// The state that changes from step to step.
#[derive(Default)]
struct State {
    /// Liquid volume of each pore at zero pressure, cells.
    volumes: Vec<f64>,
    flow: Flow,
    drive: ClampDrive,
    air: AirState,
    /// Displacement of each body, m.
    displacement: Vec<[f64; 3]>,
    /// Clamp travel, m.
    travel: f64,
    time: f64,
    steps: u64,
    /// Length of the last step, s.
    dt: f64,
    /// Flow speed of the last step for the Courant number, cells/s, and its expected growth to the next step, a factor.
    courant_speed: f64,
    growth: f64,
    /// Liquid volume that left the domain, cells.
    lost: f64,
    /// Steps whose iterations did not converge.
    unsettled: u64,
    /// The water balance of a liquid that loses water.
    water: Option<WaterBalance>,
}

impl Implicit {
    /// Sets up the scheme for `scene`.
    ///
    /// # Errors
    /// A sentence on what this scheme cannot do with the scene or the settings.
    pub fn new(scene: &Scene, settings: Settings) -> Result<Self, String> {
        settings.check()?;
        let (setup, mesh, volumes) = Setup::new(scene, settings)?;
        let balance = setup.initial_water(&volumes);
        let drive = setup.drive(scene);
        let closing = drive.speed / setup.units.cell_m;
        let flow = Flow {
            velocity: setup.initial_velocity(&scene.points, &mesh, &volumes, closing)?,
            pressure: vec![0.0; mesh.pores.len()],
            speed: closing,
            ..Flow::default()
        };
        let speed = scene.initial_speed() / setup.units.cell_m;
        let mut scheme = Self {
            state: State {
                volumes,
                flow,
                drive,
                displacement: vec![[0.0; 3]; scene.bodies.len()],
                courant_speed: speed,
                growth: 1.0,
                water: balance,
                ..State::default()
            },
            solver: SaddleSolver::new(SaddleOptions {
                tolerance: settings.tolerance,
                ..SaddleOptions::default()
            }),
            clock: Clock::default(),
            height: mesh.rows().height,
            edges: Edges::default(),
            absorbing_walls: None,
            setup,
            mesh,
            couplings: WallCouplings::default(),
        };
        scheme.update_mesh();
        scheme.state.air = scheme.first_air();
        Ok(scheme)
    }

    /// Takes one step: remeshes, then solves with shorter and shorter lengths until one is acceptable, and completes it.
    fn step(&mut self, limit: StepLimit) -> Result<StepReport, Failure> {
        let programme = self.state.drive.programme.as_ref();
        let limit = programme.map_or(limit, |run| run.within(limit, self.state.travel));
        if self.setup.lattice.moving.is_some() && self.height == 0.0 && self.state.drive.speed > 0.0
        {
            // A body of given velocity may overlap another by a fiftieth of a cell at the end (docs/verdicts.md), and the step that
            // ends its travel may do so earlier by a hundredth.
            let left = self.state.drive.speed * limit.time_s / self.setup.units.cell_m;
            if self.setup.clamp.is_some() || left > 3.0 * REST_DISTANCE {
                return Err(self.failure("the bodies have met and cannot move on"));
            }
            self.state.drive.speed = 0.0;
        }
        let begun = Instant::now();
        self.update_mesh();
        self.clock.add(Stage::Geometry, begun);
        let (mut longest, mut dries) = (limit.time_s, false);
        let mut start = self.state.flow.clone();
        for attempt in 0..MAX_ATTEMPTS {
            let dt = self.step_length(limit).min(longest);
            if !(dt > 0.0 && dt.is_finite()) {
                return Err(self.failure("nothing moves, so no time step can be chosen"));
            }
            let solved = self
                .solve(dt, limit, longest, &mut start)
                .map_err(|why| self.failure(&why))?;
            let shorter = solved.dries_too_fast();
            dries = shorter.is_some();
            if let Some(shorter) = shorter {
                longest = shorter;
                continue;
            }
            let flow = &solved.flow;
            let speed = courant_speed(flow, self.setup.settings.cfl).max(flow.speed.abs());
            let crossed = speed * solved.dt;
            if crossed <= CFL_EXCESS * self.setup.settings.cfl {
                return Ok(self.complete_step(solved, limit));
            }
            longest = CFL_TARGET * solved.dt * self.setup.settings.cfl / crossed;
            // A pocket without air collapses by the same volume whatever the length, so the speed grows as the step shrinks.
            if attempt > 0 && self.setup.gas.is_some() {
                longest = longest.min(0.5 * solved.dt);
            }
        }
        Err(self.no_acceptable_length(dries))
    }

    /// Time in which the flow of the last step, times its expected growth, crosses a cell, s.
    fn cell_crossing_time(&self) -> f64 {
        let courant_speed = self.state.courant_speed.max(self.state.flow.speed.abs());
        1.0 / (self.state.growth * courant_speed)
    }

    /// Length of the next step by the flow of the last one, s.
    fn step_length(&self, limit: StepLimit) -> f64 {
        let (state, liquid, units) = (&self.state, &self.setup.liquid, self.setup.units);
        let cfl = self.setup.settings.cfl;
        let mut dt = (cfl * self.cell_crossing_time()).min(limit.time_s);
        // A step has the viscosity of its middle, so cure must not change it much.
        if let Some(cure) = &liquid.cure {
            dt = dt.min(cure.steady(state.time, LN_VISCOSITY_STEP));
        }
        if let Some(balance) = &state.water {
            dt = dt.min(balance.steady_time());
        }
        // The first step starts from rest, where weight sets the speed.
        if state.steps == 0 {
            dt = dt.min((2.0 * cfl / self.setup.gravity_acceleration()).sqrt());
        }
        // A clamp that starts to retreat, in a stage that begins below the pressure reached, is bounded by its full speed only: with
        // air behind it no earlier step tells the speed.
        let retreating = (state.drive.programme.as_ref()).filter(|run| run.gives_way());
        if let Some(run) = retreating {
            dt = dt.min(cfl * units.cell_m / run.stage().speed);
        }
        // The first step is bounded by the capillary speed, tension over viscosity. Later ones may grow by a factor only, since
        // contact-line friction is evaluated at the velocity of the step before.
        if let Some(wetting) = liquid.wetting {
            dt = dt.min(match state.steps {
                0 => units.cell_m * units.viscosity / wetting.tension,
                _ => MAX_LENGTH_RATIO * state.dt,
            });
        }
        match self.travel_left(limit) {
            left if left > 0.0 => dt.min(left / state.flow.speed.max(f64::MIN_POSITIVE)),
            // The clamp has reached the end of its travel.
            _ => dt,
        }
    }
}
